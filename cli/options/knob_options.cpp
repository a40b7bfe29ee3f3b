#include "cli/options/knob_options.h"

#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/log.h"
#include "cli/options/option_parts.h"
#include "job/knobs.h"

namespace parity::cli {

namespace {

// What stands behind the option's name in --help.
std::string typeOf(const base::Knob& knob) {
  switch (knob.type) {
  case base::KnobType::flag:
    return "";
  case base::KnobType::number:
  case base::KnobType::whole:
    return fmt::format("NUMBER:{} to {}", knob.least, knob.most);
  case base::KnobType::choice:
    return fmt::format("{{{}}}{}", fmt::join(knob.choices, ","), knob.takesFolder ? " or FOLDER" : "");
  case base::KnobType::texts:
    return knob.form.empty() ? "GLOB" : knob.form;
  case base::KnobType::numbers:
  case base::KnobType::text:
  case base::KnobType::file:
    return knob.form.empty() ? "TEXT" : knob.form;
  }
  return "TEXT";
}

std::string helpOf(const base::Knob& knob) {
  return knob.help + (knob.otherwise == "set by the preset" ? ". Default: set by the preset" : "");
}

// "Do not turn ..." of "Turn ...", "Mobile path: do not shade ..." of "Mobile path: shade ...".
std::string negated(std::string help) {
  constexpr std::string_view kPrefix = " path: ";
  const std::size_t colon = help.find(kPrefix), begin = colon == std::string::npos ? 0 : colon + kPrefix.size();
  help[begin] = static_cast<char>(std::tolower(static_cast<unsigned char>(help[begin])));
  return help.insert(begin, begin == 0 ? "Do not " : "do not ");
}

// Settings of one path alone have a heading of their own.
std::string groupOf(const base::Knob& knob) {
  if (knob.group != "Paths" || knob.paths.empty()) return knob.group;
  return fmt::format("{} {}", knob.paths.size() == 1 ? "Path" : "Paths", fmt::join(knob.paths, " and "));
}

// Sets what is given.
class Taker {
public:
  Taker(const base::Knob& knob, std::string name, const std::function<void(const base::KnobValue&)>& check,
        base::GivenKnobs& given)
      : m_id(knob.id), m_name(std::move(name)), m_check(check), m_given(given) {}

  void take(base::KnobValue value) const {
    const std::string option = "--" + m_name;
    try {
      m_check(value);
    } catch (const base::KnobError& error) {
      throw CLI::ValidationError(option, error.reason);
    }
    if (m_name != m_id && m_name != "no-" + m_id) base::logInfo(fmt::format("{} is now called --{}", option, m_id));
    m_given[m_id] = {std::move(value), option};
  }

private:
  std::string m_id, m_name;
  std::function<void(const base::KnobValue&)> m_check;
  base::GivenKnobs& m_given;
};

// One name; the first of a knob is shown in --help.
void addName(CLI::App& app, const base::Knob& knob, const std::string& name, bool isShown,
             const std::string& defaultText, const Taker& taker) {
  const std::string group = isShown ? groupOf(knob) : "";
  if (knob.type == base::KnobType::texts) {
    repeat(app.add_option_function<std::vector<std::string>>(
               "--" + name, [taker](const std::vector<std::string>& values) { taker.take(values); }, helpOf(knob)))
        ->type_name(typeOf(knob))
        ->group(group);
    return;
  }
  app.add_option_function<std::string>(
         "--" + name, [taker](const std::string& text) { taker.take({text}); }, helpOf(knob))
      ->type_name(typeOf(knob))
      ->default_str(defaultText)
      ->group(group);
}

} // namespace

void addKnobOption(CLI::App& app, const base::Knob& knob, const std::string& defaultText,
                   const std::function<void(const base::KnobValue&)>& check, base::GivenKnobs& given) {
  std::vector<std::string> names = {knob.id};
  names.insert(names.end(), knob.aliases.begin(), knob.aliases.end());
  for (const std::string& name : names) {
    const bool isFirst = &name == &names.front();
    if (knob.type != base::KnobType::flag) {
      addName(app, knob, name, isFirst, defaultText, Taker(knob, name, check, given));
      continue;
    }
    // Of what is on already the help shows how it is switched off.
    const bool isOn = defaultText == "on";
    for (const bool value : {true, false}) {
      const std::string option = value ? name : "no-" + name;
      const Taker taker(knob, option, check, given);
      app.add_flag_callback(
             "--" + option, [taker, value] { taker.take({value ? "on" : "off"}); },
             isOn ? negated(helpOf(knob)) : helpOf(knob))
          ->group(isFirst && value != isOn ? groupOf(knob) : "");
    }
  }
}

void addRepeatableKnob(CLI::App& app, const base::Knob& knob, base::GivenKnobs& given, std::vector<std::string>& all) {
  std::vector<std::string> names = {knob.id};
  names.insert(names.end(), knob.aliases.begin(), knob.aliases.end());
  for (const std::string& name : names)
    repeat(app.add_option_function<std::vector<std::string>>(
               "--" + name,
               [&knob, &given, &all, name](const std::vector<std::string>& values) {
                 all.insert(all.end(), values.begin(), values.end());
                 given[knob.id] = {{all.front()}, "--" + name};
               },
               helpOf(knob) + " (repeatable)"))
        ->type_name(typeOf(knob))
        ->group(name == knob.id ? groupOf(knob) : "");
}

void addFormulaKnobs(CLI::App& app, const std::vector<std::string>& ids, base::GivenKnobs& given) {
  addKnobOptions(app, job::knobs(), job::Settings(), given,
                 [&](const base::Knob& knob) { return std::ranges::count(ids, knob.id) > 0; });
}

} // namespace parity::cli
