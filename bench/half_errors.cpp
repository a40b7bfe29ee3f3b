// What half precision costs the mobile path's formulas: their relative error against f64 at the same inputs, and what
// is not finite. build/half_errors prints docs/half-errors.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "study/stress/function_table.h"

namespace {

using namespace parity::stress;

constexpr int kRows = 100'000;

// The functions that only the mobile path calls in half.
constexpr std::array kMobile = {kFnEnvBRDFApprox,
                                kFnEnvBRDFApproxUE4,
                                kFnEnvBRDFApproxNonmetal,
                                kFnFullyRough,
                                kFnD_Approx,
                                kFnPhongApprox,
                                kFnGGX_Mobile,
                                kFnCalcSpecular,
                                kFnSpotAttenuation,
                                kFnMipFromRoughness,
                                kFnDiffuseColor,
                                kFnSpecularColor,
                                kFnDecodeRgbm,
                                kFnGetSkySHDiffuseSimple,
                                kFnGetSkySHDiffuse,
                                kFnInitShadingModelContext,
                                kFnReflectionVector,
                                kFnHalfVector,
                                kFnCosineOf,
                                kFnMobileIntegrateBxDF,
                                kFnLightWith,
                                kFnLuminanceUE4,
                                kFnCaptureScale,
                                kFnSpecularIBL,
                                kFnModulate,
                                kFnLocalLightAt,
                                kFnRefitLobe,
                                kFnRefitTap,
                                kFnRefitDirection,
                                kFnRefitHalfVector,
                                kFnRefitLight};

} // namespace

int main() {
  fmt::print(
      "# What half precision costs each formula of the mobile path\n"
      "\n"
      "The table gives the relative error of half precision, function by function. `build/half_errors` makes this\n"
      "page.\n"
      "\n"
      "- Each function gets {} rows of inputs, rounded to half (study/stress/random_rows.cpp gives the ranges).\n"
      "- The half code rounds every operation. Its result is compared with f64 at the same inputs.\n"
      "- The error is relative to the row's largest output.\n"
      "- Device and CPU agree in half bit for bit (tests/shading/device_test.cpp). So the formulas cause the errors,\n"
      "  not a driver.\n"
      "- \"Outside\" are rows with a largest output below half's smallest normal number, 2^-14, or above 65504, where\n"
      "  half saturates. They are left out.\n"
      "\n"
      "| function | median | 99 % | 99.9 % | largest | not finite | outside |\n|---|---|---|---|---|---|---|\n",
      kRows);
  for (const FunctionCase& function : functionTable()) {
    if (std::find(kMobile.begin(), kMobile.end(), function.id) == kMobile.end()) continue;
    Random random(1);
    std::vector<double> errors;
    int notFinite = 0, outside = 0;
    for (int r = 0; r < kRows; ++r) {
      const Row row = roundToHalf(function.makeRow(random));
      const Result exact = evaluate64(function.id, row), half = evaluate16(function.id, row);
      double largest = 0, error = 0;
      bool finite = true;
      for (int k = 0; k < kOutputs; ++k) {
        finite = finite && std::isfinite(half[k]);
        largest = std::max(largest, std::fabs(exact[k]));
        error = std::max(error, std::fabs(half[k] - exact[k]));
      }
      if (!finite) ++notFinite;
      if (!(largest >= 0x1p-14 && largest <= 65504))
        ++outside;
      else if (finite)
        errors.push_back(error / largest);
    }
    std::sort(errors.begin(), errors.end());
    const auto at = [&](double share) {
      return 100 * errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
    };
    fmt::print("| {} | {:.3g} % | {:.3g} % | {:.3g} % | {:.3g} % | {} | {:.1f} % |\n", function.name, at(0.5), at(0.99),
               at(0.999), at(1), notFinite, 100.0 * outside / kRows);
  }
  return 0;
}
