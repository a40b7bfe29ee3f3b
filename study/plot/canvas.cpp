#include "study/plot/canvas.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "plot_font/font_data.h"

namespace parity::plot {

namespace {

struct FontData {
  std::span<const FontGlyph> glyphs;
  const std::uint8_t* coverage;
};

FontData dataOf(Font font) {
  switch (font) {
  case Font::small:
    return {kSmallGlyphs, kSmallCoverage};
  case Font::body:
    return {kBodyGlyphs, kBodyCoverage};
  case Font::bold:
    return {kBoldGlyphs, kBoldCoverage};
  case Font::title:
    break;
  }
  return {kTitleGlyphs, kTitleCoverage};
}

const FontGlyph& glyphOf(const FontData& font, char c) {
  return font.glyphs[c >= 32 && c < 127 ? static_cast<std::size_t>(c - 32) : std::size_t{'?' - 32}];
}

double startOf(double x, double width, Align align) {
  return align == Align::left ? x : align == Align::middle ? x - 0.5 * width : x - width;
}

} // namespace

Canvas::Canvas(int width, int height, const Rgb& background) : m_image(width, height, 3) {
  fill(0, 0, width, height, background);
}

void Canvas::blend(int x, int y, const Rgb& color, double coverage) {
  if (x < 0 || y < 0 || x >= m_image.width || y >= m_image.height || coverage <= 0) return;
  std::uint8_t* pixel = m_image.at(x, y);
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] = static_cast<std::uint8_t>(std::lround(pixel[c] + (color[c] - pixel[c]) * std::min(coverage, 1.0)));
}

void Canvas::fill(int x, int y, int width, int height, const Rgb& color) {
  for (int j = std::max(y, 0); j < std::min(y + height, m_image.height); ++j)
    for (int i = std::max(x, 0); i < std::min(x + width, m_image.width); ++i)
      std::copy(color.begin(), color.end(), m_image.at(i, j));
}

void Canvas::line(double x0, double y0, double x1, double y1, double width, const Rgb& color) {
  const double half = 0.5 * width, dx = x1 - x0, dy = y1 - y0, squared = dx * dx + dy * dy, reach = half + 1;
  for (int y = static_cast<int>(std::floor(std::min(y0, y1) - reach));
       y <= static_cast<int>(std::ceil(std::max(y0, y1) + reach)); ++y)
    for (int x = static_cast<int>(std::floor(std::min(x0, x1) - reach));
         x <= static_cast<int>(std::ceil(std::max(x0, x1) + reach)); ++x) {
      const double px = x + 0.5 - x0, py = y + 0.5 - y0;
      const double t = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0;
      const double distance = std::hypot(px - t * dx, py - t * dy);
      blend(x, y, color, std::min(half + 0.5 - distance, width));
    }
}

void Canvas::frame(double x, double y, double width, double height, const Rgb& color) {
  line(x, y, x + width, y, 1, color);
  line(x, y + height, x + width, y + height, 1, color);
  line(x, y, x, y + height, 1, color);
  line(x + width, y, x + width, y + height, 1, color);
}

// place: (pixels along the line, pixels above it) -> a pixel of the picture.
template <typename Place> void Canvas::draw(const std::string& words, Font font, const Rgb& color, const Place& place) {
  const FontData data = dataOf(font);
  double pen = 0;
  for (const char c : words) {
    const FontGlyph& glyph = glyphOf(data, c);
    const int start = static_cast<int>(std::lround(pen)) + glyph.left;
    for (int j = 0; j < glyph.rows; ++j)
      for (int i = 0; i < glyph.width; ++i) {
        const auto [x, y] = place(start + i, glyph.top - j);
        blend(x, y, color, data.coverage[glyph.first + static_cast<std::size_t>(j * glyph.width + i)] / 255.0);
      }
    pen += glyph.advance;
  }
}

void Canvas::text(double x, double y, const std::string& words, Font font, const Rgb& color, Align align) {
  const auto left = static_cast<int>(std::lround(startOf(x, widthOf(words, font), align)));
  const auto base = static_cast<int>(std::lround(y));
  draw(words, font, color, [&](int along, int above) { return std::pair(left + along, base - above); });
}

void Canvas::textUpwards(double x, double y, const std::string& words, Font font, const Rgb& color, Align align) {
  const auto bottom = static_cast<int>(std::lround(-startOf(-y, widthOf(words, font), align)));
  const auto base = static_cast<int>(std::lround(x));
  draw(words, font, color, [&](int along, int above) { return std::pair(base - above, bottom - along); });
}

double Canvas::widthOf(const std::string& words, Font font) {
  const FontData data = dataOf(font);
  double width = 0;
  for (const char c : words) width += glyphOf(data, c).advance;
  return width;
}

} // namespace parity::plot
