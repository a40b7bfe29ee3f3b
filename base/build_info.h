// How this program was built, for people: parity --version.
#pragma once

#include <string>

namespace parity::base {

// "GCC 12.2.0, Release, build 3fd1a20b9c4e": compiler, build type, and the first digits of the linker's build id, which
// is another one for each program that differs. What is not known is left out.
std::string describeBuild();

} // namespace parity::base
