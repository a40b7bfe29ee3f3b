// KHR_materials_variants: which material a primitive has in the variant asked for.
#include "scenes/gltf/variants.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace parity::scenes {

std::size_t findNamed(const std::vector<std::string>& names, const std::string& wanted, const std::string& label,
                      const char* option, const char* what) {
  if (const auto found = std::find(names.begin(), names.end(), wanted); found != names.end() && !wanted.empty())
    return static_cast<std::size_t>(found - names.begin());
  std::size_t index = 0;
  const char* end = wanted.data() + wanted.size();
  const auto parsed = std::from_chars(wanted.data(), end, index);
  if (parsed.ec == std::errc{} && parsed.ptr == end && index < names.size()) return index;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < names.size() && i < 16; ++i) known.push_back(fmt::format("'{}' ({})", names[i], i));
  if (known.size() < names.size()) known.push_back(fmt::format("and {} more", names.size() - known.size()));
  throw base::Error(base::ExitCode::usage, option, "",
                    known.empty()
                        ? fmt::format("'{}' is unknown: {} has no {}", wanted, label, what)
                        : fmt::format("{} has no {} '{}'; known: {}", label, what, wanted, fmt::join(known, ", ")));
}

std::optional<int> chooseVariant(const GltfDocument& document) {
  if (document.options.variant.empty()) return std::nullopt;
  return static_cast<int>(
      findNamed(document.facts.variants, document.options.variant, document.label, "--variant", "variant"));
}

int materialOf(const tinygltf::Primitive& primitive, std::optional<int> variant) {
  if (!variant) return primitive.material;
  const auto found = primitive.extensions.find("KHR_materials_variants");
  if (found == primitive.extensions.end()) return primitive.material;
  const tinygltf::Value& mappings = found->second.Get("mappings");
  for (int m = 0; m < static_cast<int>(mappings.ArrayLen()); ++m) {
    const tinygltf::Value& mapping = mappings.Get(m);
    const tinygltf::Value& variants = mapping.Get("variants");
    for (int v = 0; v < static_cast<int>(variants.ArrayLen()); ++v)
      if (variants.Get(v).GetNumberAsInt() == *variant) return mapping.Get("material").GetNumberAsInt();
  }
  return primitive.material;
}

} // namespace parity::scenes
