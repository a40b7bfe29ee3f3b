// Rows of a picture in the spaces that metrics need: displayed, linear, luma, CIELAB.
#pragma once

#include <cstddef>
#include <functional>

#include "base/image/image.h"
#include "compare/pooling/pixel_view.h"

namespace parity::compare {

// The 3*count values of pixels x .. x+count-1 of row y, 0..1: bytes over 255, floats as they are.
void readDisplayRow(const PixelView& view, int x, int y, int count, float* rgb);

// The same pixels as linear Rec.709: those of `linear`, or where it is null the displayed ones, clamped to [0,1] and
// decoded by sRGB's transfer function (IEC 61966-2-1).
void readLinearRow(const PixelView& view, const base::Image* linear, int x, int y, int count, float* rgb);

// Rec.709 luma: 0.2126 R + 0.7152 G + 0.0722 B of display-encoded values; of linear ones it is the luminance.
void lumaRow(const float* rgb, int count, float* luma);

// CIELAB of D65 (CIE 1976) from linear Rec.709, clamped to [0,1]. L 0..100; a and b about -128..128, 0 within 1e-5 for
// greys. L, a, b may not overlap rgb.
struct LabRow {
  float *l, *a, *b;
};
void labRow(const float* linearRgb, int count, const LabRow& lab);

// Calls body(y) for the rows of `box`, on all threads.
void forRows(const Rect& box, const std::function<void(int y)>& body);

} // namespace parity::compare
