#include "compare/verdict/check.h"

#include <algorithm>

namespace parity::compare {

const char* nameOf(Verdict verdict) {
  switch (verdict) {
  case Verdict::pass:
    return "pass";
  case Verdict::notSeen:
    return "not seen";
  case Verdict::tooSmall:
    return "too small";
  case Verdict::notJudged:
    return "not judged";
  case Verdict::warn:
    return "warn";
  case Verdict::fail:
    return "fail";
  case Verdict::notRun:
    return "not run";
  case Verdict::error:
    return "error";
  }
  return "error";
}

const char* nameOf(ApprovalState state) {
  switch (state) {
  case ApprovalState::holds:
    return "holds";
  case ApprovalState::loose:
    return "loose";
  case ApprovalState::expired:
    return "expired";
  case ApprovalState::lapsed:
    return "lapsed";
  }
  return "lapsed";
}

bool AppliedRule::accepts(Accept what) const { return std::ranges::find(accept, what) != accept.end(); }

} // namespace parity::compare
