// What a uri in a glTF file may name: data within itself, or a file in the asset's own folder. Nothing else.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace parity::scenes {

bool isDataUri(std::string_view uri);

// The bytes of "data:[type][;base64],...". Throws std::invalid_argument with the reason.
std::vector<std::byte> decodeDataUri(std::string_view uri);

// The file that a relative uri names, percent-decoded; it may or may not exist. `folder` is the asset's folder,
// canonical. Throws std::invalid_argument with the reason where the uri is absolute, has a scheme, or leaves the
// folder: by "..", by percent-encoding or through symbolic links.
std::filesystem::path resolveUri(const std::filesystem::path& folder, std::string_view uri);

// The same file by the name that the asset has for it, links and all. Throws std::invalid_argument where its
// percent-encoding is none.
std::filesystem::path nameOfUri(const std::filesystem::path& folder, std::string_view uri);

} // namespace parity::scenes
