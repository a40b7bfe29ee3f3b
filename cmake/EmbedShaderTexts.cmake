# cmake -D OUT=x.h -D ROOT=source folder -D NAME=kTexts -D FILES=shading/a.glsl,... -P EmbedShaderTexts.cmake
# Writes the texts of shaders as an array of parity::gpu::ShaderText, by their paths from ROOT.
string(REPLACE "," ";" files "${FILES}")
file(WRITE ${OUT} "// Made by cmake/EmbedShaderTexts.cmake.\n#pragma once\n#include \"gpu/glsl/glsl_compiler.h\"\nstatic constexpr parity::gpu::ShaderText ${NAME}[] = {\n")
foreach(file IN LISTS files)
  file(READ ${ROOT}/${file} text)
  file(APPEND ${OUT} "{\"${file}\", R\"shader(${text})shader\"},\n")
endforeach()
file(APPEND ${OUT} "};\n")
