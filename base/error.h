// The one error type: what could not be read, rendered, compared or written, where, and why.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace parity::base {

// Process exit codes (docs/design.md 8a). The highest that applies to a run wins; usage stands apart.
enum class ExitCode : int {
  withinBudget = 0,
  warningsOnly = 1,
  overBudget = 2,
  notComparable = 3,
  failed = 4, // something could not be read, rendered or written
  usage = 64,
  incomplete = 75, // `parity work`: try again (EX_TEMPFAIL)
  otherPlan = 78,  // another plan, build or machine (EX_CONFIG)
};

// Thrown for whatever can fail at run time. what() is one line, "subject: place: reason" (of an ErrorList: several).
class Error : public std::runtime_error {
public:
  // subject: the file, device or option; place: where in it (may be empty); reason: why, in words.
  Error(ExitCode code, std::string subject, std::string place, std::string reason)
      : std::runtime_error(oneLine(subject, place, reason)), m_code(code), m_subject(std::move(subject)),
        m_place(std::move(place)), m_reason(std::move(reason)) {}

  ExitCode code() const { return m_code; }
  const std::string& subject() const { return m_subject; }
  const std::string& place() const { return m_place; }
  const std::string& reason() const { return m_reason; }

private:
  static std::string oneLine(const std::string& subject, const std::string& place, const std::string& reason) {
    std::string line = subject;
    for (const std::string* part : {&place, &reason})
      if (!part->empty()) line += (line.empty() ? "" : ": ") + *part;
    for (char& c : line)
      if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    return line;
  }

  ExitCode m_code;
  std::string m_subject, m_place, m_reason;
};

// Several things that are wrong with one subject, told together: what() has a line for each. Code, place and reason are
// those of the first.
class ErrorList : public Error {
public:
  // errors: at least one; more: how many others there are.
  explicit ErrorList(const std::vector<Error>& errors, std::size_t more = 0) : Error(errors.front()) {
    for (const Error& error : errors) m_text += (m_text.empty() ? "" : "\n") + std::string(error.what());
    if (more > 0) m_text += "\n" + subject() + ": and " + std::to_string(more) + " more problems";
  }
  const char* what() const noexcept override { return m_text.c_str(); }

private:
  std::string m_text;
};

// The common case: a file that cannot be used (exit 4).
inline Error fileError(std::string file, std::string place, std::string reason) {
  return Error(ExitCode::failed, std::move(file), std::move(place), std::move(reason));
}

} // namespace parity::base
