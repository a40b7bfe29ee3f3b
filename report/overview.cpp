#include "report/overview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/text/json_writer.h"
#include "report/causes.h"
#include "report/column.h"
#include "report/record/derived.h"
#include "report/record/report_records.h"
#include "report/what_if.h"
#include "report/wording.h"

namespace parity::report {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

std::uint32_t limitedCount(std::uint64_t value) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(value, std::numeric_limits<std::uint32_t>::max()));
}

std::array<const std::string*, 3> pathsOf(const ImageSet& images) {
  return {&images.reference, &images.test, &images.flip};
}

// What the paths of all pictures of a view begin with, shorter than each.
std::string_view prefixOf(const ViewResult& view) {
  std::string_view prefix;
  bool isFirst = true;
  const auto add = [&](const ImageSet& images) {
    for (const std::string* path : pathsOf(images)) {
      if (path->empty()) continue;
      if (std::exchange(isFirst, false)) prefix = *path;
      const auto [end, ignored] = std::ranges::mismatch(prefix, *path);
      const auto same = static_cast<std::size_t>(end - prefix.begin());
      prefix = prefix.substr(0, std::min(same, path->size() - 1));
    }
  };
  add(view.images);
  for (const MaterialResult& material : view.materials) add(material.crops);
  return prefix;
}

// What a material and a whole image have in common.
struct JudgedRow {
  const compare::Figures& figures;
  const std::vector<compare::CheckResult>& checks;
  const compare::AppliedRule& rule;
  const std::optional<BaselineChange>& baseline;
  compare::Verdict verdict;
  const std::string &reason, &accepted;
  const ImageSet& images;
};

class OverviewTables {
public:
  explicit OverviewTables(const FindStanding& find) : m_find(find) {}

  void add(const SceneResult& scene) {
    std::vector<std::uint32_t> warnings;
    for (const std::string& each : scene.warnings) warnings.push_back(m_texts.place(each));
    m_scenes.whole("name").push_back(m_texts.place(scene.name));
    m_scenes.whole("source").push_back(m_texts.place(scene.source));
    m_scenes.whole("error").push_back(m_texts.place(scene.error));
    m_scenes.whole("verdict").push_back(static_cast<std::uint32_t>(ownVerdict(scene)));
    m_scenes.whole("warnings").push_back(m_lists.place(warnings));
    m_scenes.whole("views").push_back(limitedCount(scene.views.size()));
    for (const ViewResult& view : scene.views) add(scene, view);
  }

  void write(base::JsonWriter& json) const {
    json.beginObject();
    json.key("verdicts").beginArray();
    for (const compare::Verdict verdict : Names<compare::Verdict>::values) json.text(nameOf(verdict));
    json.endArray();
    m_texts.write(json.key("texts"));
    m_lists.write(json.key("lists"));
    json.key("limits").beginArray();
    for (const std::string* limits : m_limitTexts) json.raw(*limits);
    json.endArray();
    json.key("scenes").beginObject();
    m_scenes.write(json);
    json.endObject();
    json.key("views").beginObject();
    m_views.write(json);
    json.endObject();
    json.key("rows").beginObject();
    m_rows.write(json);
    writeFigures(json.key("figures"));
    json.endObject();
    json.endObject();
  }

private:
  void add(const SceneResult& scene, const ViewResult& view) {
    const std::string_view prefix = prefixOf(view);
    m_views.whole("name").push_back(m_texts.place(view.name));
    m_views.whole("reference").push_back(m_texts.place(view.reference));
    m_views.whole("test").push_back(m_texts.place(view.test));
    m_views.whole("width").push_back(limitedCount(static_cast<std::uint64_t>(view.width)));
    m_views.whole("height").push_back(limitedCount(static_cast<std::uint64_t>(view.height)));
    m_views.whole("prefix").push_back(m_texts.place(prefix));
    m_views.whole("materials").push_back(limitedCount(view.materials.size()));
    for (const MaterialResult& material : view.materials) {
      add({material.figures, material.checks, material.rule, material.baseline, material.verdict, material.reason,
           material.accepted, material.crops},
          prefix, biasOf(material.figures, material.test));
      addOfMaterial(&material);
      addStanding(scene, view, &material);
    }
    add({view.whole, view.checks, view.rule, view.baseline, view.wholeVerdict, view.reason, view.accepted, view.images},
        prefix, biasOf(view.whole, view.test));
    addOfMaterial(nullptr);
    addStanding(scene, view, nullptr);
  }

  void add(const JudgedRow& judged, std::string_view prefix, const std::string& bias) {
    const bool isSeen = judged.figures.pixels > 0;
    m_rows.whole("verdict").push_back(static_cast<std::uint32_t>(judged.verdict));
    m_rows.whole("reason").push_back(m_texts.place(judged.reason));
    m_rows.whole("accepted").push_back(m_texts.place(judged.accepted));
    m_rows.whole("bias").push_back(m_texts.place(bias));
    m_rows.whole("pixels").push_back(limitedCount(judged.figures.pixels));
    m_rows.whole("nonFinite").push_back(isSeen ? limitedCount(judged.figures.nonFinite) : 0);
    m_rows.whole("limits").push_back(placeLimits(judged.checks));
    m_rows.whole("preset").push_back(m_texts.place(judged.rule.preset));
    m_rows.whole("images").push_back(placeImages(judged.images, prefix));
    addBaseline(judged.baseline);
    if (isSeen)
      for (const compare::Figure& figure : judged.figures.values)
        figureColumn(figure.name).back() = static_cast<float>(figure.value);
  }

  // "before": 0 without a baseline, 1 of what is new, else 2 and the verdict that it had.
  void addBaseline(const std::optional<BaselineChange>& baseline) {
    const std::uint32_t before = !baseline ? 0 : baseline->isNew ? 1 : 2 + static_cast<std::uint32_t>(baseline->before);
    float change = kNone;
    if (baseline)
      for (const FigureChange& each : baseline->changes)
        if (each.metric == "flip.mean") change = static_cast<float>(each.change());
    m_rows.whole("before").push_back(before);
    m_rows.whole("notComparable").push_back(m_texts.place(baseline ? baseline->notComparable : ""));
    m_rows.real("change").push_back(change);
  }

  void addStanding(const SceneResult& scene, const ViewResult& view, const MaterialResult* material) {
    const RowStanding row = m_find ? m_find(scene, view, material) : standingOf(view, material);
    m_rows.whole("standing").push_back(static_cast<std::uint32_t>(row.standing));
    m_rows.whole("nights").push_back(limitedCount(row.nights));
    m_rows.whole("owner").push_back(m_texts.place(row.owner));
  }

  // What whole images have none of. material: null of these.
  void addOfMaterial(const MaterialResult* material) {
    std::vector<std::uint32_t> notModelled;
    std::optional<compare::TermEffect> cause;
    const WhatIf* better = nullptr;
    if (material) {
      for (const std::string& part : material->notModelled) notModelled.push_back(m_texts.place(part));
      cause = causeOf(*material);
      better = bestWhatIf(*material);
    }
    m_rows.whole("name").push_back(m_texts.place(material ? material->name : ""));
    m_rows.whole("seenElsewhere").push_back(material && material->seenElsewhere ? 1 : 0);
    m_rows.whole("notModelled").push_back(m_lists.place(notModelled));
    m_rows.whole("cause").push_back(m_texts.place(cause ? cause->term : ""));
    m_rows.whole("noCause").push_back(m_texts.place(material && !cause ? describeNoCause(*material) : ""));
    m_rows.real("causeBefore").push_back(cause ? static_cast<float>(material->attribution->flip) : kNone);
    m_rows.real("causeAfter").push_back(cause ? static_cast<float>(cause->flip) : kNone);
    m_rows.whole("better").push_back(m_texts.place(better ? better->preset : ""));
    m_rows.whole("betterVerdict").push_back(better ? static_cast<std::uint32_t>(better->verdict) : 0);
    m_rows.real("betterFlip")
        .push_back(better ? static_cast<float>(better->figures.find("flip.mean").value_or(kNone)) : kNone);
  }

  std::uint32_t placeImages(const ImageSet& images, std::string_view prefix) {
    std::vector<std::uint32_t> list;
    for (const std::string* path : pathsOf(images))
      list.push_back(m_texts.place(path->empty() ? std::string_view() : std::string_view(*path).substr(prefix.size())));
    return m_lists.place(list);
  }

  std::uint32_t placeLimits(const std::vector<compare::CheckResult>& checks) {
    base::JsonWriter json(base::JsonLayout::compact);
    const auto limit = [&](const char* key, std::optional<double> value) {
      json.key(key);
      value ? json.number(*value) : json.null();
    };
    json.beginArray();
    for (const compare::CheckResult& check : checks) {
      if (check.regress) continue;
      json.beginObject();
      json.key("metric").text(check.metric);
      limit("warn", check.warnAbove);
      limit("fail", check.failAbove);
      json.key("verdict").text(nameOf(check.judged() ? check.verdict : compare::Verdict::notJudged));
      json.endObject();
    }
    json.endArray();
    std::string text = json.finish();
    text.pop_back(); // the line feed
    const auto [found, isNew] = m_limits.emplace(std::move(text), static_cast<std::uint32_t>(m_limitTexts.size()));
    if (isNew) m_limitTexts.push_back(&found->first);
    return found->second;
  }

  // With an element for each row up to the one that is being added.
  std::vector<float>& figureColumn(const std::string& name) {
    const auto [found, isNew] = m_figurePlaces.emplace(name, m_figures.size());
    if (isNew) m_figures.emplace_back(name, std::vector<float>());
    std::vector<float>& column = m_figures[found->second].second;
    column.resize(m_rows.count(), kNone);
    return column;
  }

  void writeFigures(base::JsonWriter& json) const {
    json.beginObject();
    for (const auto& [name, values] : m_figures) {
      std::vector<float> whole = values;
      whole.resize(m_rows.count(), kNone);
      writeColumn(json.key(name), whole);
    }
    json.endObject();
  }

  const FindStanding& m_find;
  TextTable m_texts;
  ListTable m_lists;
  std::unordered_map<std::string, std::uint32_t> m_limits; // by their JSON
  std::vector<const std::string*> m_limitTexts;
  ColumnTable m_scenes, m_views, m_rows;
  std::vector<std::pair<std::string, std::vector<float>>> m_figures; // in the order in which they first come
  std::unordered_map<std::string, std::size_t> m_figurePlaces;
};

} // namespace

void writeOverview(const Report& report, const FindStanding& find, const base::TextSink& sink) {
  OverviewTables overview(find);
  for (const SceneResult& scene : report.scenes) overview.add(scene);
  base::JsonWriter json(base::JsonLayout::compact, sink);
  overview.write(json);
  json.finish();
}

} // namespace parity::report
