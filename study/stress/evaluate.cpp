#include "study/stress/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shading/shading.h"

// evaluate.glsl is written in the shared subset; its macros mean what they mean in shading/shading.h.
#define FN inline
#define R(x) real(x)
#define R32(x) real32(x)
namespace parity::stress::at64 {
using namespace parity::shading::f64;
#include "study/stress/shaders/evaluate.glsl"
#include "study/stress/shaders/evaluate_baked.glsl"
#include "study/stress/shaders/evaluate_base_pass.glsl"
inline Outputs evaluateAny(int id, const Inputs& inputs) {
  if (id < kFirstOfBasePass) return evaluate(id, inputs);
  return id < kFirstOfBaked ? evaluateBasePass(id, inputs) : evaluateBaked(id, inputs);
}
} // namespace parity::stress::at64
namespace parity::stress::at32 {
using namespace parity::shading::f32;
#include "study/stress/shaders/evaluate.glsl"
#include "study/stress/shaders/evaluate_baked.glsl"
#include "study/stress/shaders/evaluate_base_pass.glsl"
inline Outputs evaluateAny(int id, const Inputs& inputs) {
  if (id < kFirstOfBasePass) return evaluate(id, inputs);
  return id < kFirstOfBaked ? evaluateBasePass(id, inputs) : evaluateBaked(id, inputs);
}
} // namespace parity::stress::at32
namespace parity::stress::at16 {
using namespace parity::shading::f16;
#include "study/stress/shaders/evaluate.glsl"
#include "study/stress/shaders/evaluate_baked.glsl"
#include "study/stress/shaders/evaluate_base_pass.glsl"
inline Outputs evaluateAny(int id, const Inputs& inputs) {
  if (id < kFirstOfBasePass) return evaluate(id, inputs);
  return id < kFirstOfBaked ? evaluateBasePass(id, inputs) : evaluateBaked(id, inputs);
}
} // namespace parity::stress::at16
#undef FN
#undef R
#undef R32

namespace parity::stress {

namespace {

template <typename Out> Result toResult(const Out& out) {
  Result result;
  for (int i = 0; i < kOutputs; ++i) result[i] = out.y[i];
  return result;
}

} // namespace

const char* nameOf(Precision precision) {
  return precision == Precision::f64 ? "fp64" : precision == Precision::f32 ? "fp32" : "fp16";
}

Result evaluate64(int id, const Row& row) {
  at64::Inputs inputs;
  for (int i = 0; i < kInputs; ++i) inputs.x[i] = row[i];
  return toResult(at64::evaluateAny(id, inputs));
}

Result evaluate32(int id, const Row& row) {
  at32::Inputs inputs;
  for (int i = 0; i < kInputs; ++i) inputs.x[i] = static_cast<float>(row[i]);
  return toResult(at32::evaluateAny(id, inputs));
}

Result evaluate16(int id, const Row& row) { return evaluateRounded(Precision::f16, id, roundToHalf(row)); }

Result evaluateRounded(Precision precision, int id, const Row& row) {
  if (precision == Precision::f64) return evaluate64(id, row);
  if (precision == Precision::f32) return evaluate32(id, row);
  at16::Inputs inputs;
  for (int i = 0; i < kInputs; ++i) inputs.x[i] = static_cast<float>(row[i]);
  return toResult(at16::evaluateAny(id, inputs));
}

Row roundToHalf(const Row& row) {
  Row rounded;
  for (int i = 0; i < kInputs; ++i) rounded[i] = shading::Half(row[i]);
  return rounded;
}

Format formatOf(Precision precision) {
  if (precision == Precision::f16) return {kMantissa16, kMinExponent16, 0x1p-14, 65504};
  if (precision == Precision::f32) return {kMantissa32, kMinExponent32, 0x1p-126, std::numeric_limits<float>::max()};
  return {52, -1022, 0x1p-1022, std::numeric_limits<double>::max()};
}

double ulpDistance(double actual, double expected, double scale, int mantissaBits, int minExponent) {
  if (actual == expected || (std::isnan(actual) && std::isnan(expected))) return 0;
  if (!std::isfinite(actual) || !std::isfinite(expected)) return std::numeric_limits<double>::infinity();
  const double magnitude = std::max(std::fabs(expected), scale);
  const int exponent = magnitude > 0 ? std::max(std::ilogb(magnitude), minExponent) : minExponent;
  return std::fabs(actual - expected) / std::ldexp(1.0, exponent - mantissaBits);
}

} // namespace parity::stress
