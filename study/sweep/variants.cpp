#include "study/sweep/variants.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/glob.h"
#include "base/text/nearest.h"
#include "job/knobs.h"

namespace parity::sweep {

namespace {

using base::KnobStage;

bool costsIn(const base::Knob& knob, const std::string& path) {
  return knob.stage != KnobStage::none && std::ranges::count(knob.paths, path) > 0;
}

std::vector<std::string> valuesOf(const base::Knob& knob) {
  if (knob.type == base::KnobType::flag) return {"on", "off"};
  return knob.choices;
}

Stage stageOf(const base::Knob& knob) {
  if (knob.stage == KnobStage::preparation) return Stage::preparation;
  return knob.stage == KnobStage::storage ? Stage::storage : Stage::shading;
}

// Variants of one path, each as its default but for what is turned.
class Collector {
public:
  Collector(Variant plain, std::vector<Variant>& all) : m_plain(std::move(plain)), m_all(all) {
    m_all.push_back(m_plain);
  }

  // Every knob that the path's pictures depend on. What does not go together is left out. What is prepared once: the
  // default's value, too, which has a time of its own.
  void addKnobs() {
    for (const base::KnobRow<job::Settings>& row : job::knobs().rows()) {
      if (!costsIn(row.knob, m_plain.path->name())) continue;
      for (const std::string& value : valuesOf(row.knob)) {
        Variant v = m_plain;
        v.stage = stageOf(row.knob);
        if (!set(v, {{row.knob.id, value}})) continue;
        if (v.stage != Stage::preparation) v.sameAs = sameAs(v);
        v.knob = row.knob.id;
        v.name = row.knob.id + " " + value;
        v.needs = row.knob.needsScene;
        m_all.push_back(std::move(v));
      }
    }
  }

  void addSet(const paths::Path::KnobSet& knobs) {
    Variant v = m_plain;
    if (!set(v, knobs.values)) return;
    v.sameAs = sameAs(v);
    v.name = knobs.name;
    v.needs = knobs.needs;
    m_all.push_back(std::move(v));
  }

  const paths::Path& path() const { return *m_plain.path; }

private:
  std::string sameAs(const Variant& v) const {
    const auto found = std::ranges::find_if(m_all, [&, knobs = v.knobs()](const Variant& other) {
      return other.path == v.path && other.sameAs.empty() && other.knobs() == knobs;
    });
    return found == m_all.end() ? "" : found->id();
  }

  static bool set(Variant& v, const std::vector<std::pair<std::string, std::string>>& values) {
    base::GivenKnobs given;
    for (const auto& [id, value] : values) given[id] = {{value}, "--" + id};
    try {
      v.settings = job::withKnobs(v.settings, given);
    } catch (const base::Error&) {
      return false;
    }
    return true;
  }

  Variant m_plain;
  std::vector<Variant>& m_all;
};

std::string describeNearestIn(const std::vector<Variant>& variants, const std::string& glob) {
  std::vector<std::string> ids;
  for (const Variant& v : variants) ids.push_back(v.id());
  return base::describeNearestToGlob(glob, std::vector<std::string_view>(ids.begin(), ids.end()));
}

} // namespace

const std::vector<std::string>& stageKinds() {
  static const std::vector<std::string> names = {"shading", "preparation", "storage"};
  return names;
}

std::vector<std::pair<std::string, std::string>> Variant::knobs() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (const base::KnobRow<job::Settings>& row : job::knobs().rows())
    if (costsIn(row.knob, path->name())) all.emplace_back(row.knob.id, row.text(settings));
  return all;
}

std::vector<Variant> makeVariants(const job::Settings& settings) {
  std::vector<Variant> all;
  std::vector<Collector> collectors; // the defaults come first
  const job::PathChoice paths = job::pathsOf(settings);
  if (paths.chosen.front() != job::allPaths().front())
    throw base::Error(base::ExitCode::usage, "--paths", settings.pathNames.front(),
                      "comes first, but bench measures errors against " + job::allPaths().front()->name() +
                          "; put that path first");
  for (const paths::Path* path : paths.chosen)
    collectors.emplace_back(Variant{.path = path, .settings = settings}, all);
  for (Collector& collector : collectors) {
    for (const paths::Path::KnobSet& set : collector.path().knobSets()) collector.addSet(set);
    collector.addKnobs();
  }
  return all;
}

void requireMatches(const std::vector<Variant>& variants, const std::vector<std::string>& globs) {
  for (const std::string& glob : globs)
    if (std::ranges::none_of(variants, [&](const Variant& v) { return base::matchesGlob(glob, v.id()); }))
      throw base::Error(base::ExitCode::usage, "bench", "--settings " + glob,
                        fmt::format("no setting matches; {}; --list lists them", describeNearestIn(variants, glob)));
}

} // namespace parity::sweep
