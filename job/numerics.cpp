#include "job/numerics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <span>

#include <gnu/libc-version.h>
#include <hwy/targets.h>

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
  static constexpr std::array<Function, 12> kFunctions = {std::sin,  std::cos,  std::tan,   std::asin,  std::acos, std::atan,
                                                          std::exp,  std::exp2, std::log,   std::log2,  std::log10, std::cbrt};
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
    for (float& value : image.pixels) value = static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24f;
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

std::string measure(Context& context) {
  base::Hasher hasher;
  addLibm<float>(hasher);
  addLibm<double>(hasher);
  addSimd(hasher);
  const std::vector<std::uint32_t> device = gpu::numericsOf(context.device());
  hasher.add(std::as_bytes(std::span{device}));
  return hasher.hex();
}

} // namespace

std::string numericsId(Context& context) {
  if (!context.cache().enabled()) return measure(context);
  const gpu::DeviceReport& device = context.deviceReport();
  base::Hasher hasher;
  for (const std::string& text : {context.buildId(), device.name, device.driver, device.build, processor(),
                                  std::string(gnu_get_libc_version())})
    hasher.add(text);
  const std::string key = "numerics-" + hasher.addValue(static_cast<std::int64_t>(hwy::SupportedTargets())).hex();
  if (const auto bytes = context.cache().find(key))
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
  const std::string id = measure(context);
  context.cache().store(key, std::as_bytes(std::span{id}));
  return id;
}

} // namespace parity::job
