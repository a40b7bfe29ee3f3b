#include "job/scene/texture_codec.h"

#include <cstdint>
#include <span>
#include <vector>

#include "base/hash.h"

namespace parity::job {

namespace {

// Fewer are compressed sooner than a file is opened.
constexpr std::size_t kLeastCachedTexels = 64 * 64;

} // namespace

gpu::TextureCodec makeTextureCodec(const Context& context, base::TextureBlock block) {
  if (block == base::TextureBlock::none) return {};
  return [&context, block](const base::Image8& mip, bool isColor) {
    const base::Cache& cache = context.cache();
    const auto decode = [&](std::span<const std::uint8_t> blocks) {
      return base::decodeTexture(blocks, mip.width, mip.height, block, isColor);
    };
    if (!cache.enabled() || mip.pixelCount() < kLeastCachedTexels)
      return decode(base::encodeTexture(mip, block, isColor));
    const std::string key = "blocks-" + base::Hasher()
                                            .add(context.buildId())
                                            .addValue(block)
                                            .addValue(isColor)
                                            .addValue(mip.width)
                                            .addValue(mip.height)
                                            .add(std::as_bytes(std::span{mip.pixels}))
                                            .hex();
    if (const auto cached = cache.find(key);
        cached && cached->size() == base::textureBytes(mip.width, mip.height, block))
      return decode({reinterpret_cast<const std::uint8_t*>(cached->data()), cached->size()});
    const std::vector<std::uint8_t> blocks = base::encodeTexture(mip, block, isColor);
    cache.store(key, std::as_bytes(std::span{blocks}));
    return decode(blocks);
  };
}

} // namespace parity::job
