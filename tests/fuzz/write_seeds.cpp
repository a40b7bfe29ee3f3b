// fuzz_seeds FOLDER: writes what the fuzz targets begin with: FOLDER/gltf/*, FOLDER/gltf.dict, and so for environment
// and image.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <span>
#include <string>

#include "base/file.h"
#include "fuzz/environment_seeds.h"
#include "fuzz/gltf_seeds.h"
#include "fuzz/image_seeds.h"
#include "fuzz/words.h"

namespace {

// In libFuzzer's syntax: one quoted word a line.
std::string makeDictionary(std::span<const char* const> words) {
  std::string text;
  for (const std::string word : words) {
    if (word.empty()) continue;
    text += '"';
    for (const char c : word) {
      constexpr char kDigits[] = "0123456789abcdef";
      const auto value = static_cast<unsigned char>(c);
      if (value < 0x20 || value > 0x7e || c == '"' || c == '\\')
        text += {'\\', 'x', kDigits[value >> 4], kDigits[value & 15]};
      else
        text += c;
    }
    text += "\"\n";
  }
  return text;
}

} // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: fuzz_seeds FOLDER\n", stderr);
    return 64;
  }
  try {
    const std::filesystem::path folder = arguments[1];
    for (const auto& [name, bytes] : parity::tests::makeGltfSeeds())
      parity::base::writeBytes(folder / "gltf" / name, bytes);
    for (const auto& [name, bytes] : parity::tests::makeEnvironmentSeeds())
      parity::base::writeBytes(folder / "environment" / name, bytes);
    for (const auto& [name, bytes] : parity::tests::makeImageSeeds())
      parity::base::writeBytes(folder / "image" / name, bytes);
    parity::base::writeText(folder / "gltf.dict",
                            makeDictionary(parity::tests::kGltfKeys) + makeDictionary(parity::tests::kGltfValues));
    parity::base::writeText(folder / "environment.dict", makeDictionary(parity::tests::kEnvironmentWords));
    parity::base::writeText(folder / "image.dict", makeDictionary(parity::tests::kImageWords));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 4;
  }
}
