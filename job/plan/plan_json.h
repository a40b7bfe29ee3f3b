// plan.json: a plan as text and back.
#pragma once

#include <string>
#include <string_view>

#include "job/plan/plan.h"

namespace parity::job {

// withShards: without them the text is what the digest is made of. Throws Error (exit 4) for a
// path that is not UTF-8.
std::string planText(const Plan& plan, bool withShards);

// Throws std::exception where the text is no plan; its digest is not set. The build is not looked at.
Plan planFromText(std::string_view text);

} // namespace parity::job
