// Content hashes: XXH3 with 128 bits (Y. Collet, xxHash 0.8).
#include "base/hash.h"

#include <cstdint>
#include <new>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/file.h"

namespace parity::base {

namespace {
XXH3_state_t* stateOf(void* state) { return static_cast<XXH3_state_t*>(state); }
} // namespace

Hasher::Hasher() : m_state(XXH3_createState()) {
  if (!m_state) throw std::bad_alloc();
  XXH3_128bits_reset(stateOf(m_state));
}

Hasher::~Hasher() { XXH3_freeState(stateOf(m_state)); }

Hasher& Hasher::add(std::span<const std::byte> bytes) {
  if (!bytes.empty()) XXH3_128bits_update(stateOf(m_state), bytes.data(), bytes.size());
  return *this;
}

Hasher& Hasher::add(std::string_view text) {
  addValue(static_cast<std::uint64_t>(text.size()));
  return add(std::as_bytes(std::span{text}));
}

std::string Hasher::hex() const {
  XXH128_canonical_t canonical; // big-endian, so that the digits do not depend on the machine
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(stateOf(m_state)));
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : canonical.digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

std::string hashOfFile(const std::filesystem::path& file) { return Hasher().add(readFile(file)).hex(); }

} // namespace parity::base
