#include "base/image/basis/wasm_runtime.h"

#include <algorithm>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <mutex>
#include <vector>

#include <wasm-rt.h>

namespace {

using parity::base::WasmTrap;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kPageBytes = 65536;

thread_local std::uint32_t pageLimit = 0;

struct FunctionType {
  std::uint32_t parameters;
  std::vector<int> values;
  bool operator==(const FunctionType&) const = default;
};

} // namespace

namespace parity::base {

void setWasmPages(std::uint32_t pages) { pageLimit = pages; }

} // namespace parity::base

extern "C" {

void wasm_rt_init() {}
bool wasm_rt_is_initialized() { return true; }
void wasm_rt_free() {}

void wasm_rt_trap(wasm_rt_trap_t code) {
  switch (code) {
  case WASM_RT_TRAP_OOB:
    throw WasmTrap("an access out of bounds");
  case WASM_RT_TRAP_UNREACHABLE:
    throw WasmTrap("a state that must not be");
  case WASM_RT_TRAP_EXHAUSTION:
    throw WasmTrap("out of memory");
  default:
    throw WasmTrap("an operation without a result");
  }
}

// Types are numbered from 1 over all modules.
std::uint32_t wasm_rt_register_func_type(std::uint32_t parameters, std::uint32_t results, ...) {
  static std::mutex mutex;
  static std::vector<FunctionType> types;
  FunctionType type{parameters, {}};
  va_list values;
  va_start(values, results);
  for (std::uint32_t i = 0; i < parameters + results; ++i) type.values.push_back(va_arg(values, int));
  va_end(values);
  const std::lock_guard lock(mutex);
  const auto found = std::find(types.begin(), types.end(), type);
  const auto index = static_cast<std::uint32_t>(found - types.begin());
  if (found == types.end()) types.push_back(std::move(type));
  return index + 1;
}

void wasm_rt_allocate_memory(wasm_rt_memory_t* memory, std::uint32_t pages, std::uint32_t maxPages) {
  memory->pages = 0;
  memory->size = 0;
  memory->data = nullptr;
  memory->max_pages = std::min(maxPages, pageLimit);
  if (wasm_rt_grow_memory(memory, pages) == kNone) wasm_rt_trap(WASM_RT_TRAP_EXHAUSTION);
}

std::uint32_t wasm_rt_grow_memory(wasm_rt_memory_t* memory, std::uint32_t by) {
  const std::uint32_t before = memory->pages;
  if (by > memory->max_pages - before) return kNone;
  const std::size_t bytes = (std::size_t{before} + by) * kPageBytes;
  if (bytes > std::numeric_limits<std::uint32_t>::max()) return kNone; // memory->size counts bytes
  auto* data = static_cast<std::uint8_t*>(std::realloc(memory->data, std::max<std::size_t>(bytes, 1)));
  if (!data) return kNone;
  std::memset(data + std::size_t{before} * kPageBytes, 0, std::size_t{by} * kPageBytes);
  memory->data = data;
  memory->pages = before + by;
  memory->size = static_cast<std::uint32_t>(bytes);
  return before;
}

void wasm_rt_free_memory(wasm_rt_memory_t* memory) {
  std::free(memory->data);
  *memory = {};
}

void wasm_rt_allocate_funcref_table(wasm_rt_funcref_table_t* table, std::uint32_t size, std::uint32_t maxSize) {
  table->size = size;
  table->max_size = maxSize;
  table->data = static_cast<wasm_rt_funcref_t*>(std::calloc(std::max(size, 1u), sizeof(wasm_rt_funcref_t)));
  if (!table->data) wasm_rt_trap(WASM_RT_TRAP_EXHAUSTION);
}

void wasm_rt_free_funcref_table(wasm_rt_funcref_table_t* table) {
  std::free(table->data);
  *table = {};
}

} // extern "C"
