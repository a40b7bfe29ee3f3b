// The colour transforms by OpenColorIO. Version 2.1 ships no configs, so each transform is put together here.
#include "base/image/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/image/byte_steps.h"
#include "base/parallel.h"
#include "base/raw_vector.h"

namespace parity::base {

namespace {

namespace ocio = OCIO_NAMESPACE;

ocio::BuiltinTransformRcPtr builtin(const char* style, ocio::TransformDirection direction) {
  ocio::BuiltinTransformRcPtr transform = ocio::BuiltinTransform::Create();
  transform->setStyle(style);
  transform->setDirection(direction);
  return transform;
}

// IEC 61966-2-1: 12.92 x below 0.0031308, 1.055 x^(1/2.4) - 0.055 above.
ocio::ConstTransformRcPtr makeSrgb() {
  const ocio::RangeTransformRcPtr clamp = ocio::RangeTransform::Create();
  clamp->setMinInValue(0);
  clamp->setMinOutValue(0);
  clamp->setMaxInValue(1);
  clamp->setMaxOutValue(1);
  const ocio::ExponentWithLinearTransformRcPtr encode = ocio::ExponentWithLinearTransform::Create();
  encode->setGamma({2.4, 2.4, 2.4, 1});
  encode->setOffset({0.055, 0.055, 0.055, 0});
  encode->setDirection(ocio::TRANSFORM_DIR_INVERSE);
  const ocio::GroupTransformRcPtr group = ocio::GroupTransform::Create();
  group->appendTransform(clamp);
  group->appendTransform(encode);
  return group;
}

// RRT and ODT of ACES 1.0 for a 100-nit sRGB screen in dim surround (ODT.Academy.sRGB_100nits_dim).
ocio::ConstTransformRcPtr makeAcesSdr() {
  const ocio::GroupTransformRcPtr group = ocio::GroupTransform::Create();
  group->appendTransform(builtin("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", ocio::TRANSFORM_DIR_INVERSE));
  group->appendTransform(builtin("ACEScg_to_ACES2065-1", ocio::TRANSFORM_DIR_FORWARD));
  group->appendTransform(
      builtin("ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0", ocio::TRANSFORM_DIR_FORWARD));
  group->appendTransform(builtin("DISPLAY - CIE-XYZ-D65_to_sRGB", ocio::TRANSFORM_DIR_FORWARD));
  return group;
}

// From a file's space to linear Rec.709.
ocio::ConstTransformRcPtr makeDecoder(const std::string& colorSpace) {
  const ocio::GroupTransformRcPtr group = ocio::GroupTransform::Create();
  if (colorSpace == "srgb") {
    const ocio::ExponentWithLinearTransformRcPtr decode = ocio::ExponentWithLinearTransform::Create();
    decode->setGamma({2.4, 2.4, 2.4, 1});
    decode->setOffset({0.055, 0.055, 0.055, 0});
    group->appendTransform(decode);
    return group;
  }
  if (colorSpace == "aces2065-1") group->appendTransform(builtin("ACEScg_to_ACES2065-1", ocio::TRANSFORM_DIR_INVERSE));
  group->appendTransform(builtin("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", ocio::TRANSFORM_DIR_FORWARD));
  return group;
}

ocio::ConstCPUProcessorRcPtr makeProcessor(const ocio::ConstTransformRcPtr& transform) {
  const ocio::ConstConfigRcPtr config = ocio::Config::Create();
  return config->getProcessor(transform)->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS);
}

std::uint8_t toByte(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 1.f) * 255 + 0.5f); }

bool isFinite(std::span<const float, 3> rgb) {
  return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

} // namespace

struct DisplayTransform::Impl {
  ocio::ConstCPUProcessorRcPtr processor; // null: nothing but the clamp
  std::optional<ByteSteps> steps;         // where each channel is encoded on its own
};

DisplayTransform::DisplayTransform(const std::string& name) : m_name(name), m_impl(std::make_unique<Impl>()) {
  if (std::find(names().begin(), names().end(), name) == names().end())
    throw Error(ExitCode::usage, "display", "'" + name + "'",
                fmt::format("unknown; known are {}", fmt::join(names(), ", ")));
  try {
    if (name == "sRGB") m_impl->processor = makeProcessor(makeSrgb());
    if (name == "ACES SDR") m_impl->processor = makeProcessor(makeAcesSdr());
  } catch (const ocio::Exception& error) {
    throw Error(ExitCode::failed, "OpenColorIO", "display '" + name + "'", error.what());
  }
  if (name != "ACES SDR")
    m_impl->steps.emplace([&](std::span<const float> values, std::span<std::uint8_t> bytes) {
      std::vector<float> encoded(values.size());
      encode(values, 0, encoded);
      std::ranges::transform(encoded, bytes.begin(), toByte);
    });
}

DisplayTransform::~DisplayTransform() = default;
DisplayTransform::DisplayTransform(DisplayTransform&&) noexcept = default;
DisplayTransform& DisplayTransform::operator=(DisplayTransform&&) noexcept = default;

const std::vector<std::string>& DisplayTransform::names() {
  static const std::vector<std::string> kNames = {"sRGB", "ACES SDR", "raw"};
  return kNames;
}

Image DisplayTransform::apply(const Image& linear, float exposureEv) const {
  if (linear.channels != 3 || linear.empty())
    throw Error(ExitCode::failed, "display '" + m_name + "'", "",
                fmt::format("needs an RGB image, not one of {} channels", linear.channels));
  Image encoded(linear.width, linear.height, 3);
  constexpr std::size_t kBandRows = 16;
  parallelFor(static_cast<std::size_t>(linear.height), kBandRows, [&](std::size_t begin, std::size_t end) {
    const std::size_t first = begin * linear.width * 3, count = (end - begin) * linear.width * 3;
    encode(std::span(linear.pixels).subspan(first, count), exposureEv, std::span(encoded.pixels).subspan(first, count));
  });
  return encoded;
}

void DisplayTransform::encode(std::span<const float> linear, float exposureEv, std::span<float> encoded) const {
  const float gain = std::exp2(exposureEv);
  const auto encodePixels = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
      const float exposed = linear[i] * gain;
      encoded[i] = std::isfinite(exposed) ? exposed : 0.0f; // tables are not to be looked up with NaN
    }
    if (m_impl->processor) {
      ocio::PackedImageDesc pixels(&encoded[3 * begin], static_cast<long>(end - begin), 1, 3);
      m_impl->processor->apply(pixels);
    }
    for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
      const float exposed = linear[i] * gain;
      encoded[i] = std::isfinite(exposed) ? std::clamp(encoded[i], 0.0f, 1.0f) : exposed;
    }
  };
  // Most of many pictures is background: equal pixels in a row are encoded once.
  constexpr std::size_t kLongRun = 16;
  const std::size_t count = linear.size() / 3;
  const auto runAt = [&](std::size_t begin) {
    std::size_t end = begin + 1;
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): the same bits are encoded to the same bits
    while (end < count && std::memcmp(&linear[3 * begin], &linear[3 * end], 3 * sizeof(float)) == 0) ++end;
    return end - begin;
  };
  std::size_t pending = 0; // the first pixel that is not encoded yet
  for (std::size_t i = 0; i < count;) {
    const std::size_t run = runAt(i);
    if (run >= kLongRun) {
      encodePixels(pending, i + 1);
      for (std::size_t k = i + 1; k < i + run; ++k) std::copy_n(&encoded[3 * i], 3, &encoded[3 * k]);
      pending = i + run;
    }
    i += run;
  }
  if (pending < count) encodePixels(pending, count);
}

void DisplayTransform::encodeBytes(std::span<const float> linear, float exposureEv, std::span<std::uint8_t> bytes,
                                   std::vector<std::uint32_t>& nonFinite) const {
  const float gain = std::exp2(exposureEv);
  const auto encodeBy = [&](const auto& shownAt, const auto& byteAt) {
    for (std::size_t i = 0; i < linear.size(); i += 3) {
      // An infinite radiance would else be displayed as plain white.
      const bool isShown = isFinite(shownAt(i));
      if (!isShown) nonFinite.push_back(static_cast<std::uint32_t>(i / 3));
      for (std::size_t c = i; c < i + 3; ++c) bytes[c] = isShown ? byteAt(c) : std::uint8_t{0};
    }
  };
  if (m_impl->steps) {
    const ByteSteps& steps = *m_impl->steps;
    const auto exposedAt = [&](std::size_t i) {
      return std::array{linear[i] * gain, linear[i + 1] * gain, linear[i + 2] * gain};
    };
    return encodeBy(exposedAt, [&](std::size_t c) { return steps(linear[c] * gain); });
  }
  RawVector<float> encoded(linear.size());
  encode(linear, exposureEv, encoded);
  encodeBy([&](std::size_t i) { return std::span(encoded).subspan(i).first<3>(); },
           [&](std::size_t c) { return toByte(encoded[c]); });
}

const std::vector<std::string>& colorSpaceNames() {
  static const std::vector<std::string> kNames = {"linear", "srgb", "acescg", "aces2065-1"};
  return kNames;
}

Image toLinearRec709(const Image& rgb, const std::string& colorSpace) {
  if (std::find(colorSpaceNames().begin(), colorSpaceNames().end(), colorSpace) == colorSpaceNames().end())
    throw Error(ExitCode::usage, "colour space", "'" + colorSpace + "'",
                fmt::format("unknown; known are {}", fmt::join(colorSpaceNames(), ", ")));
  if (rgb.channels != 3 || rgb.empty())
    throw Error(ExitCode::failed, "colour space '" + colorSpace + "'", "",
                fmt::format("needs an RGB image, not one of {} channels", rgb.channels));
  if (colorSpace == "linear") return rgb;
  Image linear = rgb;
  try {
    const ocio::ConstCPUProcessorRcPtr processor = makeProcessor(makeDecoder(colorSpace));
    constexpr std::size_t kBandRows = 16;
    parallelFor(static_cast<std::size_t>(rgb.height), kBandRows, [&](std::size_t begin, std::size_t end) {
      const float* in = rgb.at(0, static_cast<int>(begin));
      float* out = linear.at(0, static_cast<int>(begin));
      ocio::PackedImageDesc band(out, rgb.width, static_cast<long>(end - begin), 3);
      processor->apply(band);
      // Approximate powers and clamps may make numbers of what is none.
      const std::size_t count = (end - begin) * rgb.width;
      for (std::size_t i = 0; i < 3 * count; i += 3)
        if (!std::isfinite(in[i]) || !std::isfinite(in[i + 1]) || !std::isfinite(in[i + 2]))
          std::fill_n(out + i, 3, std::numeric_limits<float>::quiet_NaN());
    });
  } catch (const ocio::Exception& error) {
    throw Error(ExitCode::failed, "OpenColorIO", "colour space '" + colorSpace + "'", error.what());
  }
  return linear;
}

} // namespace parity::base
