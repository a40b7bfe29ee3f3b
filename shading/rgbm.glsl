// RGBM, the 8-bit encoding of reflection captures that Unreal Engine 4's mobile renderer reads (docs/shading.md 7c):
//   radiance = (rgb a 16)^2, up to 256
#ifndef PARITY_SHADING_RGBM
#define PARITY_SHADING_RGBM

#include "shading/real.glsl"

// The largest radiance that RGBM holds: 16^2.
CONSTANT real32 kRgbmLargest = R32(256.0);

// Four numbers in [0, 1] to be stored with 8 bits each: the square root of the radiance over 16 is split into a common
// factor a, rounded up to its 8 bits, and rgb. Radiance: finite; saturates at 256; negative is 0. Black keeps a = 1/255,
// so that nothing is divided by 0. In at least fp32: it is done once, when a capture is made.
struct Rgbm {
  real32 r;
  real32 g;
  real32 b;
  real32 a;
};
FN Rgbm encodeRgbm(real32x3 radiance) {
  PRECISE real32 r = sqrt(min(max(radiance.x, R32(0.0)), kRgbmLargest)) / R32(16.0);
  PRECISE real32 g = sqrt(min(max(radiance.y, R32(0.0)), kRgbmLargest)) / R32(16.0);
  PRECISE real32 b = sqrt(min(max(radiance.z, R32(0.0)), kRgbmLargest)) / R32(16.0);
  PRECISE real32 codes = ceil(max(max(r, g), b) * R32(255.0));
  PRECISE real32 a = max(codes, R32(1.0)) / R32(255.0);
  Rgbm m;
  PRECISE real32 ra = r / a;
  PRECISE real32 ga = g / a;
  PRECISE real32 ba = b / a;
  m.r = min(ra, R32(1.0));
  m.g = min(ga, R32(1.0));
  m.b = min(ba, R32(1.0));
  m.a = a;
  return m;
}

// (rgb a 16)^2, for what a texture unit returns, in [0, 1]: between texels of different a the interpolated numbers are
// not those of the interpolated radiance, which is what mobile devices show. At most 256.
FN real3 decodeRgbm(real3 rgb, real a) {
  PRECISE real scale = a * R(16.0);
  PRECISE real3 root = real3(rgb.x * scale, rgb.y * scale, rgb.z * scale);
  PRECISE real3 radiance = real3(root.x * root.x, root.y * root.y, root.z * root.z);
  return radiance;
}

#endif
