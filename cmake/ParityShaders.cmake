# parity_generated(NAME headers...): headers that are made before anything is compiled, and can be made without: the target
# `generated` makes all of them, as clang-tidy needs them (scripts/check).
add_custom_target(generated)
function(parity_generated name)
  add_custom_target(${name} DEPENDS ${ARGN})
  add_dependencies(generated ${name})
endfunction()

# parity_shaders(TARGET [INCLUDE folders...] [DEFINES A=1...] SHADERS x.comp y.vert ...)
#
# Compiles each shader to SPIR-V at build time, with its includes as dependencies, and embeds it: the header
# "<folder>/<file>.h" (made in the build folder) holds `inline constexpr uint32_t k<CamelName>[]`. A shader error is a
# build error.
function(parity_shaders target)
  cmake_parse_arguments(ARG "" "" "INCLUDE;DEFINES;SHADERS" ${ARGN})
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(out ${CMAKE_BINARY_DIR}/shaders/${target})
  file(MAKE_DIRECTORY ${out}/${folder}_shaders)
  set(includes -I${CMAKE_CURRENT_SOURCE_DIR})
  foreach(dir ${ARG_INCLUDE})
    list(APPEND includes -I${CMAKE_BINARY_DIR}/include/${dir})
  endforeach()
  set(defines ${ARG_DEFINES})
  list(TRANSFORM defines PREPEND -D)
  set(headers)
  foreach(shader ${ARG_SHADERS})
    get_filename_component(file ${shader} NAME)
    get_filename_component(shader ${shader} ABSOLUTE)
    string(REGEX REPLACE "[._]" ";" words ${file})
    set(symbol k)
    foreach(word ${words})
      string(SUBSTRING ${word} 0 1 first)
      string(SUBSTRING ${word} 1 -1 rest)
      string(TOUPPER ${first} first)
      string(APPEND symbol ${first}${rest})
    endforeach()
    set(header ${out}/${folder}_shaders/${file}.h)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.2 ${includes} ${defines}
              --depfile ${header}.d --vn ${symbol} -o ${header} ${shader}
      COMMAND sed -i -e "1i #pragma once\\n#include <cstdint>" -e "s/^const uint32_t/inline constexpr std::uint32_t/" ${header}
      DEPENDS ${shader}
      DEPFILE ${header}.d
      COMMENT "Shader ${folder}/${file}"
      VERBATIM)
    list(APPEND headers ${header})
  endforeach()
  target_sources(${target} PRIVATE ${headers})
  target_include_directories(${target} PRIVATE ${out})
  parity_generated(${target}_shaders ${headers})
  add_dependencies(${target} ${target}_shaders)
endfunction()

# parity_formula(TARGET formula.glsl): the mobile shader with that environment BRDF (mobile/formulas.h), in both precisions:
# k<Formula>Fp16Comp and k<Formula>Fp32Comp, as parity_shaders makes them; and k<Formula>LobesFp16Comp and so on, for scenes
# with lobes beside the base's own.
function(parity_formula target formula)
  get_filename_component(name ${formula} NAME_WE)
  foreach(variant "" _lobes)
    set(lobes)
    if(variant)
      set(lobes "#define PARITY_LOBES")
    endif()
    foreach(precision 16 32)
      set(shader ${CMAKE_CURRENT_BINARY_DIR}/${name}${variant}_fp${precision}.comp)
      file(CONFIGURE OUTPUT ${shader} CONTENT [[#version 460
#extension GL_GOOGLE_include_directive : require
#define PARITY_FP@precision@
@lobes@
#define PARITY_OWN_ENVIRONMENT_BRDF
#include "shading/real.glsl"
#include "@formula@"
#include "mobile/shaders/mobile.glsl"
]] @ONLY)
      list(APPEND shaders ${shader})
    endforeach()
  endforeach()
  parity_shaders(${target} INCLUDE gpu shading mobile SHADERS ${shaders})
endfunction()
