// HDR environments from image files, cleaned of what no renderer can use.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/file.h"
#include "base/image/image_io.h"
#include "base/log.h"
#include "scenes/builtin/builtin.h"
#include "scenes/environment.h"
#include "scenes/load.h"
#include "scenes/names.h"

namespace parity::scenes {

namespace {

// Where R, G and B lie among the channels.
std::array<std::size_t, 3> findColors(const base::ImageInfo& info, const std::string& label) {
  const std::vector<std::string>& names = info.channelNames;
  const auto find = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::array<std::size_t, 3> colors = {find("R"), find("G"), find("B")};
  const auto isThere = [&](std::size_t channel) { return channel < names.size(); };
  if (std::all_of(colors.begin(), colors.end(), isThere)) return colors;
  // Chroma beside Y (RY, BY) would be colour that is lost.
  const bool isGrey = std::all_of(names.begin(), names.end(),
                                  [](const std::string& name) { return name == "Y" || name == "A" || name == "Z"; });
  if (const std::size_t grey = find("Y"); isGrey && isThere(grey)) return {grey, grey, grey};
  throw base::fileError(label, "",
                        fmt::format("has the channels {}; an environment needs R, G and B, or Y",
                                    cleanName(fmt::format("{}", fmt::join(names, ", ")))));
}

} // namespace

base::Image toUpright(base::Image image, int orientation) {
  if (orientation <= 1 || orientation > 8) return image;
  const bool isTransposed = orientation >= 5;
  const auto stored = [&](int x, int y) {
    const int right = image.width - 1, bottom = image.height - 1;
    switch (orientation) {
    case 2:
      return image.at(right - x, y);
    case 3:
      return image.at(right - x, bottom - y);
    case 4:
      return image.at(x, bottom - y);
    case 5:
      return image.at(y, x);
    case 6:
      return image.at(y, bottom - x);
    case 7:
      return image.at(right - y, bottom - x);
    default:
      return image.at(right - y, x);
    }
  };
  base::Image upright(isTransposed ? image.height : image.width, isTransposed ? image.width : image.height,
                      image.channels);
  for (int y = 0; y < upright.height; ++y)
    for (int x = 0; x < upright.width; ++x) std::copy_n(stored(x, y), image.channels, upright.at(x, y));
  return upright;
}

base::Image toPanorama(base::ImageFile file, const std::string& label) {
  const base::ImageInfo& info = file.info;
  base::Image& pixels = file.pixels;
  if (pixels.empty()) throw base::fileError(label, "", "the image has no pixels");
  if (info.isCubeMap) throw base::fileError(label, "envmap", "is a cube map; give a latitude-longitude panorama");
  if (info.x != info.fullX || info.y != info.fullY || pixels.width != info.fullWidth ||
      pixels.height != info.fullHeight)
    throw base::fileError(
        label, "dataWindow",
        fmt::format("holds {}x{} pixels at {:+}{:+} of a picture of {}x{} at {:+}{:+}; an environment "
                    "must be complete",
                    pixels.width, pixels.height, info.x, info.y, info.fullWidth, info.fullHeight, info.fullX,
                    info.fullY));
  const std::array<std::size_t, 3> colors = findColors(info, label);
  if (pixels.channels != 3 || colors != std::array<std::size_t, 3>{0, 1, 2}) {
    base::Image rgb(pixels.width, pixels.height, 3);
    for (std::size_t i = 0; i < pixels.pixelCount(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        rgb.pixels[3 * i + c] = pixels.pixels[i * static_cast<std::size_t>(pixels.channels) + colors[c]];
    pixels = std::move(rgb);
  }
  base::Image upright = toUpright(std::move(pixels), info.orientation);
  if (upright.width != 2 * upright.height)
    throw base::fileError(label, "",
                          fmt::format("has {}x{} pixels; a latitude-longitude panorama must be twice as wide as high",
                                      upright.width, upright.height));
  return upright;
}

CleanedCounts cleanRadiance(base::Image& radiance, const std::string& label) {
  float largest = -1;
  for (const float value : radiance.pixels)
    if (std::isfinite(value)) largest = std::max(largest, value);
  if (largest < 0 &&
      std::none_of(radiance.pixels.begin(), radiance.pixels.end(), [](float value) { return std::isfinite(value); }))
    throw base::fileError(label, "", "no pixel of the environment is finite");
  largest = std::max(largest, 0.f);
  CleanedCounts counts;
  for (float& value : radiance.pixels) {
    if (std::isnan(value)) {
      ++counts.notANumber;
      value = 0;
    } else if (value < 0) { // -infinity too
      ++counts.negative;
      value = 0;
    } else if (value < kMinRadiance) {
      value = 0;
    } else if (std::isinf(value)) {
      ++counts.infinite;
      value = largest;
    }
    if (value > kMaxRadiance) {
      ++counts.tooLarge;
      value = kMaxRadiance;
    }
  }
  return counts;
}

Environment loadEnvironment(const std::string& fileOrBuiltin, float rotationDeg, std::vector<std::string>& warnings,
                            const LoadOptions& options) {
  if (!std::isfinite(rotationDeg))
    throw base::Error(base::ExitCode::usage, "--env-rotation", "", "not a finite number of degrees");
  Environment environment;
  if (isBuiltin(fileOrBuiltin))
    environment = makeBuiltinEnvironment(fileOrBuiltin.substr(kBuiltinPrefix.size()));
  else {
    const std::filesystem::path file(fileOrBuiltin);
    const base::ImageLimits limits{.maxSide = options.maxImageSide, .maxBytes = options.maxMemoryBytes};
    environment.name = cleanName(file.stem().string());
    try {
      environment.radiance =
          toPanorama(base::decodeRadiance(base::readFile(file), fileOrBuiltin, limits), fileOrBuiltin);
    } catch (const base::Error& error) { // the reader may know the file by another name
      const std::vector<std::string> names = builtinEnvironmentNames();
      if (std::find(names.begin(), names.end(), fileOrBuiltin) != names.end())
        throw base::fileError(fileOrBuiltin, "environment",
                              fmt::format("is no file; did you mean 'builtin:{}'?", fileOrBuiltin));
      throw base::fileError(fileOrBuiltin, error.place(), error.reason());
    }
    const CleanedCounts counts = cleanRadiance(environment.radiance, fileOrBuiltin);
    if (counts.notANumber + counts.infinite + counts.negative > 0)
      warnings.push_back(fmt::format("environment {}: of {} values, {} NaN and {} negative ones are set to 0, and {} "
                                     "infinite ones to the largest finite value",
                                     environment.name, environment.radiance.pixels.size(), counts.notANumber,
                                     counts.negative, counts.infinite));
    if (counts.tooLarge > 0)
      warnings.push_back(fmt::format("environment {}: {} of {} values are above {:g} and are set to it",
                                     environment.name, counts.tooLarge, environment.radiance.pixels.size(),
                                     kMaxRadiance));
  }
  environment.rotationDeg = rotationDeg;
  base::logDetail(fmt::format("environment {}: {} x {} pixels", fileOrBuiltin, environment.radiance.width,
                              environment.radiance.height));
  return environment;
}

} // namespace parity::scenes
