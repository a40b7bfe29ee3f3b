// GGX prefiltering of a cube map for N = V = R.
#include "lighting/environment/prefilter.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

#include "base/parallel.h"
#include "lighting/environment/lamp_sums.h"
#include "lighting/environment/texel_tile.h"
#include "shading/shading.h"

namespace parity::lighting {

namespace {

// Van der Corput's sequence in base 2: the bits of i mirrored behind the point.
double radicalInverse(std::uint32_t i) {
  double result = 0;
  for (double digit = 0.5; i != 0; i >>= 1, digit *= 0.5) result += (i & 1) * digit;
  return result;
}

// An orthonormal right-handed frame with n as its third axis (Duff et al. 2017, "Building an Orthonormal Basis,
// Revisited", listing 3).
glm::mat3 makeFrame(const glm::vec3& n) {
  const float sign = std::copysign(1.f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

// Small faces have small tiles, for all cores.
int tileSideOf(int size) { return std::clamp(size / 4, std::min(size, 4), kMaxTileSide); }

// How a level is filtered.
struct LevelLobe {
  std::vector<FourReads> samples;
  double roughnessOfBright;
};

// By each lobe into the level of the same place.
void filterTile(const FilterSource& source, std::span<const LevelLobe> lobes, const TexelTile& tile,
                std::vector<std::vector<glm::vec4>>& levels) {
  std::array<glm::vec3, kMaxTileTexels> normals, sums, brightSums{};
  std::array<glm::mat3, kMaxTileTexels> frames;
  const int count = tile.count(), size = tile.faceSize;
  for (int i = 0; i < count; ++i) {
    normals[i] = glm::vec3(texelDirection(tile.face, tile.left + i % tile.side, tile.top + i / tile.side, size));
    frames[i] = makeFrame(normals[i]);
  }
  for (std::size_t layer = 0; layer < lobes.size(); ++layer) {
    const LevelLobe& lobe = lobes[layer];
    source.cube->readSums(std::span(frames).first(count), lobe.samples, sums);
    if (!source.bright.fours.empty()) {
      sumBrightTexels(source.bright, std::span(normals).first(count), lobe.roughnessOfBright, brightSums);
      for (int i = 0; i < count; ++i) sums[i] += brightSums[i];
    }
    if (source.lamps)
      addLampsToTile(*source.lamps, tile, std::span(normals).first(count),
                     static_cast<float>(std::pow(lobe.roughnessOfBright, 4)), std::span(sums).first(count));
    glm::vec4* texels = &levels[layer][texelIndex(tile.face, tile.left, tile.top, size)];
    for (int y = 0; y < tile.side; ++y)
      for (int x = 0; x < tile.side; ++x) texels[y * size + x] = glm::vec4(sums[y * tile.side + x], 1.f);
  }
}

LevelLobe makeLevelLobe(int mip, int layer, const PrefilterOptions& options) {
  const double roughness =
      shading::f64::roughnessFromMip(mip + static_cast<double>(layer) / shading::f64::kPrefilterLayers);
  const int size = options.faceSize >> mip;
  const bool isFine = options.levels == PrefilterLevels::fine;
  const Spread spread = isFine ? Spread::spiral : Spread::hammersley;
  // A lobe narrower than the texels would be met or missed by their middles: alpha is half a texel's width at least.
  const double roughnessOfBright = isFine ? std::max(roughness, std::sqrt(1.0 / size)) : roughness;
  return {packReads(
              makeLobeSamples(roughness, samplesOfMip(mip, options), options.faceSize, options.footprintLog2, spread)),
          roughnessOfBright};
}

} // namespace

std::vector<WeightedRead> makeLobeSamples(double roughness, int count, int faceSize, double footprintLog2,
                                          Spread spread) {
  assert(roughness > 0 && count >= 1 && faceSize >= 1);
  const double alpha = roughness * roughness, a2 = alpha * alpha;
  const double texelAngle = 4.0 / (static_cast<double>(faceSize) * faceSize);
  std::vector<WeightedRead> samples(count);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    // Half vectors beyond 45 degrees lead below the horizon: the first number is spread over the others, which are
    // 1 / (1 + alpha^2) of the whole.
    const double share = 1 / (1 + a2), xi = (i + 0.5) / count * share;
    const double NoH2 = (1 - xi) / (1 - (1 - a2) * xi);
    const double NoL = 2 * NoH2 - 1, sinL = std::sqrt(std::max(0.0, 1 - NoL * NoL));
    const double phi = spread == Spread::spiral ? std::numbers::pi * (3 - std::sqrt(5.0)) * i
                                                : 2 * std::numbers::pi * radicalInverse(static_cast<std::uint32_t>(i));
    const double pdf = shading::f64::D_GGX(alpha, std::sqrt(NoH2)) / 4 / share; // D NoH / (4 VoH), and NoH = VoH
    samples[i].direction = glm::vec3(glm::dvec3(sinL * std::cos(phi), sinL * std::sin(phi), NoL));
    samples[i].sizeLog2 = static_cast<float>(0.5 * std::log2(1 / (count * pdf) / texelAngle) + footprintLog2);
    samples[i].weight = static_cast<float>(NoL);
    sum += NoL;
  }
  for (WeightedRead& sample : samples) sample.weight = static_cast<float>(sample.weight / sum);
  return samples;
}

int samplesOfMip(int mip, const PrefilterOptions& options) {
  constexpr int kQuarters[] = {0, 4, 16, 32, 64, 256}, kFineQuarters[] = {1, 4, 8, 16, 32, 128};
  const bool isFine = options.levels == PrefilterLevels::fine;
  assert(mip >= (isFine ? 0 : 1) && mip < static_cast<int>(std::size(kQuarters)));
  return std::max(1, options.sampleCount * (isFine ? kFineQuarters : kQuarters)[mip] / 4);
}

std::vector<std::vector<glm::vec4>> prefilter(const FilterSource& source, int mip, int firstLayer, int endLayer,
                                              const PrefilterOptions& options) {
  if (firstLayer >= endLayer) return {};
  const int size = options.faceSize >> mip;
  std::vector<LevelLobe> lobes;
  for (int layer = firstLayer; layer < endLayer; ++layer) lobes.push_back(makeLevelLobe(mip, layer, options));
  std::vector<std::vector<glm::vec4>> levels(lobes.size(), std::vector<glm::vec4>(texelIndex(kCubeFaces, 0, 0, size)));
  const int side = tileSideOf(size), across = size / side;
  base::parallelFor(static_cast<std::size_t>(kCubeFaces) * across * across, 1, [&](std::size_t i, std::size_t) {
    const int face = static_cast<int>(i) / (across * across), inFace = static_cast<int>(i) % (across * across);
    const TexelTile tile{face, inFace % across * side, inFace / across * side, side, size};
    filterTile(source, lobes, tile, levels);
  });
  return levels;
}

std::vector<glm::vec4> fitBilinear(const std::vector<glm::vec4>& mip, int size) {
  const CubeLevel level = makeCubeLevel(mip, size);
  std::vector<glm::vec4> fitted(mip.size());
  for (int face = 0; face < kCubeFaces; ++face)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const glm::vec4* texel =
            level.faces.data() + (static_cast<std::size_t>(face) * level.stride + y + 1) * level.stride + x + 1;
        const glm::vec4 neighbours = texel[-1] + texel[1] + texel[-level.stride] + texel[level.stride];
        fitted[texelIndex(face, x, y, size)] = glm::max(*texel - (neighbours - 4.f * *texel) / 12.f, 0.5f * *texel);
      }
  return fitted;
}

} // namespace parity::lighting
