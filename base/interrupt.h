// What a run says when it is interrupted.
#pragma once

#include <string>

namespace parity::base {

// From the first call on SIGINT and SIGTERM write "error: " and this line to stderr and then end the process as ever,
// by the signal; one that is ignored (of a job in the background) stays so. Each call takes the place of the one
// before. Any thread may call it.
void setInterruptNote(const std::string& line);

} // namespace parity::base
