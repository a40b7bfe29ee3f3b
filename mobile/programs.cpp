#include "mobile/programs.h"

#include <algorithm>
#include <iterator>

#include "base/error.h"
#include "mobile/knobs.h"
#include "mobile_shaders/mobile_fp16.comp.h"
#include "mobile_shaders/mobile_fp32.comp.h"
#include "mobile_shaders/mobile_lobes_fp16.comp.h"
#include "mobile_shaders/mobile_lobes_fp32.comp.h"
#include "mobile_shaders/mobile_wide_fp16.comp.h"
#include "mobile_shaders/mobile_wide_fp32.comp.h"
#include "mobile_texts/texts.h"
#include "shading/shading.h"

namespace parity::mobile {

namespace {

constexpr const char *kFp16 = "PARITY_FP16", *kLobes = "PARITY_LOBES", *kWide = "PARITY_WIDE";

paths::ProgramMacros macrosOf(const ProgramKind& kind) {
  paths::ProgramMacros macros;
  if (kind.precision == Precision::fp16) macros.emplace_back(kFp16);
  if (kind.lobes || kind.wide) macros.emplace_back(kLobes);
  if (kind.wide) macros.emplace_back(kWide);
  return macros;
}

paths::BuiltInProgram builtIn(const paths::ProgramMacros& macros) {
  const auto has = [&](const char* macro) { return std::ranges::count(macros, macro) > 0; };
  const bool half = has(kFp16);
  if (has(kWide))
    return half ? paths::BuiltInProgram{kMobileWideFp16Comp, kMobileWideFp16CompWritten}
                : paths::BuiltInProgram{kMobileWideFp32Comp, kMobileWideFp32CompWritten};
  if (has(kLobes))
    return half ? paths::BuiltInProgram{kMobileLobesFp16Comp, kMobileLobesFp16CompWritten}
                : paths::BuiltInProgram{kMobileLobesFp32Comp, kMobileLobesFp32CompWritten};
  return half ? paths::BuiltInProgram{kMobileFp16Comp, kMobileFp16CompWritten}
              : paths::BuiltInProgram{kMobileFp32Comp, kMobileFp32CompWritten};
}

std::string_view declarations() {
  const auto& texts = gpu::sharedShaderTexts();
  return std::ranges::find(texts, "shading/mobile_preset.glsl", &gpu::ShaderText::path)->text;
}

paths::PresetHost makeHost() {
  paths::PresetHost host{
      .path = "mobile",
      .bases = presetNames(),
      .knobs = {},
      .functions = paths::presetFunctionsOf(declarations()),
      .texts = {std::begin(kMobileShaderTexts), std::end(kMobileShaderTexts)},
      .root = "mobile/shaders/mobile.glsl",
      .checked = {macrosOf({.precision = Precision::fp32}), macrosOf({.precision = Precision::fp16})},
      .counted = {0, ~0u, 0, 1, 1, 1, 0, 0, numberOf(EnvironmentBrdf::own), numberOf(DirectLobe::own)},
      .unfolded = macrosOf({.precision = Precision::fp32, .lobes = true, .wide = true}),
      .builtIn = builtIn};
  for (const auto& row : knobs().rows())
    if (row.knob.isOption && row.knob.id != "mobile-preset") host.knobs.push_back(row.knob);
  return host;
}

} // namespace

gpu::Spirv programOf(const Options& options, const ProgramKind& kind) {
  return paths::programOf(presetHost(), options.own.get(), macrosOf(kind));
}

std::vector<std::uint32_t> probeProgramOf(const Options& options, Precision precision) {
  paths::ProgramMacros macros = macrosOf({.precision = precision});
  macros.emplace_back("PARITY_PROBE");
  return paths::compileProgram(presetHost(), options.own.get(), macros, "mobile/shaders/probe.glsl");
}

// The shader's numbers have refit's forms of nonmetals between.
std::uint32_t numberOf(EnvironmentBrdf environmentBrdf) {
  return static_cast<std::uint32_t>(environmentBrdf == EnvironmentBrdf::own ? shading::f32::kEnvironmentBrdfOwn
                                                                            : static_cast<int>(environmentBrdf));
}
std::uint32_t numberOf(DirectLobe directLobe) {
  return static_cast<std::uint32_t>(directLobe == DirectLobe::own ? shading::f32::kSunOwn
                                                                  : static_cast<int>(directLobe));
}

const paths::PresetHost& presetHost() {
  static const paths::PresetHost host = makeHost();
  return host;
}

Options optionsOfFolder(const std::string& text, const Options& plain) {
  const std::shared_ptr<const paths::PresetFolder> folder = paths::readPresetFolder(text, presetHost());
  Options options = withRest(presetByName(folder->base()), plain);
  options.own = folder;
  options.preset = folder->text();
  if (const auto found = folder->knobs().find("direct-lobe");
      found != folder->knobs().end() && folder->defines("presetDirectLobe"))
    throw base::fileError(found->second.where, "", "has no effect beside presetDirectLobe; leave out one of them");
  paths::applyKnobs(knobs(), options, *folder);
  if (folder->defines("presetEnvironmentBrdf")) options.environmentBrdf = EnvironmentBrdf::own;
  if (folder->defines("presetDirectLobe")) options.directLobe = DirectLobe::own;
  return options;
}

} // namespace parity::mobile
