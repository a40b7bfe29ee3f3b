#include "bench/parity_table.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace parity::bench {

namespace {

constexpr std::size_t kUe4 = 1, kRefit = 2, kHighend = kPresetCount;

// A line of the summary.
std::string summariseRows(const std::string& name, const std::vector<MaterialFlip>& rows) {
  if (rows.empty()) return "";
  std::array<double, kPresetCount> medians;
  for (std::size_t p = 0; p < kPresetCount; ++p) {
    std::vector<double> flips;
    for (const MaterialFlip& m : rows) flips.push_back(m.flip[p]);
    medians[p] = medianOf(flips);
  }
  const auto lower =
      std::count_if(rows.begin(), rows.end(), [](const MaterialFlip& m) { return m.flip[kRefit] < m.flip[kUe4]; });
  return fmt::format("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.2f} | {:.1f} % |\n", name, rows.size(), medians[0],
                     medians[kUe4], medians[kRefit], medians[kRefit] / medians[kUe4],
                     100.0 * static_cast<double>(lower) / static_cast<double>(rows.size()));
}

// One row a material and kind of light: the mean over the environments.
std::vector<MaterialFlip> meansOf(const ParityTable& table) {
  std::map<std::tuple<std::string, std::string, bool, bool>, std::pair<MaterialFlip, int>> sums;
  for (const MaterialFlip& m : table.materials) {
    auto& [sum, count] = sums[{m.scene, m.material, m.sun, m.sunLeftOut}];
    sum.scene = m.scene;
    sum.material = m.material;
    sum.sun = m.sun;
    sum.sunLeftOut = m.sunLeftOut;
    for (std::size_t p = 0; p < kPresetCount; ++p) {
      sum.flip[p] += m.flip[p];
      sum.nonFinite[p] += m.nonFinite[p];
    }
    ++count;
  }
  std::vector<MaterialFlip> means;
  for (auto& [key, sum] : sums) {
    for (double& flip : sum.first.flip) flip /= sum.second;
    means.push_back(sum.first);
  }
  return means;
}

std::string summarise(const ParityTable& table) {
  std::string text =
      "| | rows | median karis2014 | median ue4-2020 | median refit | refit over ue4-2020 | refit is lower "
      "than ue4-2020 |\n|---|---|---|---|---|---|---|\n";
  const std::vector<MaterialFlip> means = meansOf(table);
  const auto select = [](const std::vector<MaterialFlip>& rows, auto wanted) {
    std::vector<MaterialFlip> chosen;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(chosen), wanted);
    return chosen;
  };
  text += summariseRows("**the lights of both paths are the same**",
                        select(means, [](const MaterialFlip& m) { return !m.sunLeftOut; }));
  text += summariseRows("environment only", select(means, [](const MaterialFlip& m) { return !m.sun; }));
  text +=
      summariseRows("environment + sun", select(means, [](const MaterialFlip& m) { return m.sun && !m.sunLeftOut; }));
  text += summariseRows("environment with a sun of its own + sun: two, of which the path has one",
                        select(means, [](const MaterialFlip& m) { return m.sunLeftOut; }));
  text += summariseRows("all of these", means);
  std::set<std::string> environments;
  for (const MaterialFlip& m : table.materials) environments.insert(m.environment);
  for (const std::string& environment : environments)
    for (const bool sun : {false, true})
      text += summariseRows(environment + (sun ? " + sun" : ""), select(table.materials, [&](const MaterialFlip& m) {
                              return m.sun == sun && m.environment == environment;
                            }));
  return text;
}

std::string costTable(const ParityTable& table) {
  std::string text = "| scene | high-end: ms, operations, fetches, samplers |";
  for (const char* preset : kPresets) text += fmt::format(" {} |", preset);
  text += " refit's operations over ue4-2020's |\n|---|---|---|---|---|---|\n";
  for (const SceneCost& cost : table.costs) {
    const PathFigures& high = cost.paths[kHighend];
    text += fmt::format("| {} | {:.1f}, {:.0f}, {:.1f}, {} |", cost.scene, high.timeMs, high.operations, high.fetches,
                        high.samplers);
    for (std::size_t p = 0; p < kPresetCount; ++p) {
      const PathFigures& path = cost.paths[p];
      text += fmt::format(" {:.2f}, {:.2f}, {:.2f}, {} |", path.timeMs / high.timeMs, path.operations / high.operations,
                          high.fetches > 0 ? path.fetches / high.fetches : 1, path.samplers);
    }
    text += fmt::format(" {:.2f} |\n", cost.paths[kRefit].operations / cost.paths[kUe4].operations);
  }
  return text;
}

std::string materialTable(const ParityTable& table) {
  std::string text = "| scene | material | sun | karis2014 | ue4-2020 | refit |\n|---|---|---|---|---|---|\n";
  for (const MaterialFlip& m : meansOf(table)) {
    text += fmt::format("| {} | {} | {} |", m.scene, m.material, m.sunLeftOut ? "two" : m.sun ? "yes" : "");
    for (std::size_t p = 0; p < kPresetCount; ++p)
      text += fmt::format(" {:.4f}{} |", m.flip[p], m.nonFinite[p] > 0 ? " (NaN)" : "");
    text += "\n";
  }
  return text;
}

std::string worstTable(const ParityTable& table) {
  std::vector<MaterialFlip> sorted = meansOf(table);
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.flip[kRefit] > b.flip[kRefit]; });
  std::string text = "| scene | material | sun | karis2014 | ue4-2020 | refit |\n|---|---|---|---|---|---|\n";
  std::map<std::pair<std::string, std::string>, bool> seen;
  for (const MaterialFlip& m : sorted) {
    if (seen.size() == 6) break;
    if (m.sunLeftOut) continue; // what is left out is no fault of a formula
    if (!seen.emplace(std::pair(m.scene, m.material), true).second) continue;
    text += fmt::format("| {} | {} | {} | {:.4f} | {:.4f} | {:.4f} |\n", m.scene, m.material, m.sun ? "yes" : "no",
                        m.flip[0], m.flip[kUe4], m.flip[kRefit]);
  }
  return text;
}

} // namespace

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

std::string toMarkdown(const ParityTable& table) {
  return "# How close the mobile presets are to the high-end path\n\n"
         "Made by `build/mobile_evidence`: mean FLIP of each material against the high-end path with its defaults, "
         "every "
         "built-in\nscene and asset at 256x256 under " +
         std::to_string(table.environments) +
         " environments, without and with `--sun 30,50,4`; the mobile path in half where the device\nhas it. Suns that "
         "an "
         "environment holds are lights in both.\n\n![high-end, karis2014, ue4-2020, refit; FLIP of each "
         "preset](mobile-parity.png)\n\n" +
         summarise(table) +
         "\n## Cost\n\nThe same surfaces at 512x512 in fp32, last environment and sun. High-end: device time in ms, "
         "then a "
         "pixel's scalar operations and\nfetches, samplers at most (counted from SPIR-V, gpu/spirv/spirv_cost.h). "
         "Presets: "
         "the "
         "same as shares of the high-end path's; samplers.\n\n" +
         costTable(table) + "\n## The worst of refit\n\n" + worstTable(table) +
         "\n## Every material\n\nMean over the environments. NaN: some pixels are not finite; they count as what is "
         "shown of them, black.\n\n" +
         materialTable(table);
}

} // namespace parity::bench
