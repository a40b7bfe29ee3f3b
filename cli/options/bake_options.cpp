// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/bake_options.h"

#include <bit>
#include <charconv>

#include <fmt/format.h>

#include "cli/options/option_parts.h"

namespace parity::cli {

namespace {

CLI::Validator powerOfTwo(int least, int most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        int value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool isOne = error == std::errc() && end == text.data() + text.size() && value >= least &&
                           value <= most && std::has_single_bit(static_cast<unsigned>(value));
        return isOne ? std::string() : fmt::format("'{}' is not a power of two from {} to {}", text, least, most);
      },
      "N");
}

double parseDensity(const std::string& text) {
  if (text == "auto") return 0;
  const std::string wanted = "auto or a number of 0.01 to 1000000";
  const double density = readOption("--texels-per-metre", base::readNumbers, text, wanted).front();
  if (!(density >= 0.01 && density <= 1e6)) throw invalid("--texels-per-metre", text, wanted);
  return density;
}

int parseCaptures(const std::string& text) {
  if (text == "auto") return -1;
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 0 || count > job::kMaxCaptures)
    throw invalid("--captures", text, fmt::format("auto or a number from 0 to {}", job::kMaxCaptures));
  return count;
}

} // namespace

void addBakeOptions(CLI::App& app, BakeCommand& command, RawBakeOptions& raw) {
  job::BakeOptions& o = command.options;
  app.add_option("scenes", command.scenes, "Scene files or builtin:NAME");
  app.add_option("--suite", command.suite,
                 "Suite file (TOML): bakes each scene that names a folder by `baked`, into that")
      ->excludes("scenes");
  app.add_option("-o,--output", command.folder, "Folder of the bake; of several scenes: a folder in it for each");

  app.add_option("--bounces", o.integrate.bounces, "Times that diffuse light goes from surface to surface")
      ->check(CLI::Range(0, bake::kMaxBounces))
      ->group("Light")
      ->capture_default_str();
  app.add_option("--error", raw.error,
                 "Error over a texel's irradiance at which it is done: 19 of 20 texels are within it")
      ->group("Light")
      ->capture_default_str();
  app.add_option("--max-samples", o.integrate.maxSamples, "Of a texel in the mean, whatever the errors: a power of two")
      ->check(powerOfTwo(bake::kMinSamples, bake::kMaxSamples))
      ->group("Light")
      ->capture_default_str();
  app.add_option("--seed", o.integrate.seed, "Of the sampling: the same seed gives the same bake")
      ->group("Light")
      ->capture_default_str();
  app.add_option("--local-lights", raw.localLights,
                 "static: point and spot lights are baked for both paths, without highlights; stationary: the high-end "
                 "path shades them itself")
      ->check(CLI::IsMember({"static", "stationary"}))
      ->group("Light")
      ->capture_default_str();

  app.add_option("--texels-per-metre", raw.density,
                 "Of lightmaps and of the sun's shadow, at least. auto: 16, more of small scenes, fewer of huge ones")
      ->group("Textures")
      ->capture_default_str();
  app.add_option("--page-size", o.atlas.maxPageSide, "The largest side of a lightmap's page, texels: a power of two")
      ->check(powerOfTwo(64, 8192))
      ->group("Textures")
      ->capture_default_str();
  app.add_option("--astc", raw.astc, "Blocks of the encoded lightmap: 4x4, 6x6, or none (8 bits, not compressed)")
      ->check(CLI::IsMember({"4x4", "6x6", "none"}))
      ->group("Textures")
      ->capture_default_str();
  app.add_option("--captures", raw.captures, "Environment captures: a number, or auto. A suite may say where")
      ->group("Textures")
      ->capture_default_str();
  app.add_option("--capture-size", o.captureSize, "Texels along a face of a capture: a power of two")
      ->check(powerOfTwo(lighting::kMinFaceSize, lighting::kMaxFaceSize))
      ->group("Textures")
      ->capture_default_str();
}

BakeCommand settleBake(const BakeCommand& given, const RawBakeOptions& raw, const CLI::App& app) {
  BakeCommand command = given;
  if (command.scenes.empty() && command.suite.empty()) throw CLI::RequiredError("bake: a SCENE or --suite");
  if (command.suite.empty() && command.folder.empty()) throw CLI::RequiredError("--output");
  if (!command.suite.empty()) {
    if (app.count("--output") > 0) throw CLI::ExcludesError("--suite", "--output");
  }
  command.options.integrate.error = readOption("--error", base::readShare, raw.error);
  command.options.captures = parseCaptures(raw.captures);
  command.options.atlas.texelsPerMetre = parseDensity(raw.density);
  command.options.astc = raw.astc == "none"  ? base::AstcBlock::none
                         : raw.astc == "4x4" ? base::AstcBlock::astc4x4
                                             : base::AstcBlock::astc6x6;
  command.options.localLights =
      raw.localLights == "static" ? bake::LocalLights::isStatic : bake::LocalLights::isStationary;
  return command;
}

} // namespace parity::cli
