// Baked light: the two encodings of a lightmap, what is read from them at a shading normal, and the distance-field shadow.
//
// A texel has the irradiance E at the baked normal N0, and its luminance on the SH of order 1: l0 = int L Y0 dw, l1 = int L
// Y1 w dw with Y0 = .282095, Y1 = .488603. Irradiance over pi that these have at a normal n (Ramamoorthi and Hanrahan 2001):
//   S(n) = .282095 l0 + .325735 dot(l1, n)
#ifndef PARITY_SHADING_LIGHTMAP
#define PARITY_SHADING_LIGHTMAP

#include "shading/real.glsl"

// ---- Mobile: Unreal Engine 4's LQ lightmap (4.20 to 4.26), a texture of two halves (docs/shading.md 7a). ----

// 2^-8: log2 of the luminance is stored from there on.
CONSTANT real kLogBlackPoint = R(0.00390625);

// Of an object: LightMapScale[0], LightMapAdd[0] for the upper half, [1] for the lower one.
struct LightmapScales {
  real32x3 Scale0;
  real32x3 Add0;
  real32x3 Scale1;
  real32 Scale1W;
  real32x3 Add1;
  real32 Add1W;
};

// The lower half: dot(SH, (N.yzx, 1)) is S(N) / l0.
struct LightmapSh {
  real32 x;
  real32 y;
  real32 z;
  real32 w;
};

// texel scale + add, from 0 up: rounding may bring what was stored for black below it.
FN real lightmapLogChannel(real texel, real32 scale, real32 add) {
  PRECISE real32 LogC = real32(texel) * scale + add;
  return narrow(max(LogC, R32(0.0)));
}

// Directionality = max(0, dot(SH, (N.yzx, 1))), in floats as in the source. N: unit.
FN real32 lightmapDirectionality(LightmapSh SH, real32x3 N) {
  PRECISE real32 d = SH.x * N.y + SH.y * N.z + SH.z * N.x + SH.w;
  return max(d, R32(0.0));
}

// GetLightMapColorLQ (UE4's LightmapCommon.ush, from memory), with its types: (Color, Luma), both irradiance over pi.
//   LogRGB = Lightmap0 Scale0 + Add0;  LogL = Luminance(LogRGB);  L = 2^(16 LogL - 8) - 2^-8
//   SH = Lightmap1 Scale1 + Add1;  Luma = L Directionality;  Color = LogRGB (Luma / LogL)
// Texels in [0, 1], WorldNormal unit; LogL up to 1.5, where half ends and saturates. Unlike the source, black (LogL = 0)
// gives 0 instead of 0/0 (docs/shading.md 4), and what rounding brings below 0 is 0.
FN real4 GetLightMapColorLQ(real3 Lightmap0, real4 Lightmap1, LightmapScales scales, real32x3 WorldNormal) {
  real3 LogRGB = real3(lightmapLogChannel(Lightmap0.x, scales.Scale0.x, scales.Add0.x),
                       lightmapLogChannel(Lightmap0.y, scales.Scale0.y, scales.Add0.y),
                       lightmapLogChannel(Lightmap0.z, scales.Scale0.z, scales.Add0.z));
  real LogL = luminanceUE4(LogRGB);
  if (LogL > R(0.0)) {
    PRECISE real exponent = LogL * R(16.0) - R(8.0);
    PRECISE real aboveBlack = exp2(exponent) - kLogBlackPoint;
    real L = narrow(real32(max(aboveBlack, R(0.0))));
    LightmapSh SH;
    PRECISE real32 shX = real32(Lightmap1.x) * scales.Scale1.x + scales.Add1.x;
    PRECISE real32 shY = real32(Lightmap1.y) * scales.Scale1.y + scales.Add1.y;
    PRECISE real32 shZ = real32(Lightmap1.z) * scales.Scale1.z + scales.Add1.z;
    PRECISE real32 shW = real32(Lightmap1.w) * scales.Scale1W + scales.Add1W;
    SH.x = shX;
    SH.y = shY;
    SH.z = shZ;
    SH.w = shW;
    real Directionality = narrow(lightmapDirectionality(SH, WorldNormal));
    PRECISE real directed = L * Directionality;
    real Luma = narrow(real32(directed));
    PRECISE real quotient = Luma / LogL;
    real ratio = narrow(real32(quotient));
    PRECISE real3 Color = real3(LogRGB.x * ratio, LogRGB.y * ratio, LogRGB.z * ratio);
    real3 finite = narrow(widen(Color));
    return real4(finite.x, finite.y, finite.z, Luma);
  }
  return real4(R(0.0), R(0.0), R(0.0), R(0.0));
}

// The lower half of a texel: (.325735 l1.yzx / l0, .282095). l0 = 0: no direction.
FN LightmapSh encodeLightmapSh(real32 l0, real32x3 l1) {
  LightmapSh SH;
  SH.x = R32(0.0);
  SH.y = R32(0.0);
  SH.z = R32(0.0);
  SH.w = R32(0.282094791773878143);
  if (l0 > R32(0.0)) {
    PRECISE real32 x = R32(0.325735007935279943) * (l1.y / l0);
    PRECISE real32 y = R32(0.325735007935279943) * (l1.z / l0);
    PRECISE real32 z = R32(0.325735007935279943) * (l1.x / l0);
    SH.x = x;
    SH.y = y;
    SH.z = z;
  }
  return SH;
}

// What a colour is multiplied with before it is encoded, so that times its Directionality at the baked normal it is itself
// again: l0 / S(N0), as UE4's Lightmass had it ("force directional SH as applied to a flat normal map to be 1"). Light that
// comes from below the normal would ask for ever more: 64 at most; light from above N0 asks for 1/.282 = 3.545 at most.
FN real32 flatNormalScale(LightmapSh SH, real32x3 N0) {
  PRECISE real32 scale = R32(1.0) / max(lightmapDirectionality(SH, N0), R32(0.015625));
  return scale;
}

// The upper half of a texel, before scale and add: LogRGB = C LogL / L with
//   L = Luminance(C),  LogL = (log2(L + 2^-8) + 8) / 16 = log2(1 + 256 L) / 16
// in at least fp32. C: irradiance over pi times flatNormalScale; finite, up to 1e30; negative counts as 0. LogL is 1 at L
// near 256. Black gives 0.
FN real32x3 encodeLightmapLogRgb(real32x3 C) {
  real32x3 c = real32x3(max(C.x, R32(0.0)), max(C.y, R32(0.0)), max(C.z, R32(0.0)));
  PRECISE real32 L = R32(0.3) * c.x + R32(0.59) * c.y + R32(0.11) * c.z;
  if (L >= R32(1.17549435e-38)) {
    PRECISE real32 LogL = log2(R32(1.0) + R32(256.0) * L) * R32(0.0625);
    PRECISE real32 ratio = LogL / L;
    PRECISE real32x3 LogRGB = real32x3(c.x * ratio, c.y * ratio, c.z * ratio);
    return LogRGB;
  }
  return real32x3(R32(0.0), R32(0.0), R32(0.0));
}

// saturate(d T + .5 - .5 T)^2: what a distance-field shadow lets through (GetPrimaryPrecomputedShadowMask,
// docs/shading.md 7f). d: texel in [0, 1], 0.5 at the shadow's edge. T: the transition scale, > 0. The
// uniform T keeps its digits, as in the source.
FN real distanceFieldShadow(real DistanceField, real32 TransitionScale) {
  PRECISE real32 x = real32(DistanceField) * TransitionScale + (R32(0.5) - R32(0.5) * TransitionScale);
  real ShadowFactor = real(max(min(x, R32(1.0)), R32(0.0)));
  PRECISE real Shadow = ShadowFactor * ShadowFactor;
  return Shadow;
}

// ---- High end: RGB irradiance over pi at the baked normal, and where it comes from. ----

// The direction to be stored, r = (l1 / l0) / sqrt(3): |r| is 1 for light from one direction, and no light has more: clamped.
FN real32x3 encodeLightmapDirection(real32 l0, real32x3 l1) {
  if (l0 > R32(0.0)) {
    PRECISE real32 k = R32(0.577350269189625765) / l0;
    PRECISE real32x3 r = real32x3(l1.x * k, l1.y * k, l1.z * k);
    PRECISE real32 magnitude = sqrt(dot32(r, r));
    if (magnitude <= R32(1.0)) return r;
    return safeNormalize(l1, real32x3(R32(0.0), R32(0.0), R32(0.0)));
  }
  return real32x3(R32(0.0), R32(0.0), R32(0.0));
}

// Irradiance at n over that of the same light from everywhere (Geomerics; Hazel 2015, "Reconstructing Diffuse Lighting from
// Spherical Harmonic Data"):
//   q = (1 + dot(r/|r|, n)) / 2,  p = 1 + 2 |r|,  a = (1 - |r|) / (1 + |r|);  a + (1 - a)(p + 1) q^p
// r: |r| in [0, 1], what is above counts as 1; n: unit. In [0, 4]. 1 at r = 0.
FN real32 nonlinearIrradiance(real32x3 r, real32x3 n) {
  PRECISE real32 whole = sqrt(dot32(r, r));
  PRECISE real32 magnitude = min(whole, R32(1.0));
  PRECISE real32 q = R32(0.5) + R32(0.5) * (dot32(r, n) / max(whole, R32(1e-12)));
  PRECISE real32 p = R32(1.0) + R32(2.0) * magnitude;
  PRECISE real32 a = (R32(1.0) - magnitude) / (R32(1.0) + magnitude);
  PRECISE real32 peak = pow(max(min(q, R32(1.0)), R32(0.0)), p);
  PRECISE real32 relative = a + (R32(1.0) - a) * (p + R32(1.0)) * peak;
  return relative;
}

// What irradiance at the baked normal is multiplied with at the shading normal n: R(n) / R(N0), both unit. R(N0) is 1/2 at
// least where the light comes from above N0; below 1/16 it counts as that, so that the ratio is 64 at most. Never negative.
FN real32 directionalLightmapRatio(real32x3 r, real32x3 n, real32x3 N0) {
  PRECISE real32 ratio = nonlinearIrradiance(r, n) / max(nonlinearIrradiance(r, N0), R32(0.0625));
  return ratio;
}

#endif
