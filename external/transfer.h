// How engines make the colours of a picture out of linear light: tone curves and transfer functions, and back.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace parity::external {

using Rgb = std::array<double, 3>; // linear Rec.709, or a picture's values from 0 to 1

// Sources: srgb IEC 61966-2-1; aces-three, agx and pbr-neutral are three.js r150 and later
// (tonemapping_pars_fragment.glsl.js: ACESFilmicToneMapping after Stephen Hill, AgXToneMapping after Troy Sobotka's AgX
// and Benjamin Wrensch's fit, NeutralToneMapping as Khronos' PBR Neutral), each followed by sRGB; reinhard is
// c / (1 + c), followed by sRGB.
enum class Transfer { srgb, linear, gamma22, acesThree, agx, neutral, reinhard };
inline constexpr std::array<const char*, 7> kTransferNames = {"srgb", "linear",      "gamma2.2", "aces-three",
                                                              "agx",  "pbr-neutral", "reinhard"};

Rgb encode(Transfer transfer, const Rgb& linear); // clipped to [0, 1], except linear

// The light of a picture's value. Values at which the curve is flat (0 and 1, where it clips) have the light nearest to
// black that gives them.
Rgb decode(Transfer transfer, const Rgb& value);

const char* nameOf(Transfer transfer);
// By its name; nothing where there is none: see kTransferNames.
std::optional<Transfer> findTransfer(std::string_view name);

} // namespace parity::external
