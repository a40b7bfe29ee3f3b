// The one check for run-time failures: the type, the exit code, and what the message holds.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/lines_of.h"

namespace parity::base {

// An Error with all that it says, also where it is a list of them.
class Caught : public Error {
public:
  explicit Caught(const Error& error) : Error(error), m_text(error.what()) {}
  const char* what() const noexcept override { return m_text.c_str(); }

private:
  std::string m_text;
};

// The Error that `call` throws; fails the test where it throws none.
template <typename Call> Caught errorOf(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return Caught(error);
  }
  ADD_FAILURE() << "no Error";
  return Caught({ExitCode::withinBudget, "no Error", "", ""});
}

// call must throw Error with `code` whose message holds every part and each of whose lines begins with the subject.
// Returns the message.
template <typename Call>
std::string expectError(Call&& call, const std::vector<std::string>& parts, ExitCode code = ExitCode::failed) {
  const Caught error = errorOf(call);
  std::string message = error.what();
  EXPECT_EQ(error.code(), code) << message;
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
  for (const std::string& line : tests::linesOf(message))
    EXPECT_TRUE(line.starts_with(error.subject() + ": ")) << message;
  return message;
}

// The same of two parts, in a message of one line.
template <typename Call>
void expectError(Call&& call, const std::string& subject, const std::string& reason, ExitCode code = ExitCode::failed) {
  const std::string message = expectError(call, std::vector{subject, reason}, code);
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

} // namespace parity::base
