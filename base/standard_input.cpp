#include "base/standard_input.h"

#include <array>
#include <cerrno>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"

namespace parity::base {

std::string readStdin(std::size_t maxBytes) {
  std::string text;
  std::array<char, 1 << 16> part{};
  for (;;) {
    const ssize_t count = ::read(STDIN_FILENO, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw fileError("stdin", "cannot be read", std::generic_category().message(errno));
    if (count == 0) return text;
    text.append(part.data(), static_cast<std::size_t>(count));
    if (text.size() > maxBytes) throw fileError("stdin", "", fmt::format("is larger than {} bytes", maxBytes));
  }
}

} // namespace parity::base
