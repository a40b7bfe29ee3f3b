// Base64 (RFC 4648, section 4).
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace parity::report {

// Without line breaks, padded by '='.
std::string toBase64(std::span<const std::byte> bytes);

} // namespace parity::report
