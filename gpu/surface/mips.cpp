#include "gpu/surface/mips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/parallel.h"
#include "gpu/surface/mip_taps.h"

namespace parity::gpu {

namespace {

// sRGB decode by code, and encode by a 16-bit linear index: a step is 0.05 codes at most.
struct SrgbTables {
  std::array<float, 256> decode;
  std::vector<std::uint8_t> encode;
  SrgbTables() : encode(65536) {
    for (int i = 0; i < 256; ++i) {
      const double c = i / 255.0;
      decode[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    for (int i = 0; i < 65536; ++i) {
      const double l = i / 65535.0;
      encode[i] =
          static_cast<std::uint8_t>(255 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055) + 0.5);
    }
  }
};
const SrgbTables& srgbTables() {
  static const SrgbTables tables;
  return tables;
}

// The common case, both sides even: the mean of 2x2 texels.
base::Image8 halveEven(const base::Image8& source, bool srgb) {
  const SrgbTables& tables = srgbTables();
  base::Image8 target(source.width / 2, source.height / 2, 4);
  base::parallelFor(target.height, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      const std::uint8_t* a = source.at(0, static_cast<int>(2 * y));
      const std::uint8_t* b = source.at(0, static_cast<int>(2 * y + 1));
      std::uint8_t* out = target.at(0, static_cast<int>(y));
      for (int x = 0; x < target.width; ++x, a += 8, b += 8, out += 4)
        for (int c = 0; c < 4; ++c) {
          if (srgb && c < 3) {
            const float sum =
                tables.decode[a[c]] + tables.decode[a[c + 4]] + tables.decode[b[c]] + tables.decode[b[c + 4]];
            out[c] = tables.encode[static_cast<int>(std::min(sum * 0.25f, 1.f) * 65535 + 0.5f)];
          } else {
            out[c] = static_cast<std::uint8_t>((a[c] + a[c + 4] + b[c] + b[c + 4] + 2) / 4);
          }
        }
    }
  });
  return target;
}

} // namespace

base::Image8 makeNextMip(const base::Image8& source, bool srgb) {
  if (source.width % 2 == 0 && source.height % 2 == 0) return halveEven(source, srgb);
  const SrgbTables& tables = srgbTables();
  base::Image8 target(std::max(source.width / 2, 1), std::max(source.height / 2, 1), 4);
  const std::vector<Taps> tapsX = makeTaps(source.width, target.width), tapsY = makeTaps(source.height, target.height);
  base::parallelFor(target.height, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (int x = 0; x < target.width; ++x) {
        std::array<float, 4> sum{};
        for (int ky = 0; ky < tapsY[y].count; ++ky)
          for (int kx = 0; kx < tapsX[x].count; ++kx) {
            const float weight = static_cast<float>(tapsY[y].weights[ky]) * static_cast<float>(tapsX[x].weights[kx]);
            const std::uint8_t* texel = source.at(tapsX[x].first + kx, tapsY[y].first + ky);
            for (int c = 0; c < 3; ++c)
              sum[c] += weight * (srgb ? tables.decode[texel[c]] : static_cast<float>(texel[c]));
            sum[3] += weight * static_cast<float>(texel[3]);
          }
        std::uint8_t* out = target.at(x, static_cast<int>(y));
        for (int c = 0; c < 3; ++c)
          out[c] = srgb ? tables.encode[static_cast<int>(std::min(sum[c], 1.f) * 65535 + 0.5f)]
                        : static_cast<std::uint8_t>(std::min(sum[c], 255.f) + 0.5f);
        out[3] = static_cast<std::uint8_t>(std::min(sum[3], 255.f) + 0.5f);
      }
  });
  return target;
}

} // namespace parity::gpu
