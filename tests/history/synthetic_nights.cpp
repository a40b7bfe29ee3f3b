#include "history/synthetic_nights.h"

#include <algorithm>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/hash.h"

namespace parity::tests {

namespace {

// Names of figures as a report has them by default, and more.
constexpr const char* kFigures[] = {"bias.ev",  "deltae.mean", "flip.max", "flip.mean", "flip.median",
                                    "flip.p95", "flip.p99",    "psnr",     "rmse",      "ssim.mean"};

std::string digest(std::size_t number) { return base::Hasher().addValue(number).hex(); }

history::RowRecord makeRow(const std::string& name, std::mt19937& random) {
  std::uniform_real_distribution<double> value(0.01, 0.09);
  history::RowRecord row{name, compare::Verdict::pass, "", "built-in", {}, {}};
  for (const char* figure : kFigures) row.figures.push_back({figure, history::roundedFigure(value(random))});
  return row;
}

} // namespace

double& figureOf(history::RowRecord& row, const std::string& name) {
  return std::ranges::find(row.figures, name, &compare::Figure::name)->value;
}

Nights::Nights(const NightsOptions& options) : m_random(options.seed) {
  m_record.suite = "nightly", m_record.branch = "main";
  m_record.version = "0.2.0", m_record.device = "llvmpipe (Mesa)";
  for (std::string* each :
       {&m_record.build, &m_record.driver, &m_record.numerics, &m_record.settings, &m_record.budgets})
    *each = digest(++m_digests);
  m_record.machine = "a processor";
  for (std::size_t s = 0; s < options.scenes; ++s) {
    history::SceneRecord& scene = m_record.scenes.emplace_back();
    scene.name = fmt::format("scene {:03}", s);
    scene.inputs = {digest(++m_digests), digest(7), digest(++m_digests), ""};
    for (std::size_t v = 0; v < options.views; ++v) {
      history::ViewRecord& view = scene.views.emplace_back();
      view.name = fmt::format("view {}", v);
      view.whole = makeRow("", m_random);
      for (std::size_t m = 0; m < options.materials; ++m)
        view.materials.push_back(makeRow(fmt::format("material {}", m), m_random));
    }
  }
}

history::RunRecord Nights::next() {
  constexpr std::time_t kFirst = 1'767'236'400, kDay = 86'400; // 2026-01-01T03:00:00Z
  m_record.started =
      fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(kFirst + kDay * static_cast<std::time_t>(m_count)));
  m_record.commit = digest(1'000'000 + m_count).substr(0, 32) + "00000000";
  m_record.commitTime = m_record.started;
  ++m_count;
  std::normal_distribution<double> noise(1, 0.02);
  for (history::SceneRecord& scene : m_record.scenes)
    scene.wallS = history::roundedFigure(2 * noise(m_random)), scene.cpuS = history::roundedFigure(3 * noise(m_random));
  return m_record;
}

std::vector<Planted> Nights::plant(const std::string& cause, std::size_t scene, std::size_t rows) {
  history::SceneRecord& changed = m_record.scenes.at(scene);
  const std::string fresh = cause.empty() ? "" : digest(++m_digests);
  if (cause == "asset") changed.inputs.asset = fresh;
  if (cause == "environment") changed.inputs.environment = fresh;
  if (cause == "request") changed.inputs.request = fresh;
  if (cause == "bake") changed.inputs.bake = fresh;
  if (cause == "pictures") changed.inputs.pictures = fresh;
  if (cause == "build") m_record.build = fresh;
  if (cause == "driver") m_record.driver = fresh;
  if (cause == "numerics") m_record.numerics = fresh;
  if (cause == "settings") m_record.settings = fresh;
  std::vector<Planted> planted;
  for (history::ViewRecord& view : changed.views)
    for (history::RowRecord& row : view.materials) {
      if (planted.size() == rows) return planted;
      const double before = figureOf(row, "flip.mean");
      for (compare::Figure& figure : row.figures) figure.value = history::roundedFigure(figure.value * 1.1 + 0.001);
      planted.push_back({m_count, fmt::format("{}/{}/{}", changed.name, view.name, row.name), cause, before,
                         figureOf(row, "flip.mean")});
    }
  return planted;
}

} // namespace parity::tests
