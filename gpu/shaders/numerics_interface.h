// What the shaders and the program both know of the numerics' rows.
#ifndef PARITY_NUMERICS_INTERFACE_H
#define PARITY_NUMERICS_INTERFACE_H

#ifdef __cplusplus
#include <cstdint>
namespace parity::gpu {
inline constexpr std::uint32_t kNumericsRows = 1024, kNumericsWords = 16;
} // namespace parity::gpu
#else
const uint kNumericsRows = 1024, kNumericsWords = 16;
#endif

#endif
