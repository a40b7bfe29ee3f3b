// How the scanlines of a Radiance HDR file run, by its header.
#include "base/image/hdr_header.h"

#include <algorithm>
#include <string_view>

#include "base/error.h"

namespace parity::base {

int readHdrOrientation(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 16;
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kMaxHeaderBytes));
  const std::size_t end = text.find("\n\n"); // an empty line ends the variables
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 2);
  text = text.substr(0, text.find('\n'));
  struct Order {
    std::string_view scanlines, pixels;
    int orientation;
  };
  constexpr Order kOrders[] = {{"-Y ", " +X ", 1}, {"-Y ", " -X ", 2}, {"+Y ", " -X ", 3}, {"+Y ", " +X ", 4},
                               {"+X ", " -Y ", 5}, {"-X ", " -Y ", 6}, {"-X ", " +Y ", 7}, {"+X ", " +Y ", 8}};
  for (const Order& order : kOrders)
    if (text.starts_with(order.scanlines) && text.find(order.pixels) != std::string_view::npos)
      return order.orientation;
  throw fileError(name, "header", "the resolution string is not of the form '-Y 512 +X 1024'");
}

} // namespace parity::base
