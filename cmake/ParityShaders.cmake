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
# "<folder>/<file>.h" (made in the build folder) holds `inline constexpr std::uint32_t k<CamelName>[]`. A shader error is a
# build error.
#
# Functions are inlined, and local variables become values: a driver makes its pipelines in a third less time. No pass of
# these reorders or merges arithmetic, so results keep their bits. The header also holds the module
# as it was written, k<CamelName>Written: the program compiles preset folders in that way, and compares them with it.
set(PARITY_SPIRV_PASSES --merge-return --eliminate-dead-functions
  --inline-entry-points-exhaustive --eliminate-dead-functions
  --eliminate-local-single-block --eliminate-local-single-store --ssa-rewrite --eliminate-dead-code-aggressive)

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
      OUTPUT ${header}.spv
      COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.2 ${includes} ${defines}
              --depfile ${header}.d -o ${header}.spv ${shader}
      DEPENDS ${shader}
      DEPFILE ${header}.d
      COMMENT "Shader ${folder}/${file}"
      VERBATIM)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${SPIRV_OPT} --target-env=vulkan1.2 ${PARITY_SPIRV_PASSES} ${header}.spv -o ${header}.inlined.spv
      COMMAND ${CMAKE_COMMAND} -D WRITTEN=${header}.spv -D INLINED=${header}.inlined.spv -D OUT=${header} -D SYMBOL=${symbol} -P ${CMAKE_SOURCE_DIR}/cmake/EmbedSpirv.cmake
      DEPENDS ${header}.spv ${CMAKE_SOURCE_DIR}/cmake/EmbedSpirv.cmake
      COMMENT "Embedding ${folder}/${file}"
      VERBATIM)
    list(APPEND headers ${header})
  endforeach()
  target_sources(${target} PRIVATE ${headers})
  target_include_directories(${target} PRIVATE ${out})
  parity_generated(${target}_shaders ${headers})
  add_dependencies(${target} ${target}_shaders)
endfunction()

# parity_shader_texts(TARGET NAME files...): the texts themselves, for what is compiled while the program runs (gpu/glsl). The
# header "<folder>_texts/texts.h" (made in the build folder) holds them as the array NAME. files: from the source root.
function(parity_shader_texts target name)
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(out ${CMAKE_BINARY_DIR}/shaders/${target})
  set(header ${out}/${folder}_texts/texts.h)
  string(REPLACE ";" "," files "${ARGN}")
  set(sources ${ARGN})
  list(TRANSFORM sources PREPEND ${CMAKE_SOURCE_DIR}/)
  set(script ${CMAKE_SOURCE_DIR}/cmake/EmbedShaderTexts.cmake)
  file(MAKE_DIRECTORY ${out}/${folder}_texts)
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -D OUT=${header} -D ROOT=${CMAKE_SOURCE_DIR} -D NAME=${name} -D FILES=${files} -P ${script}
    DEPENDS ${sources} ${script}
    COMMENT "Texts of the shaders of ${folder}"
    VERBATIM)
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} PRIVATE ${out})
  parity_generated(${target}_texts ${header})
  add_dependencies(${target} ${target}_texts)
endfunction()
