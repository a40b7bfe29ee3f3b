#include "study/sweep/summary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/text/shown_text.h"
#include "report/wording.h"
#include "study/sweep/pareto.h"
#include "study/sweep/statistics.h"

namespace parity::sweep {

namespace {

// What is gathered of one setting.
struct Gathered {
  std::string id;
  std::size_t scenes = 0;
  std::vector<double> times, flip, relMse, fromFirst, fromFirstOfParts;
};

MedianWorst medianWorstOf(const std::vector<double>& values) {
  if (values.empty()) return {};
  if (std::ranges::any_of(values, [](double value) { return std::isnan(value); })) return {std::nan(""), std::nan("")};
  return {quantileOf(values, 0.5), std::ranges::max(values)};
}

std::string cells(const MedianWorst& figures) {
  return fmt::format(" {:.4f} | {:.4f} |", figures.median, figures.worst);
}

// A name as a cell, in which it is no more than text.
std::string cellOf(const std::string& name) {
  std::string cell;
  for (const char c : base::plainLine(name)) cell += c == '|' ? "\\|" : c == '<' ? "&lt;" : std::string(1, c);
  return cell;
}

} // namespace

std::vector<SettingSummary> summarise(const SweepReport& report) {
  std::vector<Gathered> all;
  std::map<std::string, std::size_t> places;
  for (const SceneSweep& scene : report.scenes)
    for (const VariantResult& v : scene.variants) {
      const auto [at, isNew] = places.emplace(v.id(), all.size());
      if (isNew) all.emplace_back().id = v.id();
      Gathered& g = all[at->second];
      ++g.scenes;
      if (const VariantResult* plain = findVariant(scene, v.path + ": default");
          v.stage == Stage::shading && plain && timeOf(*plain) > 0)
        g.times.push_back(timeOf(v) / timeOf(*plain));
      if (v.whole.truth) {
        g.flip.push_back(v.whole.truth->flipMean);
        g.relMse.push_back(v.whole.truth->relMse);
      }
      g.fromFirst.push_back(v.whole.first.flipMean);
      for (const RegionErrors& material : v.materials) g.fromFirstOfParts.push_back(material.first.flipMean);
    }
  std::vector<SettingSummary> summaries;
  for (const Gathered& g : all)
    summaries.push_back({g.id, g.scenes, medianWorstOf(g.times).median, medianWorstOf(g.flip), medianWorstOf(g.relMse),
                         medianWorstOf(g.fromFirst), medianWorstOf(g.fromFirstOfParts)});
  return summaries;
}

std::vector<std::string> notesOf(const SweepReport& report) {
  struct Default {
    std::string scene;
    std::vector<std::pair<std::string, std::string>> knobs;
  };
  std::vector<std::string> notes;
  std::map<std::string, Default> defaults; // of the first scene that has the path
  const bool hasTruth = std::ranges::any_of(
      report.scenes, [](const SceneSweep& s) { return !s.variants.empty() && s.variants.front().whole.truth; });
  for (const SceneSweep& scene : report.scenes) {
    if (!scene.failure.empty()) notes.push_back(fmt::format("{}: not measured: {}", scene.scene, scene.failure));
    if (hasTruth && !scene.variants.empty() && !scene.variants.front().whole.truth)
      notes.push_back(scene.scene + ": has no truth, so all errors are against the default of the first path");
    for (const VariantResult& v : scene.variants) {
      if (v.name != "default") continue;
      const Default& first = defaults.emplace(v.path, Default{scene.scene, v.knobs}).first->second;
      for (const auto& [knob, value] : v.knobs) {
        const auto other = std::ranges::find(first.knobs, knob, &std::pair<std::string, std::string>::first);
        if (other != first.knobs.end() && other->second != value)
          notes.push_back(fmt::format("{}: the default of {} has {} {}, but {} in {}. Figures over all scenes use the "
                                      "default of each scene",
                                      scene.scene, v.path, knob, value, other->second, first.scene));
      }
    }
  }
  return notes;
}

std::string toMarkdown(const SweepReport& report) {
  const bool hasTruth = bestKnown(report) == Against::truth;
  const std::string first = report::titleOf(firstPathOf(report));
  std::string text;
  for (const std::string& note : notesOf(report)) text += "- " + cellOf(note) + "\n";
  if (!text.empty()) text += "\n";
  text += "| setting | scenes | time relative to the default |";
  if (hasTruth) text += " FLIP against the truth | worst | relMSE against the truth | worst |";
  text += fmt::format(" FLIP against {} | worst | FLIP of materials | worst |\n|---|---|---|---|---|---|---|", first);
  text += hasTruth ? "---|---|---|---|\n" : "\n";
  const std::vector<SettingSummary> summaries = summarise(report);
  for (const SettingSummary& s : summaries) {
    text += fmt::format("| {} | {} | {} |", s.id, s.scenes, s.time > 0 ? fmt::format("{:.2f}", s.time) : "");
    if (hasTruth) text += cells(s.flip) + fmt::format(" {:.2e} | {:.2e} |", s.relMse.median, s.relMse.worst);
    text += cells(s.fromFirst) + cells(s.fromFirstOfParts) + "\n";
  }
  text += fmt::format("\nFLIP of each scene against {}:\n\n| setting |", hasTruth ? "the truth" : first);
  std::string line = "\n|---|";
  for (const SceneSweep& scene : report.scenes) {
    if (!scene.failure.empty()) continue;
    text += " " + cellOf(scene.scene) + " |";
    line += "---|";
  }
  text += line + "\n";
  for (const SettingSummary& s : summaries) {
    text += "| " + s.id + " |";
    for (const SceneSweep& scene : report.scenes) {
      if (!scene.failure.empty()) continue;
      const VariantResult* v = findVariant(scene, s.id);
      const std::optional<double> error =
          v ? errorOf(v->whole, hasTruth ? Against::truth : Against::first, "flip.mean") : std::nullopt;
      text += error ? fmt::format(" {:.4f} |", *error) : " |";
    }
    text += "\n";
  }
  return text;
}

} // namespace parity::sweep
