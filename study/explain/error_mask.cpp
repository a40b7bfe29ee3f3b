#include "study/explain/error_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace parity::explain {

namespace {

constexpr std::array<std::uint8_t, 4> kMarked = {255, 64, 160, 200};

float wrapped(float coordinate, scenes::Wrap wrap) {
  if (wrap == scenes::Wrap::clampToEdge) return std::clamp(coordinate, 0.f, 1.f);
  const float whole = std::floor(coordinate), within = coordinate - whole;
  return wrap == scenes::Wrap::mirroredRepeat && std::fmod(whole, 2.f) != 0 ? 1 - within : within;
}

int texelOf(float coordinate, scenes::Wrap wrap, int side) {
  const float within = wrapped(coordinate, wrap);
  return std::isfinite(within) ? std::min(static_cast<int>(within * static_cast<float>(side)), side - 1) : 0;
}

} // namespace

MaskedTexture maskedTexture(const scenes::Material& material) {
  if (material.metallicRoughnessTexture.present()) return {"roughness", &material.metallicRoughnessTexture};
  if (material.baseColorTexture.present()) return {"baseColor", &material.baseColorTexture};
  if (material.normalTexture.present()) return {"normal", &material.normalTexture};
  return {};
}

TexelMask maskOf(std::span<const glm::vec2> places, std::span<const float> errors, const scenes::Sampler& wraps,
                 int width, int height) {
  const int longest = std::max({width, height, 1});
  const auto sideOf = [&](int side) { return std::max(1, (side * kMaskSide + longest / 2) / longest); };
  TexelMask mask{base::Image8(sideOf(width), sideOf(height), 4), 0};
  const std::size_t count = mask.picture.pixelCount();
  std::vector<double> sums(count, 0), shown(count, 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const int x = texelOf(places[i].x, wraps.wrapU, mask.picture.width),
              y = texelOf(places[i].y, wraps.wrapV, mask.picture.height);
    const auto at =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.picture.width) + static_cast<std::size_t>(x);
    sums[at] += static_cast<double>(errors[i]);
    ++shown[at];
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return sums[i]; });
  const double total = std::accumulate(sums.begin(), sums.end(), 0.0);
  double held = 0, marked = 0;
  for (const std::size_t i : order) {
    if (2 * held >= total) break;
    held += sums[i];
    ++marked;
    std::ranges::copy(kMarked, mask.picture.pixels.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  const auto seen = static_cast<double>(std::ranges::count_if(shown, [](double n) { return n > 0; }));
  mask.texels = seen > 0 ? marked / seen : 0;
  return mask;
}

} // namespace parity::explain
