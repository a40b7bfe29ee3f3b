#include "base/freed_memory.h"

#include <cstddef>

#include <malloc.h>

// jemalloc's, in programs that it is linked to; null in others.
extern "C" [[gnu::weak]] int mallctl(const char* name, void* old, std::size_t* oldSize, void* fresh,
                                     std::size_t freshSize);

namespace parity::base {

void returnFreedMemory() {
  if (mallctl)
    mallctl("arena.4096.purge", nullptr, nullptr, nullptr, 0); // MALLCTL_ARENAS_ALL
  else
    malloc_trim(0);
}

} // namespace parity::base
