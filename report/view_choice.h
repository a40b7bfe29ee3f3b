// Which views of a run were asked for: --only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace parity::report {

// Whether any of the globs (base/text/glob.h) means this view: "SCENE/VIEW", or "SCENE" for all of its views. A name
// may hold '/', too. No globs: every view.
bool isChosen(const std::vector<std::string>& globs, std::string_view scene, std::string_view view);

// A name as a glob that means it, fit for a command that people copy: what would be a wildcard becomes '?', and what a
// terminal must not get (base/text/shown_text.h) '*'.
std::string globOf(std::string_view name);

} // namespace parity::report
