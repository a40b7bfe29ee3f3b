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
// The mapping of Unreal Engine 4's reflection captures (ReflectionEnvironmentShared.ush; docs/shading.md 7c) for 256x256
// faces. Roughness in [0, 1]; at and below roughness 2^(-5/1.2) = 0.0557 it is mip 0. 0.001 keeps log2 off 0.
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

// The two levels next to a place among them, in [0, kPrefilterLayers kPrefilterRoughestMip], linear between them.
FN PrefilterBlend blendOfLevel(real level) {
  PrefilterBlend blend;
  blend.lower = int(real32(level));
  if (blend.lower >= kPrefilterLayers * kPrefilterRoughestMip) blend.lower = kPrefilterLayers * kPrefilterRoughestMip - 1;
  blend.upper = blend.lower + 1;
  PRECISE real share = level - real(real32(blend.lower));
  blend.upperShare = min(share, R(1.0));
  return blend;
}

// The levels next to a mip in [0, kPrefilterRoughestMip] (mipFromRoughness), linear between them, of a cube whose first
// mip has layer 0 alone, as captures have it.
FN PrefilterBlend prefilterBlend(real mip) {
  PRECISE real level = mip * real(real32(kPrefilterLayers));
  PrefilterBlend blend = blendOfLevel(level);
  if (mip < R(1.0)) {
    blend.lower = 0;
    blend.upper = kPrefilterLayers;
    blend.upperShare = mip;
  }
  return blend;
}

// Of a cube with fine levels, whose first mip has all layers: the levels next to a mip (unclampedMip), linear between
// them. What is smoother than level 1, kSharpestPrefilteredMip, is held by no level but read from the panorama.
CONSTANT real32 kSharpestPrefilteredMip = real32(0.25);

FN PrefilterBlend finePrefilterBlend(real mip) {
  PRECISE real level = max(mip, real(kSharpestPrefilteredMip)) * real(real32(kPrefilterLayers));
  return blendOfLevel(level);
}

// A lobe smoother than level 1, of alpha a < a1, is (a / a1)^2 times that level, which has its tail (D falls off as
// a^2 / theta^4), and a narrow core for the rest. The radiance that the core weighs lies within, along each axis,
//   variance = 2 a^2 ln(a1^2 / a^2) / (1 - a^2 / a1^2) radians^2
// (small angles: half vectors turn by half as much). It is taken for a square.
struct SharpLobe {
  real tail;  // (a / a1)^2, [0, 1]
  real width; // of the core, radians
};

// mip: unclampedMip, below kSharpestPrefilteredMip.
FN SharpLobe sharpLobe(real mip) {
  SharpLobe lobe;
  PRECISE real logTail = min((mip - real(kSharpestPrefilteredMip)) / R(0.3), R(-0.001)); // log2 of tail: a = R^2
  PRECISE real alpha = sqr(roughnessFromMip(mip));
  lobe.tail = exp2(logTail);
  PRECISE real variance = R(-1.3862944) * logTail / (R(1.0) - lobe.tail); // 2 ln(2), over alpha^2
  lobe.width = R(1.5) * alpha * sqrt(variance);
  return lobe;
}

#endif
