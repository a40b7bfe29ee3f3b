// parity flip: any two images.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/color.h"
#include "base/error.h"
#include "base/image_io.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "compare/flip.h"
#include "compare/magma.h"
#include "compare/metrics.h"

namespace parity::cli {

namespace {

// Display-encoded RGB: integer files are that already (alpha is dropped, grey is spread); float files are linear and go
// through sRGB.
base::Image readDisplayed(const std::string& file) {
  const base::Image image = base::readImage(file);
  base::Image rgb(image.width, image.height, 3);
  const int colors = image.channels >= 3 ? 3 : 1;
  for (std::size_t p = 0; p < image.pixelCount(); ++p)
    for (int c = 0; c < 3; ++c) rgb.pixels[3 * p + c] = image.pixels[p * image.channels + (colors == 3 ? c : 0)];
  compare::requireFinite(rgb, file.c_str());
  return base::isIntegerImage(file) ? rgb : base::DisplayTransform("sRGB").apply(rgb);
}

} // namespace

int runFlipCommand(const FlipCommand& command) {
  const base::Image reference = readDisplayed(command.reference), test = readDisplayed(command.test);
  if (reference.width != test.width || reference.height != test.height)
    throw base::Error(base::ExitCode::notComparable, command.test, fmt::format("{}x{}", test.width, test.height),
                      fmt::format("the reference is {}x{}", reference.width, reference.height));
  compare::FlipOptions options;
  if (command.ppd > 0) options.ppd = command.ppd;
  const base::Image map = compare::flipMap(reference, test, options);
  const compare::Pooling pooling = compare::poolMap(map);
  const double rmse = compare::rmse(reference, test), psnr = compare::psnr(reference, test);
  if (!command.output.empty()) {
    const bool shown = extensionOf(command.output) == ".png";
    base::writeImage(command.output, shown ? compare::magmaImage(map) : map);
  }
  if (!command.json.empty()) {
    const nlohmann::ordered_json json = {
        {"reference", command.reference},
        {"test", command.test},
        {"width", map.width},
        {"height", map.height},
        {"ppd", options.ppd},
        {"flip",
         {{"mean", pooling.mean},
          {"weightedMedian", pooling.weightedMedian},
          {"weightedQ1", pooling.weightedQ1},
          {"weightedQ3", pooling.weightedQ3},
          {"min", pooling.min},
          {"max", pooling.max}}},
        {"rmse", rmse},
        {"psnr", std::isfinite(psnr) ? nlohmann::ordered_json(psnr) : nlohmann::ordered_json()}};
    writeJson(command.json, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  }
  if (command.json != "-")
    fmt::print("mean            {:.6f}\nweighted median {:.6f}\nweighted Q1     {:.6f}\nweighted Q3     {:.6f}\nmin    "
               "         {:.6f}\nmax             "
               "{:.6f}\nRMSE            {:.6f}\nPSNR            {}\n",
               pooling.mean, pooling.weightedMedian, pooling.weightedQ1, pooling.weightedQ3, pooling.min, pooling.max,
               rmse, std::isfinite(psnr) ? fmt::format("{:.2f} dB", psnr) : "identical");
  return 0;
}

} // namespace parity::cli
