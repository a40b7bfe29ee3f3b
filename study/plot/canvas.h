// A picture to draw on: boxes, lines, letters. Colours are 8-bit sRGB; places are pixels, (0, 0) the upper left corner.
#pragma once

#include <array>
#include <string>

#include "base/image/image.h"

namespace parity::plot {

using Rgb = std::array<std::uint8_t, 3>;

enum class Font { small, body, bold, title }; // DejaVu Sans, 15, 18, 18 and 28 pixels high
enum class Align { left, middle, right };

class Canvas {
public:
  Canvas(int width, int height, const Rgb& background);

  // Whole pixels; what lies outside of the picture is left out, here as below.
  void fill(int x, int y, int width, int height, const Rgb& color);
  // With round ends and smooth edges. width: pixels.
  void line(double x0, double y0, double x1, double y1, double width, const Rgb& color);
  void frame(double x, double y, double width, double height, const Rgb& color);
  void dot(double x, double y, double radius, const Rgb& color) { line(x, y, x, y, 2 * radius, color); }

  // Printable ASCII, other bytes as '?'. y: of the line that the letters stand on.
  void text(double x, double y, const std::string& words, Font font, const Rgb& color, Align align = Align::left);
  // The same, reading upwards: x is the line that the letters stand on.
  void textUpwards(double x, double y, const std::string& words, Font font, const Rgb& color, Align align);
  static double widthOf(const std::string& words, Font font);

  const base::Image8& image() const { return m_image; } // 3 channels

private:
  void blend(int x, int y, const Rgb& color, double coverage);
  template <typename Place> void draw(const std::string& words, Font font, const Rgb& color, const Place& place);

  base::Image8 m_image;
};

} // namespace parity::plot
