// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/render_options.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/nearest.h"
#include "cli/options/option_parts.h"
#include "job/paths.h"

namespace parity::cli {

namespace {

std::string refuseUnknownTerm(const std::string& name) {
  const std::vector<std::string> names = termNames();
  const std::vector<std::string_view> known(names.begin(), names.end());
  return std::ranges::count(known, name) > 0 ? "" : name + ": unknown term; " + base::describeNearest(name, known);
}

} // namespace

void addRenderOptions(CLI::App& app, RenderCommand& render, bool& listTerms) {
  app.add_option("scene", render.scene, "Scene file or builtin:NAME")->required()->type_name(kSceneFile);
  std::vector<std::string> rendered = job::pathNames();
  rendered.insert(rendered.end(), {"truth", "reference"}); // the older name of it
  choose(app.add_option(
             "--path", render.path,
             fmt::format("Path: {} or truth (ground truth: exact integrals, slow)", fmt::join(job::pathNames(), ", "))),
         rendered)
      ->required()
      ->group("Rendered");
  app.add_option("-o,--output", render.output,
                 "Picture to write. .exr, .pfm, .hdr: linear scene-referred values; .png: as displayed")
      ->required()
      ->check(fileOfKind({".exr", ".pfm", ".hdr", ".png"}))
      ->type_name(kFile)
      ->group(kOutputGroup);
  app.add_flag("--watch", render.watches,
               "Write the picture again whenever the preset folder changes, until a signal ends the program")
      ->group("Rendered");
  app.add_flag("--terms", render.common.settings.terms, "Also write the terms of light, as layers of the .exr file")
      ->group("Rendered");
  app.add_option("--term", render.term,
                 "Write one term, or one intermediate of the path's shader, instead of the colour (--list-terms)")
      ->check(CLI::Validator(refuseUnknownTerm, ""))
      ->type_name("NAME")
      ->group("Rendered");
  app.add_flag_callback(
         "--list-terms",
         [&listTerms] {
           listTerms = true;
           throw CLI::Success();
         },
         "List the values of --term")
      ->group("Rendered");
  app.add_option("--ids", render.ids,
                 "Write which material each pixel shows: channels id, coverage and seen (docs/own-engine.md)")
      ->check(fileOfKind({".exr"}))
      ->type_name(kFile)
      ->group(kOutputGroup);
  app.add_option("--error-map", render.errorMap, "Write the relative standard error of each pixel to this file")
      ->check(fileOfKind({".exr", ".pfm"}))
      ->type_name(kFile)
      ->group("Truth");
}

} // namespace parity::cli
