// Rectangles into pages, by the outline of what is placed.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "bake/light/horizon.h"

namespace parity::bake {

// The upper outline of the rectangles in a bin; each new one goes where its far side is lowest (J. Jylanki, "A Thousand
// Ways to Pack the Bin", 2010, 3: skyline, bottom-left). Cost of a placement: linear in the outline's steps.
class Skyline {
public:
  Skyline(int width, int height);

  // The corner of the rectangle placed; nothing where it does not fit. It is not turned.
  std::optional<glm::ivec2> place(int width, int height);
  int usedHeight() const { return m_usedHeight; }

private:
  struct Step {
    int x, y, width;
  };
  int m_width, m_height, m_usedHeight = 0;
  std::vector<Step> m_steps;
  glm::ivec2 m_refused{0}; // the last size that did not fit: no larger one will, as the outline only grows
};

// What is packed. Without a profile the whole of it is taken.
struct Rectangle {
  glm::ivec2 size{0};
  const Profile* profile = nullptr; // where there is one, others may reach into what it leaves free above it
};

struct Packing {
  int width = 0, height = 0; // of each page
  int pages = 0;
  std::vector<glm::ivec2> corners; // of each rectangle, on its page
  std::vector<int> page;
};

// All rectangles into one page that is about square and as small as this method gets it. At least one rectangle. Here
// and below profiles count unless they would cost too much time (packInto).
Packing packTight(const std::vector<Rectangle>& rectangles);

// All rectangles into one square page, its side a multiple of 4 and as small as this method gets it; nothing where it
// would be above maxSide (a multiple of 4).
std::optional<Packing> packPage(const std::vector<Rectangle>& rectangles, int maxSide);

// Into square pages, as few as this method needs, of one side: a multiple of 4, at most maxSide (a multiple of 4
// itself, and no rectangle is larger), as small as serves for that number of pages.
Packing packPages(const std::vector<Rectangle>& rectangles, int maxSide);

} // namespace parity::bake
