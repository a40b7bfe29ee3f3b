# Draco's encoder for tests, apart as parity_draco is.
add_library(parity_test_draco SHARED ${CMAKE_SOURCE_DIR}/tests/scenes/gltf/draco_writer.cpp)
target_include_directories(parity_test_draco PRIVATE ${CMAKE_SOURCE_DIR}/tests)
target_link_libraries(parity_test_draco PRIVATE parity_flags draco::draco_static glm::glm)
target_link_options(parity_test_draco PRIVATE -Wl,--exclude-libs,ALL)
