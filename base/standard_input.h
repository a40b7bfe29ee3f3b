// Standard input, read whole.
#pragma once

#include <cstddef>
#include <string>

namespace parity::base {

// Throws Error (exit 4) where it cannot be read or is larger.
std::string readStdin(std::size_t maxBytes);

} // namespace parity::base
