// The vectors of the shading maths in C++: their components, by name. The formulas are written by component.
#pragma once

namespace parity::shading {

template <typename T> struct Vec2 {
  T x{}, y{};
  constexpr Vec2() = default;
  constexpr Vec2(T x_, T y_) : x(x_), y(y_) {}
};

template <typename T> struct Vec3 {
  T x{}, y{}, z{};
  constexpr Vec3() = default;
  constexpr Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
};

template <typename T> struct Vec4 {
  T x{}, y{}, z{}, w{};
  constexpr Vec4() = default;
  constexpr Vec4(T x_, T y_, T z_, T w_) : x(x_), y(y_), z(z_), w(w_) {}
};

} // namespace parity::shading
