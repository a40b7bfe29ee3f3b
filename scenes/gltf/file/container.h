// The binary container of glTF 2.0 (.glb): a header and length-prefixed chunks.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace parity::scenes {

// Views into the file's bytes.
struct GlbChunks {
  std::string_view json;
  std::span<const std::byte> binary; // empty where there is no BIN chunk
  bool hasBinary = false;
};

// Whether the bytes start with the magic "glTF" of the container (else they are taken for JSON text).
bool isGlb(std::span<const std::byte> bytes);

// Splits a container (glTF 2.0 specification, section 4.4). `label` is for messages. Throws Error (exit 4) with the
// byte offset: truncated, wrong version, a chunk that leaves the file, no JSON chunk first.
GlbChunks splitGlb(std::span<const std::byte> bytes, const std::string& label);

} // namespace parity::scenes
