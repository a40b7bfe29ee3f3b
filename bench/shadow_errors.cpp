// Shadow maps against rays, light by light.
//   build/shadow_errors [--map-size N] [--filter N] [--size N] [--pictures FOLDER] SCENE...
// SCENE: a file, builtin:NAME, or either with :AZIMUTH,ELEVATION appended after '@' for a sun in place of its own
// lights.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/image/image.h"
#include "base/image/image_io.h"
#include "scenes/load.h"
#include "scenes/view.h"
#include "study/shadows/shadow_error.h"

namespace parity {
namespace {

void writePicture(const std::string& file, const shadows::VisibilityError& error, std::uint32_t side) {
  const int n = static_cast<int>(side);
  base::Image8 picture(4 * n, n, 3, 0);
  const auto put = [&](int x, std::size_t pixel, float r, float g, float b) {
    const std::size_t at = 3 * (pixel / side * 4 * side + static_cast<std::size_t>(x) * side + pixel % side);
    const float rgb[] = {r, g, b};
    for (std::size_t c = 0; c < 3; ++c)
      picture.pixels[at + c] = static_cast<std::uint8_t>(std::min(1.f, std::max(0.f, rgb[c])) * 255 + 0.5f);
  };
  for (std::size_t i = 0; i < error.map.size(); ++i) {
    put(0, i, error.map[i], error.map[i], error.map[i]);
    put(1, i, error.exact[i], error.exact[i], error.exact[i]);
    const float d = error.difference[i];
    put(2, i, d, 0, -d); // red: light where there is none; blue: shadow
    const float b = error.band[i];
    put(3, i, b ? 0 : d, b * 0.3f, b ? 0 : -d);
  }
  base::writeImage8(file, picture);
}

int run(const std::vector<std::string>& arguments) {
  gpu::ShadowOptions options;
  std::uint32_t side = 512;
  std::string pictures;
  std::vector<std::string> scenesToMeasure;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool hasValue = i + 1 < arguments.size();
    const auto number = [&] { return static_cast<std::uint32_t>(std::stoul(arguments[++i])); };
    if (arguments[i] == "--map-size" && hasValue)
      options.mapSize = number();
    else if (arguments[i] == "--filter" && hasValue)
      options.filter = number();
    else if (arguments[i] == "--size" && hasValue)
      side = number();
    else if (arguments[i] == "--pictures" && hasValue)
      pictures = arguments[++i];
    else
      scenesToMeasure.push_back(arguments[i]);
  }
  const gpu::Device device{gpu::DeviceOptions{}};
  fmt::print("| scene | light | outside | mean error | too dark | too light | inside | mean error |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (const std::string& argument : scenesToMeasure) {
    const std::size_t at = argument.find('@');
    scenes::Scene scene = scenes::loadScene(argument.substr(0, at), {});
    if (at != std::string::npos) {
      const std::size_t comma = argument.find(',', at);
      scenes::Light sun = scenes::makeSun({.azimuthDeg = std::stof(argument.substr(at + 1, comma - at - 1)),
                                           .elevationDeg = std::stof(argument.substr(comma + 1)),
                                           .lux = 1});
      sun.name = "sun " + argument.substr(at + 1);
      scene.lights = {sun};
    }
    const scenes::Camera camera = scenes::makeCamera(scene, {}, 1);
    for (std::size_t k = 0; k < scene.lights.size(); ++k) {
      const scenes::Light& light = scene.lights[k];
      const auto error = shadows::measureVisibility(
          device, {.scene = scene, .camera = camera, .width = side, .height = side, .options = options}, light);
      fmt::print("| {} | {} | {} | {:.5f} | {} | {} | {} | {:.4f} |\n", scene.name, light.name, error.outside,
                 error.outsideMean, error.acne, error.leaks, error.inside, error.insideMean);
      if (!pictures.empty()) writePicture(fmt::format("{}/{}-{}.png", pictures, scene.name, k), error, side);
    }
  }
  return 0;
}

} // namespace
} // namespace parity

int main(int count, char** arguments) {
  try {
    return parity::run({arguments + 1, arguments + count});
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
