// What C code that wasm2c made of a WebAssembly module calls (wasm-rt.h): memory, tables, types, traps. In place of
// wabt's own runtime, which catches SIGSEGV and has one place to jump to for the whole process.
#pragma once

#include <cstdint>
#include <exception>

namespace parity::base {

// A module that does what it may not: a read out of bounds, more memory than its limit, an abort. It unwinds the C
// code, which is compiled with -fexceptions.
struct WasmTrap : std::exception {
  const char* reason;
  explicit WasmTrap(const char* words) : reason(words) {}
  const char* what() const noexcept override { return reason; }
};

// The most pages of 64 KiB that a memory of this thread may have, until it is set again.
void setWasmPages(std::uint32_t pages);

} // namespace parity::base
