// Knobs bound to the members of a struct that they set.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/knob/knob.h"

namespace parity::base {

// The member of a member ...: memberAt<&Settings::mobile, &mobile::Options::sky>(settings).
template <auto first, auto... rest> auto& memberAt(auto& object) {
  if constexpr (sizeof...(rest) > 0)
    return memberAt<rest...>(object.*first);
  else
    return object.*first;
}

template <typename T> struct KnobRow {
  Knob knob;
  std::function<void(T&, const KnobValue&)> set; // throws KnobError
  std::function<std::string(const T&)> text;     // one text a value
  std::function<std::string(const T&)> words;    // the value for people; empty: the text says it
  std::function<std::string(const T&)> path;     // of KnobType::file: as it was given; "": none
  std::function<std::string(const T&)> pinned;   // the text by which the same value is read again; empty: `text`

  // More of the row, in the order of the table.
  KnobRow& titled(std::string title) { return knob.title = std::move(title), *this; }
  KnobRow& alias(std::string name) { return knob.aliases.push_back(std::move(name)), *this; }
  KnobRow& otherwise(std::string what) { return knob.otherwise = std::move(what), *this; }
  KnobRow& actsOn(ActsOn what) { return knob.actsOn = what, *this; }
  KnobRow& costs(KnobStage stage) { return knob.stage = stage, *this; }
  KnobRow& needs(std::string other) { return knob.needsKnob = std::move(other), *this; }
  KnobRow& needsScene(std::string what) { return knob.needsScene = std::move(what), *this; }
  KnobRow& listedAs(std::string key) { return knob.listKey = std::move(key), *this; }
  KnobRow& orFolder() { return knob.takesFolder = true, *this; }
  KnobRow& noOption() { return knob.isOption = knob.inSuite = false, *this; }
  KnobRow& noCondition() { return knob.isCondition = false, *this; }
  KnobRow& notInSuite() { return knob.inSuite = false, *this; }
  KnobRow& ofScene() { return knob.ofScene = true, *this; }
  KnobRow& pinnedBy(std::function<std::string(const T&)> make) { return pinned = std::move(make), *this; }
  KnobRow& inWords(std::function<std::string(const T&)> make) { return words = std::move(make), *this; }
};

template <typename T> class KnobTable {
public:
  // group, paths: of the rows that follow.
  KnobTable& section(std::string group, std::vector<std::string> paths = {}) {
    m_group = std::move(group), m_paths = std::move(paths);
    return *this;
  }

  template <auto... member> KnobRow<T>& flag(std::string id, std::string help) {
    return add(
        KnobType::flag, std::move(id), std::move(help),
        [](T& t, const KnobValue& v) { memberAt<member...>(t) = readFlag(v.at(0)); },
        [](const T& t) { return std::string(memberAt<member...>(t) ? "on" : "off"); });
  }
  template <auto... member> KnobRow<T>& number(std::string id, double least, double most, std::string help) {
    return bounded(
        KnobType::number, std::move(id), least, most, std::move(help),
        [=](T& t, const KnobValue& v) { assign(memberAt<member...>(t), readNumber(v.at(0), least, most), v); },
        [](const T& t) { return numberText(memberAt<member...>(t)); });
  }
  template <auto... member> KnobRow<T>& whole(std::string id, double least, double most, std::string help) {
    return bounded(
        KnobType::whole, std::move(id), least, most, std::move(help),
        [=](T& t, const KnobValue& v) {
          auto& place = memberAt<member...>(t);
          place = static_cast<std::remove_reference_t<decltype(place)>>(readWhole(v.at(0), least, most));
        },
        [](const T& t) { return std::to_string(memberAt<member...>(t)); });
  }
  // An enumeration, by the names of its enumerators in their order.
  template <auto... member> KnobRow<T>& choice(std::string id, std::vector<std::string> names, std::string help) {
    KnobRow<T>& row = add(
        KnobType::choice, std::move(id), std::move(help),
        [names](T& t, const KnobValue& v) {
          auto& place = memberAt<member...>(t);
          place = static_cast<std::remove_reference_t<decltype(place)>>(readChoice(v.at(0), names));
        },
        [names](const T& t) { return names.at(static_cast<std::size_t>(memberAt<member...>(t))); });
    row.knob.choices = std::move(names);
    return row;
  }
  // A whole number that is one of a few.
  template <auto... member> KnobRow<T>& oneOf(std::string id, std::vector<std::string> values, std::string help) {
    KnobRow<T>& row = add(
        KnobType::choice, std::move(id), std::move(help),
        [values](T& t, const KnobValue& v) {
          auto& place = memberAt<member...>(t);
          place =
              static_cast<std::remove_reference_t<decltype(place)>>(std::stoll(values[readChoice(v.at(0), values)]));
        },
        [](const T& t) { return std::to_string(memberAt<member...>(t)); });
    row.knob.choices = std::move(values);
    return row;
  }
  // A text; none: what an empty one is called, which no user's text is, as that stands in quotes.
  template <auto... member> KnobRow<T>& text(std::string id, std::string none, std::string help) {
    KnobRow<T>& row = add(
        KnobType::text, std::move(id), std::move(help),
        [](T& t, const KnobValue& v) { memberAt<member...>(t) = v.at(0); },
        [none](const T& t) {
          const std::string& value = memberAt<member...>(t);
          return value.empty() ? none : listText({value}, "");
        });
    row.knob.otherwise = std::move(none);
    return row;
  }
  template <auto... member> KnobRow<T>& texts(std::string id, const char* none, std::string help) {
    KnobRow<T>& row = add(
        KnobType::texts, std::move(id), std::move(help), [](T& t, const KnobValue& v) { memberAt<member...>(t) = v; },
        [none](const T& t) { return listText(memberAt<member...>(t), none); });
    row.knob.otherwise = none;
    return row;
  }
  // A path, or builtin:NAME, or none, which is called so.
  template <auto... member> KnobRow<T>& file(std::string id, std::string form, std::string none, std::string help) {
    KnobRow<T>& row = text<member...>(std::move(id), std::move(none), std::move(help));
    row.knob.type = KnobType::file;
    row.knob.form = std::move(form);
    row.path = [](const T& t) { return memberAt<member...>(t); };
    return row;
  }
  // Any other: by what reads and what writes it.
  KnobRow<T>& special(KnobType type, std::string id, std::string form, std::string help,
                      std::function<void(T&, const std::string&)> set, std::function<std::string(const T&)> text) {
    KnobRow<T>& row = add(
        type, std::move(id), std::move(help), [set = std::move(set)](T& t, const KnobValue& v) { set(t, v.at(0)); },
        std::move(text));
    row.knob.form = std::move(form);
    return row;
  }

  // The rows of a struct that is a member, or that `at` finds in a T.
  template <auto... member, typename Sub> KnobTable& addAll(const KnobTable<Sub>& table) {
    return addAllAt(
        table, [](auto& t) -> auto& { return memberAt<member...>(t); });
  }
  template <typename Sub, typename At> KnobTable& addAllAt(const KnobTable<Sub>& table, At at) {
    for (const KnobRow<Sub>& row : table.rows()) {
      KnobRow<T>& lifted = m_rows.emplace_back();
      lifted.knob = row.knob;
      lifted.set = [set = row.set, at](T& t, const KnobValue& v) { set(at(t), v); };
      lifted.text = [text = row.text, at](const T& t) { return text(at(t)); };
      if (row.path) lifted.path = [path = row.path, at](const T& t) { return path(at(t)); };
      if (row.pinned) lifted.pinned = [pinned = row.pinned, at](const T& t) { return pinned(at(t)); };
      if (row.words) lifted.words = [words = row.words, at](const T& t) { return words(at(t)); };
    }
    return *this;
  }

  const std::vector<KnobRow<T>>& rows() const { return m_rows; }
  // By id or alias; null where there is none.
  const KnobRow<T>* find(const std::string& name) const {
    const auto found = std::ranges::find_if(m_rows, [&](const KnobRow<T>& row) {
      return row.knob.id == name || std::ranges::count(row.knob.aliases, name) > 0;
    });
    return found == m_rows.end() ? nullptr : &*found;
  }

  // Sets what is given, in the order of the rows: a preset stands above what it sets. Throws Error (usage) with the
  // place as it was given.
  void apply(T& settings, const GivenKnobs& given) const {
    for (const KnobRow<T>& row : m_rows) {
      const auto found = given.find(row.knob.id);
      if (found == given.end()) continue;
      try {
        row.set(settings, found->second.value);
      } catch (const KnobError& error) {
        throw Error(ExitCode::usage, found->second.where, "", error.reason);
      }
    }
  }

private:
  static void assign(double& place, double value, const KnobValue&) { place = value; }
  static void assign(float& place, double, const KnobValue& v) { place = std::strtof(v[0].c_str(), nullptr); }

  KnobRow<T>& add(KnobType type, std::string id, std::string help, std::function<void(T&, const KnobValue&)> set,
                  std::function<std::string(const T&)> text) {
    KnobRow<T>& row = m_rows.emplace_back();
    row.knob.id = std::move(id);
    row.knob.title = row.knob.id;
    std::ranges::replace(row.knob.title, '-', ' ');
    row.knob.help = std::move(help);
    row.knob.group = m_group;
    row.knob.paths = m_paths;
    row.knob.type = type;
    row.set = std::move(set);
    row.text = std::move(text);
    return row;
  }
  KnobRow<T>& bounded(KnobType type, std::string id, double least, double most, std::string help,
                      std::function<void(T&, const KnobValue&)> set, std::function<std::string(const T&)> text) {
    KnobRow<T>& row = add(type, std::move(id), std::move(help), std::move(set), std::move(text));
    row.knob.least = least, row.knob.most = most;
    return row;
  }

  std::string m_group;
  std::vector<std::string> m_paths;
  std::vector<KnobRow<T>> m_rows;
};

} // namespace parity::base
