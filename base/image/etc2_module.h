// The border between the program and the module that holds the encoder of ETC2.
#pragma once

#include <cstdint>

namespace parity::base {

// Blocks of RGBA8_ETC2_EAC, 16 bytes each, row by row, of an image of four channels in 0..1 whose sides are multiples
// of four. effort: 0 to 100; perceptual: errors weighted by Rec.709. False where the codec gave anything else.
using EncodeEtc2 = bool (*)(const float* rgba, std::uint32_t width, std::uint32_t height, int effort, bool perceptual,
                            std::uint8_t* blocks);
// The module exports it with C linkage.
inline constexpr const char* kEncodeEtc2 = "parityEncodeEtc2";

} // namespace parity::base
