// Where a long text goes, piece by piece, so that nobody holds all of it.
#pragma once

#include <functional>
#include <string_view>

namespace parity::base {

using TextSink = std::function<void(std::string_view piece)>;

} // namespace parity::base
