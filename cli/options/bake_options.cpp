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
  const std::string wanted = "auto or a number from 0.01 to 1000000";
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
  app.add_option("scenes", command.scenes, "Scene files or builtin:NAME; -: one a line from standard input")
      ->type_name(kSceneFile);
  app.add_option("--suite", command.suite,
                 "Suite file (TOML): bakes each scene that has the key `baked`, into the folder it names")
      ->type_name(kFile)
      ->group(kInputGroup)
      ->excludes("scenes");
  command.folder = "parity-bake";
  app.add_option("-o,--output", command.folder, "Folder for the bake. Each of several scenes gets a folder inside it")
      ->type_name(kFolder)
      ->group(kOutputGroup)
      ->capture_default_str();

  app.add_option("--bounces", o.integrate.bounces, "Bounces of diffuse light between surfaces")
      ->check(wholeWithin(0, bake::kMaxBounces))
      ->group("Light")
      ->capture_default_str();
  app.add_option("--error", raw.error, "Relative error at which a texel is done: 19 of 20 texels are within it")
      ->group("Light")
      ->capture_default_str();
  app.add_option("--max-samples", o.integrate.maxSamples,
                 "Most samples a texel on average, whatever the error: a power of two")
      ->check(powerOfTwo(bake::kMinSamples, bake::kMaxSamples))
      ->group("Light")
      ->capture_default_str();
  app.add_option("--seed", o.integrate.seed, "Seed of the random samples: the same seed gives the same bake")
      ->group("Light")
      ->capture_default_str();
  choose(app.add_option("--local-lights", raw.localLights,
                        "Point and spot lights. static: baked for both paths, without highlights;\n"
                        "stationary: the high-end path shades them"),
         {"static", "stationary"})
      ->group("Light")
      ->capture_default_str();

  app.add_option("--texels-per-metre", raw.density,
                 "Least texels a metre, of lightmaps and of the sun's shadow.\n"
                 "auto: 16; more for small scenes, fewer for huge ones")
      ->group("Textures")
      ->capture_default_str();
  app.add_option("--page-size", o.atlas.maxPageSide, "Largest side of a lightmap page in texels: a power of two")
      ->check(powerOfTwo(64, 8192))
      ->group("Textures")
      ->capture_default_str();
  choose(
      app.add_option("--astc", raw.astc, "Blocks of the encoded lightmap: 4x4, 6x6, or none (8 bits, not compressed)"),
      {"4x4", "6x6", "none"})
      ->group("Textures")
      ->capture_default_str();
  app.add_option("--captures", raw.captures, "Number of environment captures, or auto. A suite can set their places")
      ->group("Textures")
      ->capture_default_str();
  app.add_option("--capture-size", o.captureSize, "Side of a capture's face in texels: a power of two")
      ->check(powerOfTwo(lighting::kMinFaceSize, lighting::kMaxFaceSize))
      ->group("Textures")
      ->capture_default_str();
}

BakeCommand settleBake(const BakeCommand& given, const RawBakeOptions& raw, const CLI::App& app) {
  BakeCommand command = given;
  if (command.scenes.empty() && command.suite.empty()) throw CLI::RequiredError("bake: SCENE or --suite");
  if (command.suite.empty() && command.folder.empty()) throw CLI::ValidationError("--output", "names no folder");
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
