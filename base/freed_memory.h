// Memory that was freed, and that the allocator keeps for what comes next.
#pragma once

namespace parity::base {

// Gives it back to the system: what a process holds is then what it uses. Programs keep it otherwise (allocator.cpp).
void returnFreedMemory();

} // namespace parity::base
