#include "bake/encode/lq_encoding.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "bake/atlas/block_fill.h"
#include "base/parallel.h"
#include "shading/shading.h"

namespace parity::bake {

namespace {

using Vec3 = glm::dvec3;

namespace formulas = shading::f64;
using std::numbers::pi;
constexpr std::array<double, 3> kLuminance = {.3, .59, .11};
constexpr double kConstant = .282094791773878143, kLinear = .325735007935279943; // of directionality

double luminanceOf(const Vec3& c) { return kLuminance[0] * c.x + kLuminance[1] * c.y + kLuminance[2] * c.z; }
formulas::real3 toShading(const Vec3& v) { return {v.x, v.y, v.z}; }

// What a texel stores, as numbers. direction: along y, z and x; the constant beside it is always .282095.
struct Values {
  std::array<float, 3> logRgb{}, direction{};
};

// Directionality at the baked normal, at least. Where more light comes from behind than from before (a lamp within its
// shade), SH of order 1 have less there, or are negative, which decodes to black. 1/16 is 14 steps of 8 bits.
constexpr double kLeastDirectionality = 1. / 16;

// l1, turned towards the normal as far as that takes.
Vec3 visibleFromBefore(double l0, const Vec3& l1, const Vec3& normal) {
  const double directionality = kConstant + kLinear * glm::dot(l1, normal) / l0;
  if (!(l0 > 0) || directionality >= kLeastDirectionality) return l1;
  return l1 + (kLeastDirectionality - directionality) * l0 / kLinear * normal;
}

Values valuesOf(const Vec3& irradiance, double l0, const Vec3& l1, const Vec3& normal) {
  const formulas::LightmapSh sh = formulas::encodeLightmapSh(l0, toShading(visibleFromBefore(l0, l1, normal)));
  const double scale = formulas::flatNormalScale(sh, toShading(normal)) / pi;
  const auto logRgb = formulas::encodeLightmapLogRgb(toShading(irradiance * scale));
  const auto f = [](double value) { return static_cast<float>(value); };
  return {{f(logRgb.x), f(logRgb.y), f(logRgb.z)}, {f(sh.x), f(sh.y), f(sh.z)}};
}

// Irradiance over pi that a texel's codes give at a normal.
Vec3 decode(const std::uint8_t* upper, const std::uint8_t* lower, const LqScales& s, const Vec3& normal) {
  const formulas::LightmapScales scales = {toShading(s.colorScale),     toShading(s.colorAdd),
                                           toShading(s.directionScale), s.directionScale.w,
                                           toShading(s.directionAdd),   s.directionAdd.w};
  const auto color = formulas::GetLightMapColorLQ({upper[0] / 255.0, upper[1] / 255.0, upper[2] / 255.0},
                                                  {lower[0] / 255.0, lower[1] / 255.0, lower[2] / 255.0, 1}, scales,
                                                  toShading(normal));
  return {color.x, color.y, color.z};
}

Vec3 vectorAt(const base::Image& image, std::size_t texel, int first = 0) {
  const float* p = image.pixels.data() + texel * static_cast<std::size_t>(image.channels) + first;
  return {p[0], p[1], p[2]};
}

// Of all texels of a page; zeros where none is owned.
std::vector<Values> valuesOf(const LightmapPage& page) {
  std::vector<Values> values(page.owner.pixelCount());
  base::parallelFor(values.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (page.owner.pixels[i] != kNoInstance)
        values[i] = valuesOf(vectorAt(page.irradiance, i), page.sh.pixels[4 * i], vectorAt(page.sh, i, 1),
                             vectorAt(page.normal, i));
  });
  return values;
}

class Bounds {
public:
  void include(const Values& values) {
    for (int c = 0; c < 3; ++c) {
      m_least[c] = std::min(m_least[c], values.logRgb[c]);
      m_most[c] = std::max(m_most[c], values.logRgb[c]);
      m_least[3 + c] = std::min(m_least[3 + c], values.direction[c]);
      m_most[3 + c] = std::max(m_most[3 + c], values.direction[c]);
    }
  }
  LqScales scales() const {
    LqScales scales;
    if (m_least[0] > m_most[0]) return scales;
    for (int c = 0; c < 3; ++c) {
      scales.colorAdd[c] = m_least[c];
      scales.colorScale[c] = m_most[c] - m_least[c];
      scales.directionAdd[c] = m_least[3 + c];
      scales.directionScale[c] = m_most[3 + c] - m_least[3 + c];
    }
    scales.colorAdd.w = 1; // the alpha that nothing reads
    scales.directionAdd.w = static_cast<float>(formulas::encodeLightmapSh(0, {}).w);
    return scales;
  }

private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::array<float, 6> m_least{kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};
  std::array<float, 6> m_most{-kInfinity, -kInfinity, -kInfinity, -kInfinity, -kInfinity, -kInfinity};
};

double codeOf(double value, float scale, float add) {
  return scale > 0 ? std::clamp(std::round((value - add) / scale * 255), 0.0, 255.0) : 0;
}
double valueOf(double code, float scale, float add) { return code / 255 * scale + add; }

// The codes of LogRGB that together give LogL best. Rounded each for itself, the three may add up to three times the
// half step of one. Green makes up for what red and blue lost: its weight is the largest, so that it moves least. Where
// it is at its end, or has no range, red and then blue take what is left; they do not refine what green could reach,
// for that would tint greys and cost ASTC up to 5 dB.
std::array<double, 3> codesOf(const std::array<float, 3>& logRgb, const LqScales& scales) {
  std::array<double, 3> codes{};
  double missing = 0; // of LogL
  const auto contribution = [&](int c, double code) {
    return kLuminance[c] * valueOf(code, scales.colorScale[c], scales.colorAdd[c]);
  };
  for (int c = 0; c < 3; ++c) {
    codes[c] = codeOf(logRgb[c], scales.colorScale[c], scales.colorAdd[c]);
    missing += kLuminance[c] * logRgb[c] - contribution(c, codes[c]);
  }
  for (const int c : {1, 0, 2}) {
    if (scales.colorScale[c] == 0) continue;
    const double step = kLuminance[c] * scales.colorScale[c] / 255;
    const double moved = std::clamp(codes[c] + std::round(missing / step), 0.0, 255.0);
    missing -= contribution(c, moved) - contribution(c, codes[c]);
    codes[c] = moved;
    if (std::abs(missing) <= step / 2) break;
  }
  return codes;
}

// Two halves, one above the other. Alpha is 255 throughout, which ASTC stores for nothing.
base::Image8 quantize(const LightmapPage& page, const std::vector<LqScales>& instances) {
  const std::vector<Values> values = valuesOf(page);
  base::Image8 codes(page.owner.width, 2 * page.owner.height, 4, 255);
  const std::size_t below = page.owner.pixelCount();
  base::parallelFor(below, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::uint8_t *upper = codes.pixels.data() + 4 * i, *lower = upper + 4 * below;
      std::fill_n(upper, 3, std::uint8_t{0});
      std::fill_n(lower, 3, std::uint8_t{0});
      if (page.owner.pixels[i] == kNoInstance) continue;
      const LqScales& scales = instances[page.owner.pixels[i]];
      const std::array<double, 3> color = codesOf(values[i].logRgb, scales);
      for (int c = 0; c < 3; ++c) {
        upper[c] = static_cast<std::uint8_t>(color[c]);
        lower[c] =
            static_cast<std::uint8_t>(codeOf(values[i].direction[c], scales.directionScale[c], scales.directionAdd[c]));
      }
    }
  });
  return codes;
}

// Sums over owned texels, in their order.
class Errors {
public:
  void add(const LightmapPage& page, const std::vector<LqScales>& instances, const base::Image8& codes) {
    const std::size_t below = page.owner.pixelCount();
    for (std::size_t i = 0; i < below; ++i) {
      if (page.owner.pixels[i] == kNoInstance) continue;
      const LqScales& s = instances[page.owner.pixels[i]];
      const std::uint8_t *upper = codes.pixels.data() + 4 * i, *lower = upper + 4 * below;
      const Vec3 irradiance = vectorAt(page.irradiance, i);
      const Vec3 difference = decode(upper, lower, s, vectorAt(page.normal, i)) * pi - irradiance;
      const double scale = 1 / (luminanceOf(irradiance) + pi * formulas::kLogBlackPoint);
      for (int c = 0; c < 3; ++c) {
        m_squares += std::pow(difference[c] * scale, 2);
        m_largest = std::max(m_largest, std::abs(difference[c] * scale));
      }
      ++m_texels;
    }
  }
  LqError take() const {
    return m_texels > 0 ? LqError{std::sqrt(m_squares / static_cast<double>(3 * m_texels)), m_largest} : LqError{};
  }

private:
  double m_squares = 0, m_largest = 0;
  std::size_t m_texels = 0;
};

// Squared differences of codes, of one half.
class CodeErrors {
public:
  void add(const LightmapPage& page, const base::Image8& before, const base::Image8& after, bool lower) {
    const std::size_t count = page.owner.pixelCount(), first = lower ? count : 0;
    for (std::size_t i = 0; i < count; ++i)
      if (page.owner.pixels[i] != kNoInstance) {
        for (std::size_t c = 4 * (first + i); c < 4 * (first + i) + 3; ++c)
          m_squares += std::pow(double(after.pixels[c]) - before.pixels[c], 2);
        m_codes += 3;
      }
  }
  double inDb() const {
    if (m_squares == 0) return std::numeric_limits<double>::infinity();
    return 10 * std::log10(255.0 * 255.0 * static_cast<double>(m_codes) / m_squares);
  }

private:
  double m_squares = 0;
  std::size_t m_codes = 0;
};

} // namespace

LqLightmap encodeLq(const std::vector<LightmapPage>& pages, std::size_t instanceCount, const LqOptions& options) {
  std::vector<Bounds> bounds(instanceCount);
  for (const LightmapPage& page : pages) {
    const std::vector<Values> values = valuesOf(page);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (const std::uint32_t owner = page.owner.pixels[i]; owner != kNoInstance) {
        assert(owner < instanceCount);
        bounds[owner].include(values[i]);
      }
  }
  LqLightmap result;
  for (const Bounds& each : bounds) result.instances.push_back(each.scales());

  Errors quantized, stored;
  CodeErrors color, direction;
  for (const LightmapPage& page : pages) {
    base::Image8 codes = quantize(page, result.instances);
    fillBlocks(page.owner, base::blockSide(options.block), codes);
    base::Image8 decoded = base::throughAstc(codes, options.block, base::AstcUse::lightmap);
    quantized.add(page, result.instances, codes);
    stored.add(page, result.instances, decoded);
    color.add(page, codes, decoded, false);
    direction.add(page, codes, decoded, true);
    result.pages.push_back(std::move(decoded));
  }
  result.figures = {quantized.take(), stored.take(), color.inDb(), direction.inDb()};
  return result;
}

} // namespace parity::bake
