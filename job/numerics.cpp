#include "job/numerics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "base/hash.h"
#include "compare/flip/flip.h"
#include "gpu/device/numerics.h"
#include "job/context.h"

namespace parity::job {

namespace {

constexpr int kInputs = 512;

// As the compiler cannot fold it.
template <typename T> void addLibm(base::Hasher& hasher) {
  using Function = T (*)(T);
  static constexpr std::array<Function, 12> kFunctions = {std::sin,  std::cos,  std::tan,   std::asin,
                                                          std::acos, std::atan, std::exp,   std::exp2,
                                                          std::log,  std::log2, std::log10, std::cbrt};
  volatile T step = T(1) / kInputs;
  for (int i = 0; i < kInputs; ++i) {
    const T x = (static_cast<T>(i) + T(0.37)) * step; // ]0,1[
    for (const Function function : kFunctions) hasher.addValue(function(x));
    hasher.addValue(std::pow(x, T(2.2) + x)).addValue(std::atan2(x, T(0.3))).addValue(std::fma(x, x, -x));
  }
}

// FLIP runs every vectorised kernel: transfer function, colour spaces, filters, powers.
void addSimd(base::Hasher& hasher) {
  constexpr int kSide = 48;
  std::array<base::Image, 2> images = {base::Image(kSide, kSide, 3), base::Image(kSide, kSide, 3)};
  std::uint32_t state = 1;
  for (base::Image& image : images)
    for (float& value : image.pixels)
      value = static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24f;
  const base::Image map = compare::flipMap(images[0], images[1]);
  hasher.add(std::as_bytes(std::span{map.pixels}));
}

// The processor, as the system names it: which code libraries choose depends on it.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string text;
  for (std::string line; std::getline(file, line) && !line.empty();)
    for (const char* key : {"model name", "flags", "Features", "CPU part"})
      if (line.starts_with(key)) text += line + '\n';
  return text;
}

// What the environment tells Mesa and its compiler, sorted.
std::string driverVariables() {
  std::set<std::string> told;
  for (char** entry = environ; *entry; ++entry)
    for (const char* prefix : {"LP_", "GALLIVM_", "MESA_", "LIBGL_", "VK_", "RADV_", "AMD_", "ACO_", "NIR_", "INTEL_",
                               "ANV_", "NVK_", "__GL_"})
      if (const std::string text = *entry; text.starts_with(prefix) && !text.starts_with("MESA_SHADER_CACHE"))
        told.insert(text);
  return fmt::format("{}", fmt::join(told, "\n"));
}

std::string measureDevice(Context& context) {
  const std::vector<std::uint32_t> words = gpu::numericsOf(context.device());
  return base::Hasher().add(std::as_bytes(std::span{words})).hex();
}

std::string deviceNumerics(Context& context) {
  if (!context.cache().enabled()) return measureDevice(context);
  const gpu::DeviceReport& device = context.deviceReport();
  base::Hasher hasher;
  for (const std::string& text :
       {context.buildId(), device.name, device.driver, device.build, processor(), driverVariables()})
    hasher.add(text);
  const std::string key = "numerics-" + hasher.hex();
  if (const auto bytes = context.cache().find(key))
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
  const std::string id = measureDevice(context);
  context.cache().store(key, std::as_bytes(std::span{id}));
  return id;
}

} // namespace

const std::string& hostNumerics() {
  static const std::string id = [] {
    base::Hasher hasher;
    addLibm<float>(hasher);
    addLibm<double>(hasher);
    addSimd(hasher);
    return hasher.hex();
  }();
  return id;
}

std::string numericsId(Context& context) {
  return base::Hasher().add(hostNumerics()).add(deviceNumerics(context)).hex();
}

} // namespace parity::job
