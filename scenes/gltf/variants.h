// KHR_materials_variants: which material a primitive has in the variant asked for.
#pragma once

#include <optional>

#include "scenes/gltf/file/document.h"

namespace parity::scenes {

// The variant that the options name, by name or index; nothing where they name none. Throws Error (usage) listing those
// of the file where there is no such one.
std::optional<int> chooseVariant(const GltfDocument& document);

// The material of a primitive, -1 for the default one. Without a mapping for the variant: its own.
int materialOf(const tinygltf::Primitive& primitive, std::optional<int> variant);

// The place in `names` of a name or an index. Throws Error (usage) with the option's name and a list of what there is.
std::size_t findNamed(const std::vector<std::string>& names, const std::string& wanted, const std::string& label,
                      const char* option, const char* what);

} // namespace parity::scenes
