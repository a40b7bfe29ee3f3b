// Small sound pictures of every format that is read, with an ICC profile where the format holds one: what fuzzing
// begins with.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace parity::tests {

// By name, "profile.jpg". Each loads.
std::map<std::string, std::vector<std::byte>> makeImageSeeds();

} // namespace parity::tests
