# Embeds a SPIR-V module: cmake -D WRITTEN=a.spv -D INLINED=b.spv -D OUT=x.h -D SYMBOL=kX -P EmbedSpirv.cmake
# The header holds `inline constexpr std::uint32_t kX[]`, the module for the driver, and kXWritten[], as the compiler made it.
# The modules' words are little-endian.
set(text "#pragma once\n#include <cstdint>\n")
foreach(module IN ITEMS "${SYMBOL};${INLINED}" "${SYMBOL}Written;${WRITTEN}")
  list(GET module 0 symbol)
  list(GET module 1 file)
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
  string(APPEND text "inline constexpr std::uint32_t ${symbol}[] = {\n${words}\n};\n")
endforeach()
file(WRITE ${OUT} "${text}")
