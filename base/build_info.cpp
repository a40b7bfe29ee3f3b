#include "base/build_info.h"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

namespace parity::base {

namespace {

std::string compiler() {
#if defined(__clang__)
  return fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  return fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  return {};
#endif
}

// Of the program: the first object that the loader lists. The note is owner, kind and bytes, each padded to 4 bytes.
int readBuildId(dl_phdr_info* object, std::size_t, void* id) {
  constexpr std::size_t kShownBytes = 6;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = object->dlpi_phdr[i];
    if (header.p_type != PT_NOTE) continue;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader gives the address as a number
    const auto* at = reinterpret_cast<const unsigned char*>(object->dlpi_addr + header.p_vaddr);
    const unsigned char* const end = at + header.p_memsz;
    while (at + sizeof(ElfW(Nhdr)) <= end) {
      ElfW(Nhdr) note;
      std::memcpy(&note, at, sizeof(note));
      const unsigned char* owner = at + sizeof(note);
      const unsigned char* bytes = owner + (note.n_namesz + 3u) / 4 * 4;
      at = bytes + (note.n_descsz + 3u) / 4 * 4;
      if (note.n_type != NT_GNU_BUILD_ID || note.n_namesz != 4 || std::memcmp(owner, "GNU", 4) != 0 || at > end)
        continue;
      for (std::size_t b = 0; b < std::min<std::size_t>(note.n_descsz, kShownBytes); ++b)
        *static_cast<std::string*>(id) += fmt::format("{:02x}", bytes[b]);
      return 1;
    }
  }
  return 1;
}

} // namespace

std::string describeBuild() {
  std::string id;
  dl_iterate_phdr(readBuildId, &id);
  std::string text;
  for (const std::string& part : {compiler(), std::string(PARITY_BUILD_TYPE), id.empty() ? "" : "build " + id})
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  return text;
}

} // namespace parity::base
