# Embeds a SPIR-V module: cmake -D IN=x.spv -D OUT=x.h -D SYMBOL=kX -P EmbedSpirv.cmake
# The header holds `inline constexpr std::uint32_t SYMBOL[]`. The module's words are little-endian.
file(READ ${IN} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${OUT} "#pragma once\n#include <cstdint>\ninline constexpr std::uint32_t ${SYMBOL}[] = {\n${words}\n};\n")
