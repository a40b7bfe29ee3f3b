#include "report/view_choice.h"

#include <algorithm>

#include "base/text/glob.h"
#include "base/text/shown_text.h"
#include "base/text/utf8.h"

namespace parity::report {
namespace {

bool means(std::string_view glob, std::string_view scene, std::string_view view) {
  if (base::matchesGlob(glob, scene)) return true;
  for (std::size_t at = glob.find('/'); at != std::string_view::npos; at = glob.find('/', at + 1))
    if (base::matchesGlob(glob.substr(0, at), scene) && base::matchesGlob(glob.substr(at + 1), view)) return true;
  return false;
}

} // namespace

bool isChosen(const std::vector<std::string>& globs, std::string_view scene, std::string_view view) {
  return globs.empty() || std::ranges::any_of(globs, [&](const std::string& glob) { return means(glob, scene, view); });
}

std::string globOf(std::string_view name) {
  std::string glob;
  base::forEachCode(base::plainLine(name), [&](std::uint32_t code) {
    if (code == base::kReplacement)
      glob += '*'; // of how many bytes it stands for is not known
    else if (code == '*' || code == '[')
      glob += '?';
    else
      base::appendUtf8(glob, code);
  });
  return glob;
}

} // namespace parity::report
