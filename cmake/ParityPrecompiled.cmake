# Two precompiled headers for all libraries: what nearly every source includes, without Vulkan-Hpp and with it (1 MB of
# header). Headers are compiled alone without the first (parity_folder), so that each includes what it needs.
set(often_included
  <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <set> <span> <string> <vector>
  <fmt/format.h> <fmt/ranges.h> <glm/glm.hpp> <nlohmann/json.hpp>)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/pch.cpp CONTENT "// Only its precompiled header is used.\n")
foreach(id IN ITEMS parity_pch parity_vulkan_pch)
  add_library(${id} STATIC EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/generated/pch.cpp)
  target_link_libraries(${id} PRIVATE parity_flags fmt::fmt glm::glm nlohmann_json::nlohmann_json Vulkan::Headers)
endforeach()
target_precompile_headers(parity_pch PRIVATE ${often_included})
target_precompile_headers(parity_vulkan_pch PRIVATE ${CMAKE_SOURCE_DIR}/gpu/device/vulkan.h ${often_included})
