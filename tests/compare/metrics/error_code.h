// The exit code that a call fails with.
#pragma once

#include <functional>

#include "base/error.h"

namespace parity::test {

// Of the Error that `call` throws; withinBudget where it throws none.
inline base::ExitCode codeOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const base::Error& error) {
    return error.code();
  }
  return base::ExitCode::withinBudget;
}

} // namespace parity::test
