// The number type of the single-source shading maths, and the few helpers that every formula needs.
//
// Every shading/*.glsl is compiled by glslang and, three times (f64, f32, f16), by g++ through shading/shading.h. The
// subset that both take:
//   real, real2, real3, real4   the working precision: float, or float16_t where PARITY_FP16 is defined
//   real32, real32x3            at least fp32: what the sources declare `float` inside half code
//   R(0.5), R32(0.5)            every literal; no bare ones
//   FN, CONSTANT                before functions and before constants
//   OUT(T), INOUT(T)            parameters that are written
//   PRECISE                     before locals whose operations must round one by one (no fast-math, no fusing)
// Conversions are written out: real(x), real32(x); only a call may widen real to real32. Member access .x .y .z .w,
// no swizzles; textures never appear: what was fetched is an argument.
#ifndef PARITY_SHADING_REAL
#define PARITY_SHADING_REAL

#ifndef __cplusplus
#define FN
#define CONSTANT const
#define OUT(T) out T
#define INOUT(T) inout T
#define PRECISE precise
#define real32 float
#define real32x3 vec3
#define R32(x) float(x)
#ifdef PARITY_FP16
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require
#define real float16_t
#define real2 f16vec2
#define real3 f16vec3
#define real4 f16vec4
// glslang truncates when it folds a constant to fp16, where every other conversion rounds to nearest. So the literal is
// first rounded to the 11 bits of fp16 by Veltkamp's splitting with 2^42 + 1 (glslang folds constants in double): then
// truncation changes nothing. Holds for 2^-14 <= |x| <= 65504, for powers of two down to 2^-24, and for 0; a tie (a
// literal of exactly 12 bits) may go either way, so none is used.
#define R(x) float16_t((x) * 4398046511105.0 - ((x) * 4398046511105.0 - (x)))
const real kSmallest = R(6.103515625e-5);
const real kLargest = R(65504.0);
#else
#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
#define R(x) float(x)
const real kSmallest = R(1.17549435e-38);
const real kLargest = R(3.40282347e38);
#endif
#endif

// kSmallest: the smallest normal number of the precision (in C++ from numeric_limits, above in GLSL). Where flushing
// denormals turns a divisor into 0, max(divisor, kSmallest) keeps the quotient finite: 1/kSmallest is finite in all
// three precisions. kLargest: the largest finite number.
CONSTANT real kPi = R(3.14159265358979324);
CONSTANT real kInvPi = R(0.318309886183790672);

// min(max(x, 0), 1)
FN real saturate(real x) { return min(max(x, R(0.0)), R(1.0)); }
FN real3 saturate(real3 v) { return real3(saturate(v.x), saturate(v.y), saturate(v.z)); }

// x^2
FN real sqr(real x) {
  PRECISE real s = x * x;
  return s;
}

// a.x b.x + a.y b.y + a.z b.z, added from the left in every compiler (the built-in dot leaves the order open).
FN real dot3(real3 a, real3 b) {
  PRECISE real d = a.x * b.x + a.y * b.y + a.z * b.z;
  return d;
}

FN real32 dot32(real32x3 a, real32x3 b) {
  PRECISE real32 d = a.x * b.x + a.y * b.y + a.z * b.z;
  return d;
}
FN real32x3 widen(real3 v) { return real32x3(real32(v.x), real32(v.y), real32(v.z)); }

// The nearest number of the working precision; what is above the largest finite one becomes that: a sum of lights
// saturates in half and is never infinite. NaN stays NaN, so that it is seen; the comparison is written so that no
// fast-math makes a min of it.
FN real narrow(real32 x) {
  PRECISE real32 y = x > real32(kLargest) ? real32(kLargest) : x;
  return real(y);
}
FN real3 narrow(real32x3 v) { return real3(narrow(v.x), narrow(v.y), narrow(v.z)); }

// v / |v|; `fallback` where v is zero or has a NaN or infinite component. In at least fp32: normalize(half3) fails for
// lengths <= 4.8e-4 and >= 257 (docs/shading.md 4). Any length that fp32 holds works, as v is scaled by its largest
// component first.
// Comparisons are written so that NaN takes the fallback without negating one: fast-math may turn !(a >= b) into a < b.
FN real32x3 safeNormalize(real32x3 v, real32x3 fallback) {
  real32 m = max(max(abs(v.x), abs(v.y)), abs(v.z));
  if (m > R32(0.0) && m <= R32(3.40282347e38)) {
    PRECISE real32 x = v.x / m;
    PRECISE real32 y = v.y / m;
    PRECISE real32 z = v.z / m;
    PRECISE real32 d = x * x + y * y + z * z; // in [1, 3], or NaN
    if (d >= R32(1.0)) {
      PRECISE real32 l = sqrt(d);
      PRECISE real32x3 n = real32x3(x / l, y / l, z / l);
      return n;
    }
  }
  return fallback;
}

// Y = 0.2126 r + 0.7152 g + 0.0722 b of linear light (ITU-R BT.709-6, section 3.2). Any range.
FN real luminance(real3 rgb) {
  PRECISE real y = R(0.2126) * rgb.x + R(0.7152) * rgb.y + R(0.0722) * rgb.z;
  return y;
}

// Luminance, in the weights of Unreal Engine 4 (.3, .59, .11).
FN real luminanceUE4(real3 c) {
  PRECISE real y = R(0.3) * c.x + R(0.59) * c.y + R(0.11) * c.z;
  return y;
}

// Display to linear light, exact and piecewise (IEC 61966-2-1:1999, 5.2), s in [0, 1]:
//   s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055)^2.4
FN real srgbToLinear(real s) {
  if (s <= R(0.04045)) return s / R(12.92);
  return pow((s + R(0.055)) / R(1.055), R(2.4));
}
FN real3 srgbToLinear(real3 s) { return real3(srgbToLinear(s.x), srgbToLinear(s.y), srgbToLinear(s.z)); }

// Linear to display light, exact and piecewise (IEC 61966-2-1:1999, 5.2), l in [0, 1]:
//   l <= 0.0031308 ? 12.92 l : 1.055 l^(1/2.4) - 0.055
FN real linearToSrgb(real l) {
  if (l <= R(0.0031308)) return l * R(12.92);
  return R(1.055) * pow(l, R(0.416666666666666667)) - R(0.055);
}
FN real3 linearToSrgb(real3 l) { return real3(linearToSrgb(l.x), linearToSrgb(l.y), linearToSrgb(l.z)); }

#endif
