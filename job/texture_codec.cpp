#include "job/texture_codec.h"

#include <cstdint>
#include <span>
#include <vector>

#include "base/hash.h"

namespace parity::job {

namespace {

// Fewer are compressed sooner than a file is opened.
constexpr std::size_t kLeastCachedTexels = 64 * 64;

} // namespace

gpu::TextureCodec makeTextureCodec(const Context& context, base::AstcBlock block) {
  if (block == base::AstcBlock::none) return {};
  return [&context, block](const base::Image8& mip, bool isColor) {
    const base::AstcUse use = isColor ? base::AstcUse::color : base::AstcUse::data;
    const base::Cache& cache = context.cache();
    if (!cache.enabled() || mip.pixelCount() < kLeastCachedTexels) return base::throughAstc(mip, block, use);
    const std::string key = "astc-" + base::Hasher()
                                          .add(context.buildId())
                                          .addValue(block)
                                          .addValue(use)
                                          .addValue(mip.width)
                                          .addValue(mip.height)
                                          .add(std::as_bytes(std::span{mip.pixels}))
                                          .hex();
    const auto decode = [&](std::span<const std::uint8_t> blocks) {
      return base::decodeAstc(blocks, mip.width, mip.height, block, use);
    };
    if (const auto cached = cache.find(key); cached && cached->size() == base::astcBytes(mip.width, mip.height, block))
      return decode({reinterpret_cast<const std::uint8_t*>(cached->data()), cached->size()});
    const std::vector<std::uint8_t> blocks = base::encodeAstc(mip, block, use);
    cache.store(key, std::as_bytes(std::span{blocks}));
    return decode(blocks);
  };
}

} // namespace parity::job
