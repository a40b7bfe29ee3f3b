// The one check for run-time failures: the type, the exit code, and that one line names the file and the reason.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "base/error.h"

namespace parity::base {

// body must throw Error with `code` whose only line holds both `subject` and `reason`.
template <typename Body>
void expectError(Body&& body, const std::string& subject, const std::string& reason, ExitCode code = ExitCode::failed) {
  try {
    body();
  } catch (const Error& error) {
    const std::string line = error.what();
    EXPECT_EQ(error.code(), code) << line;
    EXPECT_NE(line.find(subject), std::string::npos) << "no '" << subject << "' in: " << line;
    EXPECT_NE(line.find(reason), std::string::npos) << "no '" << reason << "' in: " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return;
  }
  ADD_FAILURE() << "no Error: expected '" << subject << "' and '" << reason << "'";
}

} // namespace parity::base
