#include "base/image/texture_block.h"

#include <cassert>

#include "base/image/astc.h"
#include "base/image/etc2.h"

namespace parity::base {

namespace {

AstcBlock astcOf(TextureBlock block) {
  assert(block == TextureBlock::astc4x4 || block == TextureBlock::astc6x6);
  return block == TextureBlock::astc4x4 ? AstcBlock::astc4x4 : AstcBlock::astc6x6;
}

AstcUse useOf(bool isColor) { return isColor ? AstcUse::color : AstcUse::data; }

} // namespace

const std::vector<std::string>& textureBlockNames() {
  static const std::vector<std::string> names = {"none", "astc4x4", "astc6x6", "etc2"};
  return names;
}

double bitsPerTexel(TextureBlock block) {
  if (block == TextureBlock::none) return 32;
  const int side = block == TextureBlock::etc2 ? kEtc2BlockSide : blockSide(astcOf(block));
  return 128.0 / (side * side);
}

std::size_t textureBytes(int width, int height, TextureBlock block) {
  return block == TextureBlock::etc2 ? etc2Bytes(width, height) : astcBytes(width, height, astcOf(block));
}

std::vector<std::uint8_t> encodeTexture(const Image8& rgba, TextureBlock block, bool isColor) {
  return block == TextureBlock::etc2 ? encodeEtc2(rgba, isColor) : encodeAstc(rgba, astcOf(block), useOf(isColor));
}

Image8 decodeTexture(std::span<const std::uint8_t> blocks, int width, int height, TextureBlock block, bool isColor) {
  return block == TextureBlock::etc2 ? decodeEtc2(blocks, width, height)
                                     : decodeAstc(blocks, width, height, astcOf(block), useOf(isColor));
}

} // namespace parity::base
