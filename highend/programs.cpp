#include "highend/programs.h"

#include <algorithm>
#include <iterator>

#include "highend/knobs.h"
#include "highend_shaders/highend.comp.h"
#include "highend_shaders/highend_lobes.comp.h"
#include "highend_texts/texts.h"

namespace parity::highend {

namespace {

const paths::ProgramMacros kPlain, kLobes = {"PARITY_LOBES"};

paths::BuiltInProgram builtIn(const paths::ProgramMacros& macros) {
  return macros.empty() ? paths::BuiltInProgram{kHighendComp, kHighendCompWritten}
                        : paths::BuiltInProgram{kHighendLobesComp, kHighendLobesCompWritten};
}

paths::PresetHost makeHost() {
  paths::PresetHost host{.path = "highend",
                         .bases = {},
                         .knobs = {},
                         .functions = {},
                         .texts = {std::begin(kHighendShaderTexts), std::end(kHighendShaderTexts)},
                         .root = "highend/shaders/highend.glsl",
                         .checked = {kPlain},
                         .counted = {0, ~0u, 0, 1, 1, 1},
                         .unfolded = {},
                         .builtIn = builtIn};
  host.functions = paths::presetFunctionsOf(
      std::ranges::find(host.texts, "highend/shaders/preset.glsl", &gpu::ShaderText::path)->text);
  for (const auto& row : knobs().rows())
    if (row.knob.isOption && row.knob.id != "highend-preset") host.knobs.push_back(row.knob);
  return host;
}

} // namespace

gpu::Spirv programOf(const Options& options, bool lobes) {
  return paths::programOf(presetHost(), options.own.get(), lobes ? kLobes : kPlain);
}

const paths::PresetHost& presetHost() {
  static const paths::PresetHost host = makeHost();
  return host;
}

Options optionsOfFolder(const std::string& text) {
  Options options;
  options.own = paths::readPresetFolder(text, presetHost());
  options.preset = options.own->text();
  paths::applyKnobs(knobs(), options, *options.own);
  return options;
}

} // namespace parity::highend
