// A value for each entry of a surface: radiance and opacity, or another value of a shader.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace parity::gpu {

// A view of the values of a plane, or of a list, which must outlive it.
class PlaneView {
public:
  PlaneView() = default;
  explicit PlaneView(std::span<const glm::vec4> values) : m_first(values.data()), m_step(1) {}

  const glm::vec4& operator[](std::size_t entry) const { return m_first[entry * m_step]; }

private:
  friend class ShadedPlane;
  PlaneView(const glm::vec4* first, std::size_t step) : m_first(first), m_step(step) {}

  const glm::vec4* m_first = nullptr;
  std::size_t m_step = 0; // 0: all entries have the first value
};

// Values in the host's memory, values that a device wrote and that are read in place, or zeros, which take no memory. A
// plane that is read in place must not outlive its device. Immutable; copies share the values, and a plane that was
// moved from is empty.
class ShadedPlane {
public:
  ShadedPlane() = default;
  ShadedPlane(std::vector<glm::vec4> values) {
    auto kept = std::make_shared<const std::vector<glm::vec4>>(std::move(values));
    m_size = kept->size();
    m_view = PlaneView(*kept);
    m_owner = std::move(kept);
  }
  ShadedPlane(std::initializer_list<glm::vec4> values) : ShadedPlane(std::vector<glm::vec4>(values)) {}
  // owner: keeps the values where they are.
  ShadedPlane(std::shared_ptr<const void> owner, std::span<const glm::vec4> values)
      : m_owner(std::move(owner)), m_view(values), m_size(values.size()) {}
  static ShadedPlane zeros(std::size_t size) {
    static constexpr glm::vec4 kZero(0.f);
    ShadedPlane plane;
    plane.m_view = {&kZero, 0};
    plane.m_size = size;
    return plane;
  }
  ShadedPlane(const ShadedPlane&) = default;
  ShadedPlane(ShadedPlane&& other) noexcept { swap(other); }
  ShadedPlane& operator=(ShadedPlane other) noexcept { return swap(other), *this; }
  ~ShadedPlane() = default;

  std::size_t size() const { return m_size; }
  bool empty() const { return m_size == 0; }
  const glm::vec4& operator[](std::size_t entry) const { return m_view[entry]; }
  operator PlaneView() const& { return m_view; }
  operator PlaneView() && = delete; // the values would go with the plane
  // Whether all values are 0, the fourth one aside.
  bool isBlack() const {
    const std::size_t different = m_view.m_step == 0 ? 0 : m_size; // else they are zeros()
    for (std::size_t i = 0; i < different; ++i)
      if (const glm::vec4& v = m_view[i]; !(v.x == 0 && v.y == 0 && v.z == 0)) return false;
    return true;
  }

private:
  void swap(ShadedPlane& other) noexcept {
    std::swap(m_owner, other.m_owner);
    std::swap(m_view, other.m_view);
    std::swap(m_size, other.m_size);
  }

  std::shared_ptr<const void> m_owner;
  PlaneView m_view;
  std::size_t m_size = 0;
};

} // namespace parity::gpu
