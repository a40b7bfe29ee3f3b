// Which mip of the shared prefiltered cube holds which roughness; lighting/, highend/ and mobile/ all use this.
#ifndef PARITY_SHADING_MIPS
#define PARITY_SHADING_MIPS

#include "shading/real.glsl"

// The mip of roughness 1: 8x8 faces of a cube whose base faces are 256x256.
CONSTANT int kPrefilterRoughestMip = 5;

// 5 + 1.2 log2(max(R, 0.001)): below 0 for what is smoother than mip 0.
FN real unclampedMip(real Roughness) {
  PRECISE real mip = R(5.0) + R(1.2) * log2(max(Roughness, R(0.001)));
  return mip;
}

// mip = max(0, 5 + 1.2 log2(max(R, 0.001)))
// The mapping of Unreal Engine 4's reflection captures (ReflectionEnvironmentShared.ush; SHADING 7) for 256x256 faces.
// Roughness in [0, 1]; at and below roughness 2^(-5/1.2) = 0.0557 it is mip 0. 0.001 keeps log2 off 0.
FN real mipFromRoughness(real Roughness) { return max(unclampedMip(Roughness), R(0.0)); }

// The inverse, 2^((mip - 5) / 1.2), for mip in [0, 5]: the roughness that a mip is filtered with.
FN real roughnessFromMip(real mip) {
  PRECISE real x = (mip - R(5.0)) / R(1.2);
  return exp2(x);
}

// Between two mips alpha grows threefold, and a blend of two such lobes is not the lobe between: read trilinearly, a
// picture of roughness 0.25 is 4 to 46 % off (docs/environments.md). So the cube is an array, whose layer j of mip m,
// 1 <= m < kPrefilterRoughestMip, is filtered with roughnessFromMip(m + j / kPrefilterLayers). Layer 0 alone, read
// trilinearly by mipFromRoughness, is what Unreal Engine 4 has.
CONSTANT int kPrefilterLayers = 4;

// Two levels, layer l % kPrefilterLayers of mip l / kPrefilterLayers each, and the share of the second.
struct PrefilterBlend {
  int lower;
  int upper;
  real upperShare;
};

// The levels next to a mip in [0, kPrefilterRoughestMip] (mipFromRoughness), linear between them. Below mip 1, where
// lobes are narrower than the texels of 256x256 faces, there is layer 0 alone.
FN PrefilterBlend prefilterBlend(real mip) {
  PrefilterBlend blend;
  blend.lower = 0;
  blend.upper = kPrefilterLayers;
  blend.upperShare = mip;
  if (mip >= R(1.0)) {
    PRECISE real level = mip * real(real32(kPrefilterLayers));
    blend.lower = int(real32(level));
    if (blend.lower >= kPrefilterLayers * kPrefilterRoughestMip) blend.lower = kPrefilterLayers * kPrefilterRoughestMip - 1;
    blend.upper = blend.lower + 1;
    PRECISE real share = level - real(real32(blend.lower));
    blend.upperShare = min(share, R(1.0));
  }
  return blend;
}

#endif
