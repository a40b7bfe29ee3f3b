// GLSL's built-in functions that the shading maths uses, for double, float and Half.
#pragma once

#include <cmath>

#include "shading/half.h"

namespace parity::shading {

// min and max as GLSL defines them (GLSL 4.60, 8.3): min is y < x ? y : x, max is x < y ? y : x; a NaN in x stays.
template <typename T> constexpr T min(T x, T y) { return y < x ? y : x; }
template <typename T> constexpr T max(T x, T y) { return x < y ? y : x; }

inline double abs(double x) { return std::fabs(x); }
inline float abs(float x) { return std::fabs(x); }
inline Half abs(Half x) { return Half(std::fabs(float(x))); }

inline double sqrt(double x) { return std::sqrt(x); }
inline float sqrt(float x) { return std::sqrt(x); }
inline Half sqrt(Half x) { return Half(std::sqrt(float(x))); }

inline double ceil(double x) { return std::ceil(x); }
inline float ceil(float x) { return std::ceil(x); }

inline double floor(double x) { return std::floor(x); }
inline float floor(float x) { return std::floor(x); }
inline Half floor(Half x) { return Half(std::floor(float(x))); }

inline double cos(double x) { return std::cos(x); }
inline float cos(float x) { return std::cos(x); }
inline Half cos(Half x) { return Half(std::cos(float(x))); }

inline double exp2(double x) { return std::exp2(x); }
inline float exp2(float x) { return std::exp2(x); }
inline Half exp2(Half x) { return Half(std::exp2(float(x))); }

inline double log2(double x) { return std::log2(x); }
inline float log2(float x) { return std::log2(x); }
inline Half log2(Half x) { return Half(std::log2(float(x))); }

inline double pow(double x, double y) { return std::pow(x, y); }
inline float pow(float x, float y) { return std::pow(x, y); }
inline Half pow(Half x, Half y) { return Half(std::pow(float(x), float(y))); }

} // namespace parity::shading
