// Options that are knobs: made from the rows of a table. Only for the files that know CLI11.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/knob/table.h"

namespace parity::cli {

// An option of this knob, its older names too; what is given goes to `given`, which must outlive the app. check: throws
// KnobError for a value that is refused. defaultText: "" where the help says it.
void addKnobOption(CLI::App& app, const base::Knob& knob, const std::string& defaultText,
                   const std::function<void(const base::KnobValue&)>& check, base::GivenKnobs& given);

// The same of a knob that is a file and that a command takes several of: `all` holds each in its order, `given` the
// first.
void addRepeatableKnob(CLI::App& app, const base::Knob& knob, base::GivenKnobs& given, std::vector<std::string>& all);

// Options of all rows that are some, and are wanted. defaults: what holds where nothing is given.
template <typename T> void addKnobOptions(CLI::App& app, const base::KnobTable<T>& table, const T& defaults,
                                          base::GivenKnobs& given,
                                          const std::function<bool(const base::Knob&)>& isWanted) {
  for (const base::KnobRow<T>& row : table.rows()) {
    if (!row.knob.isOption || !isWanted(row.knob)) continue;
    const auto check = [&row](const base::KnobValue& value) {
      T scratch;
      row.set(scratch, value);
    };
    const bool isShown = row.knob.type == base::KnobType::flag || row.knob.otherwise.empty();
    addKnobOption(app, row.knob, isShown ? row.text(defaults) : "", check, given);
  }
}

// Those of a run's knobs with these ids: for tools that work on formulas alone.
void addFormulaKnobs(CLI::App& app, const std::vector<std::string>& ids, base::GivenKnobs& given);

// Throws CLI::RequiresError where a knob is given whose option needs another one of the app that is not.
template <typename T>
void requireNeeds(const CLI::App& app, const base::KnobTable<T>& table, const base::GivenKnobs& given) {
  for (const auto& [id, value] : given) {
    const base::KnobRow<T>* row = table.find(id);
    if (!row || row->knob.needsKnob.empty() || given.contains(row->knob.needsKnob)) continue;
    const std::string other = "--" + row->knob.needsKnob;
    if (app.get_option_no_throw(other)) throw CLI::RequiresError(value.where, other);
  }
}

} // namespace parity::cli
