// Draws the printable ASCII letters of two fonts in a few sizes, and writes them as a C++ header of coverages: what
// study/plot/canvas.cpp lays over its pictures. Run by the build: make_font HEADER REGULAR.ttf BOLD.ttf
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ft2build.h>
#include FT_FREETYPE_H

namespace {

[[noreturn]] void fail(const std::string& file, const std::string& reason) {
  std::fputs((file + ": " + reason + "\n").c_str(), stderr);
  std::exit(1);
}

// Of this size in pixels: the table of glyphs, then the coverages that they point into, row by row.
std::string drawFont(FT_Library library, const std::string& file, const std::string& name, unsigned size) {
  FT_Face face{};
  if (FT_New_Face(library, file.c_str(), 0, &face) != 0) fail(file, "is no font");
  FT_Set_Pixel_Sizes(face, 0, size);
  std::string glyphs;
  std::vector<unsigned> coverage;
  for (unsigned long c = 32; c < 127; ++c) {
    if (FT_Load_Char(face, c, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) fail(file, "lacks a letter");
    const FT_GlyphSlot slot = face->glyph;
    const FT_Bitmap& bitmap = slot->bitmap;
    glyphs += fmt::format("  {{{}, {}, {}, {}, {}, {}}},\n", coverage.size(), bitmap.width, bitmap.rows,
                          slot->bitmap_left, slot->bitmap_top, static_cast<double>(slot->linearHoriAdvance) / 65536);
    for (unsigned y = 0; y < bitmap.rows; ++y)
      for (unsigned x = 0; x < bitmap.width; ++x)
        coverage.push_back(bitmap.buffer[static_cast<std::size_t>(y) * static_cast<std::size_t>(bitmap.pitch) + x]);
  }
  FT_Done_Face(face);
  return fmt::format("inline constexpr std::uint8_t k{0}Coverage[] = {{{1}}};\ninline constexpr FontGlyph "
                     "k{0}Glyphs[95] = {{\n{2}}};\n",
                     name, fmt::join(coverage, ","), glyphs);
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 4) fail("make_font", "takes HEADER REGULAR.ttf BOLD.ttf");
  FT_Library library{};
  if (FT_Init_FreeType(&library) != 0) fail("FreeType", "does not start");
  std::ofstream out(argv[1]);
  out << "// Made by make_font.\n#pragma once\n\n#include <cstdint>\n\nnamespace parity::plot {\n\n"
         "// Where its coverages begin, their columns and rows, where they stand beside the pen and above the line, "
         "and how far\n"
         "// the pen goes; pixels.\n"
         "struct FontGlyph {\n  std::uint32_t first;\n  int width, rows, left, top;\n  double advance;\n};\n\n";
  out << drawFont(library, argv[2], "Small", 15) << drawFont(library, argv[2], "Body", 18)
      << drawFont(library, argv[3], "Bold", 18) << drawFont(library, argv[3], "Title", 28);
  out << "\n} // namespace parity::plot\n";
  FT_Done_FreeType(library);
  if (!out.flush()) fail(argv[1], "could not be written");
}
