// Google's etc2comp, as libfilament_imageio holds it: the one encoder of ETC2 among Debian 12's libraries.
#include "base/image/etc2_module.h"

#include <algorithm>
#include <cstddef>

#include <image/LinearImage.h>
#include <imageio/BlockCompression.h>

extern "C" __attribute__((visibility("default"))) bool parityEncodeEtc2(const float* rgba, std::uint32_t width,
                                                                        std::uint32_t height, int effort,
                                                                        bool perceptual, std::uint8_t* blocks) {
  image::LinearImage image(width, height, 4);
  std::copy_n(rgba, std::size_t{4} * width * height, image.getPixelRef());
  const image::CompressedTexture texture =
      image::etcCompress(image, {image::CompressedFormat::RGBA8_ETC2_EAC,
                                 perceptual ? image::EtcErrorMetric::REC709 : image::EtcErrorMetric::NUMERIC, effort});
  if (texture.size != width * height || !texture.data) return false; // 16 bytes for 16 texels
  std::copy_n(texture.data.get(), texture.size, blocks);
  return true;
}

static_assert(sizeof(&parityEncodeEtc2) == sizeof(parity::base::EncodeEtc2));
