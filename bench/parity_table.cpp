#include "bench/parity_table.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace parity::bench {

namespace {

constexpr std::size_t kUe4 = 1, kRefit = 2, kHighend = kPresetCount;

std::string summarise(const ParityTable& table) {
  std::string text =
      "| | comparisons | median karis2014 | median ue4-2020 | median refit | refit over ue4-2020 | refit is "
      "lower than ue4-2020 |\n|---|---|---|---|---|---|---|\n";
  for (const int which : {0, 1, 2}) {
    std::array<std::vector<double>, kPresetCount> flips;
    std::size_t lower = 0, count = 0;
    for (const MaterialFlip& m : table.materials) {
      if ((which == 0 && m.sun) || (which == 1 && !m.sun)) continue;
      for (std::size_t p = 0; p < kPresetCount; ++p) flips[p].push_back(m.flip[p]);
      lower += m.flip[kRefit] < m.flip[kUe4];
      ++count;
    }
    if (count == 0) continue;
    std::array<double, kPresetCount> medians;
    for (std::size_t p = 0; p < kPresetCount; ++p) medians[p] = medianOf(flips[p]);
    text += fmt::format("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.2f} | {:.1f} % |\n",
                        which == 0   ? "environment only"
                        : which == 1 ? "environment + sun"
                                     : "both",
                        count, medians[0], medians[kUe4], medians[kRefit], medians[kRefit] / medians[kUe4],
                        100.0 * static_cast<double>(lower) / static_cast<double>(count));
  }
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

// By scene and material: mean over the environments, without and with the sun.
std::string materialTable(const ParityTable& table) {
  struct Sum {
    std::array<std::array<double, kPresetCount>, 2> flip{};
    std::array<int, 2> count{};
    std::array<std::uint64_t, kPresetCount> nonFinite{};
  };
  std::map<std::pair<std::string, std::string>, Sum> sums;
  for (const MaterialFlip& m : table.materials) {
    Sum& sum = sums[{m.scene, m.material}];
    for (std::size_t p = 0; p < kPresetCount; ++p) {
      sum.flip[m.sun][p] += m.flip[p];
      sum.nonFinite[p] += m.nonFinite[p];
    }
    ++sum.count[m.sun];
  }
  std::string text =
      "| scene | material | environment only: karis2014 | ue4-2020 | refit | + sun: karis2014 | ue4-2020 | "
      "refit |\n|---|---|---|---|---|---|---|---|\n";
  for (const auto& [key, sum] : sums) {
    text += fmt::format("| {} | {} |", key.first, key.second);
    for (int sun = 0; sun < 2; ++sun)
      for (std::size_t p = 0; p < kPresetCount; ++p)
        text += fmt::format(" {:.4f}{} |", sum.flip[sun][p] / std::max(sum.count[sun], 1),
                            sum.nonFinite[p] > 0 && sun == 1 ? " (NaN)" : "");
    text += "\n";
  }
  return text;
}

std::string worstTable(const ParityTable& table) {
  std::vector<MaterialFlip> sorted = table.materials;
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.flip[kRefit] > b.flip[kRefit]; });
  std::string text = "| scene | material | sun | karis2014 | ue4-2020 | refit |\n|---|---|---|---|---|---|\n";
  std::map<std::pair<std::string, std::string>, bool> seen;
  for (const MaterialFlip& m : sorted) {
    if (seen.size() == 6) break;
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
         "pixel's scalar operations and\nfetches, samplers at most (counted from SPIR-V, gpu/spirv_cost.h). Presets: "
         "the "
         "same as shares of the high-end path's; samplers.\n\n" +
         costTable(table) + "\n## The worst of refit\n\n" + worstTable(table) +
         "\n## Every material\n\nMean over the environments.\n\n" + materialTable(table);
}

} // namespace parity::bench
