// Values of conditions as text: one text a value, and the same value back from it.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "base/texture_block.h"
#include "gpu/output_target.h"
#include "mobile/options.h"

namespace parity::job {

inline std::string valueText(std::string_view text) { return std::string(text); }
template <std::same_as<bool> T> std::string valueText(T isOn) { return isOn ? "on" : "off"; }
// The shortest digits that read back as the very number.
template <typename T>
requires std::is_arithmetic_v<T> &&(!std::same_as<T, bool>)std::string valueText(T number) {
  return fmt::format("{}", number);
}
std::string valueText(const glm::vec3& v); // "x,y,z"
std::string valueText(const std::vector<glm::vec3>& list);
std::string valueText(const std::vector<std::string>& list); // each in quotes

// What a user wrote, in quotes, so that it is none of our words; `none` where it is empty.
std::string quotedOr(const std::string& text, const char* none);
std::string listOr(const std::vector<std::string>& list, const char* none);
// The same for people, without quotes.
std::string wordsOf(const std::vector<std::string>& list, const char* none);

template <typename Enum> const std::string& nameAt(const std::vector<std::string>& names, Enum value) {
  return names.at(static_cast<std::size_t>(value));
}

// asked: by the options; taken: what the device can.
std::string describePrecision(mobile::Precision asked, mobile::Precision taken);
std::string describeTarget(gpu::OutputTarget target);
std::string describeTextures(base::TextureBlock block);

} // namespace parity::job
