// The colour transforms by OpenColorIO. Version 2.1 ships no configs, so each transform is put together here.
#include "base/image/color.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/parallel.h"

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

} // namespace

struct DisplayTransform::Impl {
  ocio::ConstCPUProcessorRcPtr processor; // null: nothing but the clamp
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
  const float gain = std::exp2(exposureEv);
  Image encoded(linear.width, linear.height, 3);
  constexpr std::size_t kBandRows = 16;
  parallelFor(static_cast<std::size_t>(linear.height), kBandRows, [&](std::size_t begin, std::size_t end) {
    const float* in = linear.at(0, static_cast<int>(begin));
    float* out = encoded.at(0, static_cast<int>(begin));
    const std::size_t count = (end - begin) * linear.width * 3;
    for (std::size_t i = 0; i < count; ++i) {
      const float exposed = in[i] * gain;
      out[i] = std::isfinite(exposed) ? exposed : 0.0f; // tables are not to be looked up with NaN
    }
    if (m_impl->processor) {
      ocio::PackedImageDesc band(out, linear.width, static_cast<long>(end - begin), 3);
      m_impl->processor->apply(band);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const float exposed = in[i] * gain;
      out[i] = std::isfinite(exposed) ? std::clamp(out[i], 0.0f, 1.0f) : exposed;
    }
  });
  return encoded;
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
