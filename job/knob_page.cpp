#include "job/knob_page.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "job/knobs.h"

namespace parity::job {

namespace {

using base::Knob, base::KnobType;

constexpr const char* kIntro = R"(# Knobs

Made by `parity knobs`. This page lists every setting of a run, with its option on the command line and its key in a suite file
([suite.md](suite.md)). A `[[scene]]` of a suite overrides the command line, and the command line overrides the `[defaults]` of
the suite. `--no-` before the name of a flag switches it off. `--help` of a subcommand lists the settings that it reads.
)";

// A cell of a table holds no bar and no line feed.
std::string cell(std::string text) {
  for (std::size_t at = text.find_first_of("|\n"); at != std::string::npos; at = text.find_first_of("|\n", at + 2))
    text.replace(at, 1, text[at] == '|' ? "\\|" : " ");
  return text;
}

std::string valuesOf(const Knob& knob) {
  switch (knob.type) {
  case KnobType::flag:
    return "true, false";
  case KnobType::number:
    return fmt::format("{} to {}", knob.least, knob.most);
  case KnobType::whole:
    return fmt::format("whole, {} to {}", knob.least, knob.most);
  case KnobType::choice:
    return fmt::format("{}{}", fmt::join(knob.choices, ", "), knob.takesFolder ? ", or a folder (presets.md)" : "");
  case KnobType::texts:
    if (!knob.choices.empty()) return fmt::format("list of {}", fmt::join(knob.choices, ", "));
    return "list of globs";
  case KnobType::numbers:
  case KnobType::text:
  case KnobType::file:
    return knob.form.empty() ? "text" : knob.form;
  }
  return {};
}

std::string keysOf(const Knob& knob) {
  if (!knob.inSuite) return "";
  std::string keys = "`" + base::keyOf(knob.id) + "`";
  for (const std::string& alias : knob.aliases) keys += ", `" + base::keyOf(alias) + "`";
  if (!knob.listKey.empty()) keys += ", or a list `" + knob.listKey + "`";
  return keys;
}

std::string meaningOf(const Knob& knob) {
  std::string text = knob.help + ".";
  if (!knob.needsKnob.empty()) text += fmt::format(" Needs `--{}`.", knob.needsKnob);
  return text;
}

template <typename T> void addRows(std::string& page, std::string& group, const base::KnobTable<T>& table) {
  for (const base::KnobRow<T>& row : table.rows()) {
    if (!row.knob.isOption) continue;
    if (group != row.knob.group) {
      group = row.knob.group;
      page +=
          fmt::format("\n## {}\n\n| option | key of a suite | values | default | |\n|---|---|---|---|---|\n", group);
    }
    page +=
        fmt::format("| `--{}` | {} | {} | {} | {} |\n", row.knob.id, keysOf(row.knob), cell(valuesOf(row.knob)),
                    cell(row.knob.otherwise.empty() ? row.text(T()) : row.knob.otherwise), cell(meaningOf(row.knob)));
  }
}

} // namespace

std::string describeKnobs() {
  std::string page = kIntro, group;
  addRows(page, group, knobs());
  page += "\nSettings of a `[[scene.view]]`; on the command line, of the only view:\n";
  addRows(page, group, scenes::viewKnobs());
  return page;
}

} // namespace parity::job
