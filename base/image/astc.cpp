// By Arm's astcenc. Its instruction set is settled when the library is built; all give the same bits, on any machine,
// unless it was built without invariance (-DASTCENC_INVARIANCE=OFF), which the interface does not tell. Debian's is
// SSE2 with invariance.
#include "base/image/astc.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <functional>
#include <memory>

#include <astcenc.h>

#include "base/parallel.h"

namespace parity::base {

namespace {

// A preset between speed and quality, as measured on 1024 x 1024 base colour and metallic-roughness and on a 512 x 512
// normal map, in dB of RGB at 4x4 and 6x6, and seconds of one thread per million texels:
//   fast      57.0 50.1   51.9 44.4   45.4 41.7    .1-.2   .05-.1
//   medium    59.1 51.1   53.5 46.1   50.3 42.6    .2-2    .07-.6
//   thorough  60.6 53.6   54.1 47.4   50.6 46.1   1.3-5    .8-6.4
// Thorough is 3 to 12 times as slow for what fewer than 4 dB add to errors that pictures hardly show; fast loses up to
// 5 dB in normal maps, where they do show. Medium is what asset pipelines ship by.
const float kQuality = ASTCENC_PRE_MEDIUM;
constexpr std::size_t kAstcBlockBytes = 16;

void check(astcenc_error result) {
  if (result != ASTCENC_SUCCESS) throw Error(ExitCode::failed, "ASTC", "", astcenc_get_error_string(result));
}

using ContextPointer = std::unique_ptr<astcenc_context, decltype(&astcenc_context_free)>;

ContextPointer makeContext(AstcBlock block, AstcUse use, unsigned int flags, int threads) {
  const astcenc_profile profile = use == AstcUse::color ? ASTCENC_PRF_LDR_SRGB : ASTCENC_PRF_LDR;
  const auto blockSize = static_cast<unsigned int>(blockSide(block));
  astcenc_config config{};
  check(astcenc_config_init(profile, blockSize, blockSize, 1, kQuality, flags, &config));
  astcenc_context* context = nullptr;
  check(astcenc_context_alloc(&config, static_cast<unsigned int>(threads), &context));
  return {context, &astcenc_context_free};
}

// A thread's share, in blocks, should outweigh its start.
int threadsFor(std::size_t bytes) {
  return static_cast<int>(std::clamp<std::size_t>(bytes / kAstcBlockBytes / 64, 1, threadCount()));
}

astcenc_image imageOf(int width, int height, void** slice) {
  return {static_cast<unsigned int>(width), static_cast<unsigned int>(height), 1, ASTCENC_TYPE_U8, slice};
}

constexpr astcenc_swizzle kSwizzle{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};

// The codec hands out blocks to whoever asks, each a matter of its own texels alone.
void runOn(int threads, const std::function<astcenc_error(unsigned int)>& body) {
  std::vector<std::function<void()>> tasks;
  tasks.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) tasks.emplace_back([&body, i] { check(body(static_cast<unsigned int>(i))); });
  parallelInvoke(tasks);
}

} // namespace

int blockSide(AstcBlock block) { return block == AstcBlock::none ? 1 : block == AstcBlock::astc4x4 ? 4 : 6; }

std::size_t astcBytes(int width, int height, AstcBlock block) {
  const int side = blockSide(block);
  return kAstcBlockBytes * static_cast<std::size_t>((width + side - 1) / side) *
         static_cast<std::size_t>((height + side - 1) / side);
}

std::vector<std::uint8_t> encodeAstc(const Image8& rgba, AstcBlock block, AstcUse use) {
  assert(rgba.channels == 4 && !rgba.empty() && block != AstcBlock::none);
  std::vector<std::uint8_t> stored(astcBytes(rgba.width, rgba.height, block));
  const int threads = threadsFor(stored.size());
  // Occlusion, roughness and metallic go their own ways: .03 to .5 dB, for no more time.
  const unsigned int flags = ASTCENC_FLG_SELF_DECOMPRESS_ONLY | (use == AstcUse::data ? ASTCENC_FLG_MAP_MASK : 0u);
  const ContextPointer context = makeContext(block, use, flags, threads); // of smaller tables: this one never decodes
  void* slice = const_cast<std::uint8_t*>(rgba.pixels.data());            // only read
  astcenc_image image = imageOf(rgba.width, rgba.height, &slice);
  runOn(threads, [&](unsigned int thread) {
    return astcenc_compress_image(context.get(), &image, &kSwizzle, stored.data(), stored.size(), thread);
  });
  return stored;
}

Image8 decodeAstc(std::span<const std::uint8_t> blocks, int width, int height, AstcBlock block, AstcUse use) {
  assert(blocks.size() == astcBytes(width, height, block));
  const int threads = threadsFor(blocks.size());
  const ContextPointer context = makeContext(block, use, ASTCENC_FLG_DECOMPRESS_ONLY, threads);
  Image8 result(width, height, 4);
  void* slice = result.pixels.data();
  astcenc_image image = imageOf(width, height, &slice);
  runOn(threads, [&](unsigned int thread) {
    return astcenc_decompress_image(context.get(), blocks.data(), blocks.size(), &image, &kSwizzle, thread);
  });
  return result;
}

Image8 throughAstc(const Image8& rgba, AstcBlock block, AstcUse use) {
  if (block == AstcBlock::none) return rgba;
  return decodeAstc(encodeAstc(rgba, block, use), rgba.width, rgba.height, block, use);
}

} // namespace parity::base
