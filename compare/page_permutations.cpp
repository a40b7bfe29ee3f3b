// The passes and the shaders that a scene's paths ran, as tables of the page.
#include <fmt/format.h>

#include "compare/page_parts.h"
#include "compare/text.h"

namespace parity::compare {

std::string passTable(const std::vector<PassResult>& passes) {
  std::string rows;
  std::size_t skipped = 0;
  for (const PassResult& pass : passes) {
    skipped += pass.count == 0;
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>", escapeMarkup(pass.name),
                        pass.count > 0 ? fmt::format("{} {}", pass.count, escapeMarkup(pass.unit))
                                       : "skipped: " + escapeMarkup(pass.skipped));
  }
  if (rows.empty()) return {};
  return fmt::format("<details><summary>Passes: {} run, {} skipped as nothing needed them</summary><table "
                     "class=\"figures\"><tbody>{}</tbody></table></details>\n",
                     passes.size() - skipped, skipped, rows);
}

std::string permutationTable(const std::vector<PermutationResult>& permutations) {
  if (permutations.empty()) return {};
  const std::string words = describeCosts(permutations);
  const bool costs = !words.empty();
  std::string rows;
  for (const PermutationResult& each : permutations) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
                        escapeMarkup(each.path), escapeMarkup(each.textures), escapeMarkup(each.features), each.pixels,
                        each.samplers);
    if (each.cost)
      rows += fmt::format("<td>{}{}</td><td>{}</td><td>{}</td>", each.cost->openLoops > 0 ? "≥ " : "", each.cost->fp32,
                          each.cost->fp16, each.cost->fetches);
    else if (costs)
      rows += "<td>–</td><td>–</td><td>–</td>";
    rows += "</tr>";
  }
  return fmt::format(
      "<details><summary>Shaders</summary>{}<table class=\"figures\"><thead><tr><th scope=\"col\">path</th><th "
      "scope=\"col\">textures</th><th scope=\"col\">features</th><th scope=\"col\">pixels</th><th "
      "scope=\"col\">samplers</th>{}</tr></thead><tbody>{}"
      "</tbody></table></details>\n",
      costs ? "<p>On average " + escapeMarkup(words) + ".</p>" : "",
      costs ? "<th scope=\"col\">fp32 operations</th><th scope=\"col\">fp16 operations</th><th "
              "scope=\"col\">fetches</th>"
            : "",
      rows);
}

} // namespace parity::compare
