// Small sound pictures that carry an ICC profile, made by hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace parity::base {

// An ICC.1:2010 profile of one tag, whose place in the profile is as told; an honest one lies at 144.
std::string makeIccProfile(const std::string& tag, std::uint32_t offset, std::uint32_t size,
                           const std::string& value = "");

// Of which offset + size, in 32 bits, is small, though offset or size is not.
std::vector<std::string> makeWrappingProfiles();

// "a.jpg", "a.png", "a.tif", "a.webp" with the profile in them; empty: without one. Grey or black, 2 to 8 pixels a
// side.
std::map<std::string, std::vector<std::byte>> makeProfiledImages(const std::string& profile);

} // namespace parity::base
