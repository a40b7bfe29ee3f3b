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
  case Verdict::error:
    return "error";
  }
  return "error";
}

bool AppliedRule::accepts(Accept what) const { return std::ranges::find(accept, what) != accept.end(); }

} // namespace parity::compare
