// Real assets and environments, where the machine has them.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace parity::tests {

// PARITY_SHARED/assets, or ../shared/assets beside the sources; empty where it is absent.
inline std::filesystem::path sharedAssets() {
  const char* variable = std::getenv("PARITY_SHARED");
  std::filesystem::path shared(variable ? variable : "../shared");
  if (shared.is_relative()) shared = std::filesystem::path(PARITY_SOURCE_DIR) / shared;
  return std::filesystem::exists(shared / "assets" / "manifest.json") ? shared / "assets" : std::filesystem::path();
}

// An environment there, as "studio_small_05_1k.hdr"; empty where it is absent.
inline std::filesystem::path sharedEnvironment(const std::filesystem::path& name) {
  const std::filesystem::path assets = sharedAssets(), file = assets / "env" / name;
  return !assets.empty() && std::filesystem::exists(file) ? file : std::filesystem::path();
}

} // namespace parity::tests
