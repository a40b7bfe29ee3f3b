# Every third-party package, with the traps of Debian 12's own package files worked around in one place.
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED) # before glslang, whose config names it without finding it
find_package(Vulkan REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(hwy REQUIRED)
# Instruction sets to compile for: without the ones whose vectors have no size at compile time (they cannot be held in a
# struct), and without SSSE3, between plain x86-64 and SSE4.
add_library(parity_simd INTERFACE)
target_link_libraries(parity_simd INTERFACE hwy::hwy)
target_compile_definitions(parity_simd INTERFACE
  "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV)")
find_package(glm REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(draco REQUIRED)
find_package(embree 3 REQUIRED)
find_package(SPIRV-Tools-opt REQUIRED)
find_package(astcenc REQUIRED)
find_package(SQLite3 REQUIRED)

# Of KISS FFT the header in C++ alone, which needs no library.
find_path(KISSFFT_INCLUDE_DIR kissfft/kissfft.hh REQUIRED)

# NLopt's config names its C library only; the C++ one holds both.
find_path(NLOPT_INCLUDE_DIR nlopt.hpp REQUIRED)
find_library(NLOPT_LIBRARY nlopt_cxx REQUIRED)

# OpenImageIO's exported target names an include folder that Debian does not ship.
find_package(OpenImageIO REQUIRED)
foreach(target OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
  foreach(property INTERFACE_INCLUDE_DIRECTORIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES)
    get_target_property(folders ${target} ${property})
    if(folders)
      list(FILTER folders EXCLUDE REGEX "opencv4")
      set_target_properties(${target} PROPERTIES ${property} "${folders}")
    endif()
  endforeach()
endforeach()

# Of OpenEXR only its core in C, which needs neither Imath nor threads; the config finds them all.
find_path(OPENEXR_INCLUDE_DIR openexr.h PATH_SUFFIXES OpenEXR REQUIRED)
find_library(OPENEXR_CORE_LIBRARY OpenEXRCore REQUIRED)

# OpenColorIO's config is broken there: it names targets that no package defines.
find_path(OPENCOLORIO_INCLUDE_DIR OpenColorIO/OpenColorIO.h REQUIRED)
find_library(OPENCOLORIO_LIBRARY OpenColorIO REQUIRED)
add_library(parity_opencolorio INTERFACE)
target_include_directories(parity_opencolorio SYSTEM INTERFACE ${OPENCOLORIO_INCLUDE_DIR})
target_link_libraries(parity_opencolorio INTERFACE ${OPENCOLORIO_LIBRARY})

# Of filament only the codec of ETC2 is used; its package has no config.
find_path(FILAMENT_INCLUDE_DIR imageio/BlockCompression.h PATH_SUFFIXES filament-1.9 REQUIRED)
find_library(FILAMENT_IMAGEIO_LIBRARY filament_imageio REQUIRED)
find_library(FILAMENT_IMAGE_LIBRARY filament_image REQUIRED)

# The letters of `parity plot`.
find_package(Freetype REQUIRED)
find_file(PARITY_FONT DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu REQUIRED)
find_file(PARITY_FONT_BOLD DejaVuSans-Bold.ttf PATHS /usr/share/fonts/truetype/dejavu REQUIRED)

# libdeflate has a config only from 1.15 on.
find_path(LIBDEFLATE_INCLUDE_DIR libdeflate.h REQUIRED)
find_library(LIBDEFLATE_LIBRARY deflate REQUIRED)

find_path(JEMALLOC_INCLUDE_DIR jemalloc/jemalloc.h REQUIRED)
find_library(JEMALLOC_LIBRARY jemalloc REQUIRED)

find_path(STB_INCLUDE_DIR stb/stb_image_write.h REQUIRED)
find_library(STB_LIBRARY stb REQUIRED)

# Debian's libwebp has no config.
find_path(WEBP_INCLUDE_DIR webp/decode.h REQUIRED)
find_library(WEBP_LIBRARY webp REQUIRED)

find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
# SPIR-V's numbers, which spirv-tools does not bring along.
find_path(GLSLANG_INCLUDE_DIR glslang/SPIRV/spirv.hpp REQUIRED)
find_package(glslang REQUIRED)
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_OPT spirv-opt REQUIRED)

if(PARITY_TESTS)
  find_package(GTest REQUIRED)
endif()
if(PARITY_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
