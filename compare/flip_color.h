// FLIP's colour maths on rows of pixels: sRGB to YCxCz, and how far two filtered colours are apart.
#pragma once

#include "base/image.h"

namespace parity::compare {

// HyAB^0.7 between pure green and pure blue, Hunt-adjusted (Andersson 2020, section 4.1.4): the largest in sRGB.
inline constexpr float kMaxColorDifference = 41.2760963f;

// Whether every value is a whole number of 255ths, as images of 8 bit are.
bool isEightBit(const base::Image& image);

// Turns rows of display-encoded RGB into YCxCz (Y 0..100; Cx, Cz 0 for grey).
class RowDecoder {
public:
  // eightBit: all values are whole 255ths (isEightBit): the transfer function is then read from a table.
  explicit RowDecoder(bool eightBit);

  // rgb: 3*count interleaved display-encoded values, clamped to [0,1].
  void decode(const float* rgb, int count, float* y, float* cx, float* cz) const;

private:
  bool m_eightBit;
  float m_table[256]; // linear light of i/255
};

// Three planes of one row, YCxCz.
struct ColorRow {
  const float *y, *cx, *cz;
};

// out[i] = the colour difference of the filtered rows, redistributed to [0,1] (section 4.1.4): 0.4 of the largest
// HyAB^0.7 goes to 0.95. Exactly 0 for equal colours.
void colorDifferenceRow(const ColorRow& reference, const ColorRow& test, int count, float* out);

// Magnitudes of the edge and the point filter over one row, in units of Y.
struct FeatureRow {
  const float *edge, *point;
};

// out[i] = (max(|d edge|, |d point|) / sqrt 2)^0.5 (section 4.2), of (Y+16)/116.
void featureDifferenceRow(const FeatureRow& reference, const FeatureRow& test, int count, float* out);

// out[i] = color^(1 - feature), 0 where color is 0 (section 4.3).
void combineRow(const float* color, const float* feature, int count, float* out);

} // namespace parity::compare
