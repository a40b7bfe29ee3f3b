// The single-source shading maths (shading/*.glsl) in C++, once per precision: parity::shading::f64, f32 and f16.
//
// Names and meaning are those of the .glsl files, e.g. f64::D_GGX(double alpha, double NoH); types are f64::real,
// real2, real3, real4, and real32 (double in f64, float in the others). f32 and f16 round as the device does where a
// formula is made of + - * / and sqrt alone; that needs -ffp-contract=off and no wider instruction set
// (cmake/ParityFlags.cmake).
#pragma once

#include "shading/half.h"
#include "shading/math.h"
#include "shading/vec.h"

#define FN inline
#define CONSTANT inline constexpr
#define OUT(T) T&
#define INOUT(T) T&
#define PRECISE
#define R(x) real(x)
#define R32(x) real32(x)

namespace parity::shading::f64 {
using real = double;
using real32 = double;
using real32x3 = Vec3<real32>;
using real2 = Vec2<real>;
using real3 = Vec3<real>;
using real4 = Vec4<real>;
inline constexpr real kSmallest = kSmallestNormal<real>;
inline constexpr real kLargest = kLargestFinite<real>;
#include "shading/functions.inc"
} // namespace parity::shading::f64

namespace parity::shading::f32 {
using real = float;
using real32 = float;
using real32x3 = Vec3<real32>;
using real2 = Vec2<real>;
using real3 = Vec3<real>;
using real4 = Vec4<real>;
inline constexpr real kSmallest = kSmallestNormal<real>;
inline constexpr real kLargest = kLargestFinite<real>;
#include "shading/functions.inc"
} // namespace parity::shading::f32

namespace parity::shading::f16 {
using real = Half;
using real32 = float;
using real32x3 = Vec3<real32>;
using real2 = Vec2<real>;
using real3 = Vec3<real>;
using real4 = Vec4<real>;
inline constexpr real kSmallest = kSmallestNormal<real>;
inline constexpr real kLargest = kLargestFinite<real>;
#include "shading/functions.inc"
} // namespace parity::shading::f16

#undef FN
#undef CONSTANT
#undef OUT
#undef INOUT
#undef PRECISE
#undef R
#undef R32
