// A knob: one setting of a run, described once. The command line and its --help, suite files, conditions of reports and
// cache keys, the settings of a bench and the reference pages of the documentation are made from it.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace parity::base {

// The figures of a report that change with a knob.
enum class ActsOn {
  figures, // all but the truth's
  wholes,  // those of whole images alone
  truth,   // those against the truth alone
  nothing, // none: it decides what else a result holds, so it is in no report
};

// How a value is written: on the command line as one text (`texts`: the option is repeatable), in a suite file as
// TOML's own type.
enum class KnobType {
  flag,    // --knob, --no-knob; true, false
  number,  // from `least` to `most`
  whole,   // a whole number from `least` to `most`
  numbers, // `form` names them: "R,G,B"; [r, g, b]
  choice,  // one of `choices`
  text,    // any but an empty one
  file,    // a path: of a suite file relative to its folder; or "builtin:NAME"
  texts,   // a list of globs
};

// A value as it was written; more than one text only of KnobType::texts.
using KnobValue = std::vector<std::string>;

// Where a knob costs run time: nowhere that is timed, for every pixel, once before the first pixel, or only bits of
// what is stored.
enum class KnobStage { none, shading, preparation, storage };

struct Knob {
  std::string id{};                   // --id on the command line; in a suite file with '_' for '-'
  std::vector<std::string> aliases{}; // older names, in the same form
  std::string title{};                // in reports
  std::string help{};                 // a sentence, line feeds where it wraps
  std::string group{};                // heading of --help
  KnobType type = KnobType::flag;
  std::vector<std::string> choices{};
  bool takesFolder = false; // choice: also the path of a folder; of a suite file relative to its own
  double least = 0, most = 0;
  std::string form{};               // of KnobType::numbers: names separated by commas
  std::string otherwise{};          // in words: what holds where it is not given; empty: the default's text
  ActsOn actsOn = ActsOn::figures;  // what of a report
  std::vector<std::string> paths{}; // on whose pictures; empty: on all
  KnobStage stage = KnobStage::none;
  std::string needsKnob{};  // id of a knob without which it does nothing
  std::string needsScene{}; // what a scene must have for it to do anything: "environment"; empty: nothing
  std::string listKey{}; // in suite files: key of a list of its values, a scene for each ("environments"); empty: none
  bool isCondition = true; // of a result: not what only judges it afterwards
  bool isOption = true;    // on the command line
  bool inSuite = true;     // in suite files
  bool ofScene = false;    // says what a scene is: listed with each scene, and no option beside a suite
};

// Thrown by what reads a value: why it is refused, as "'x' is not a number from 0 to 1".
struct KnobError {
  std::string reason;
};

// Knobs that were given, by id.
struct GivenKnob {
  KnobValue value;
  std::string where; // as messages name it: "--fov", "suite.toml: line 3: fov"
};
using GivenKnobs = std::map<std::string, GivenKnob>;

// What both have, `stronger` where they differ.
GivenKnobs merged(const GivenKnobs& weaker, const GivenKnobs& stronger);

// "sky_light_color" for "sky-light-color": the key of a suite file.
std::string keyOf(std::string_view id);

// Values from text. Throw KnobError.
bool readFlag(const std::string& text);                                           // "on", "off"
double readNumber(const std::string& text, double least, double most);            // finite
long long readWhole(const std::string& text, double least, double most);          //
std::vector<float> readNumbers(const std::string& text, const std::string& form); // as many as the form names, finite
std::size_t readChoice(const std::string& text, const std::vector<std::string>& choices); // its place
double readShare(const std::string& text);      // "0.5%" or "0.005": from 1e-6 to 1
double readSeconds(const std::string& text);    // "300", "300s", "5m", "2h": above 0
std::size_t readBytes(const std::string& text); // "500M", "4G", "1048576": powers of 1024, at least 1

// Numbers as the shortest text that reads back as the very same.
std::string numberText(double value);
std::string numberText(float value);
std::string numbersText(const float* values, std::size_t count); // "1,2,3"
// Each in quotes, so that two lists are never one text; `none` where there is none.
std::string listText(const KnobValue& list, const char* none);

} // namespace parity::base
