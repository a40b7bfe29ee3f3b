// What went wrong, in words of ours: libraries' own texts mean nothing to who reads a message.
#pragma once

#include <exception>
#include <string>

namespace parity::base {

// An Error's own line. Of others: what could not be had (memory, a file), or the library's words without its tag
// ("[json.exception.type_error.302] type must be string" -> "type must be string"). Of a bug of ours only that it is
// one.
std::string wordsOf(const std::exception& error);

} // namespace parity::base
