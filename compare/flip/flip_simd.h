// FLIP's inner loops, on rows of pixels; compiled for several instruction sets, the best of which is taken at run time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compare/flip/flip_filters.h"

namespace parity::compare {

// Rows are worked on in steps of at most this many values: buffers hold as many more than they need.
inline constexpr int kMaxSimdStep = 64;

// Filters are applied to this many rows at a time, so that the rows of a window are loaded to the first-level cache
// once for all of them. A multiple of every vector and of 4.
inline constexpr int kBatchRows = 16;

// How pixel values become linear light in [0,1].
enum class Decoding {
  srgb,     // display-encoded, clamped to [0,1]
  linear,   // clamped to [0,1]
  rational, // exposed, (k0 x^2 + k1 x + k2)/(k3 x^2 + k4 x + k5), clamped
  reinhard, // exposed, RGB/(1 + luminance), clamped
};

// What a row of pixels is, and what is to be done to it.
struct RowDecoder {
  Decoding decoding = Decoding::srgb;
  float exposure = 1;      // what values are multiplied by first (rational, reinhard)
  float coefficients[6]{}; // k0..k5 (rational)
};

// One row of an image, in the planes that the filters take: with X, Y, Z linear and divided by the white point, Y, X-Y
// and Y-Z. FLIP's YCxCz is (116 Y - 16, 500 (X-Y), 200 (Y-Z)); filters whose weights sum to 1 commute with that.
struct ColorPlanes {
  float *y, *xMinusY, *yMinusZ;
};

// count interleaved pixels of `channels` (3 or 4; the fourth is passed over). Bytes are display-encoded sRGB,
// value/255.
void decodeRow(const std::uint8_t* pixels, int channels, int count, const ColorPlanes& out);
void decodeRow(const RowDecoder& decoder, const float* pixels, int channels, int count, const ColorPlanes& out);

// The planes of a pair that filters are applied to, `stride` values apart. The test's colours are taken as differences
// from the reference's: what little two images differ by would drown in the rounding of two filtered values of 1.
enum SourcePlane { // of the reference, of reference minus test, and of the test
  kReferenceY,
  kReferenceXMinusY,
  kReferenceYMinusZ,
  kDifferenceY,
  kDifferenceXMinusY,
  kDifferenceYMinusZ,
  kTestY,
  kSourcePlanes
};

// out[i] = a[i] - b[i].
void subtractRow(const float* a, const float* b, std::size_t count, float* out);

// Planes of a batch of rows, filtered across rows, column after column: row r of column x of plane p is
// values[(p*stride + x)*kBatchRows + r].
enum FilteredPlane { kLuma, kRedGreen, kBlueYellowA, kBlueYellowB, kGauss, kEdge, kPoint, kFilteredPlanes };

// Which source planes the filters take: colours as seen through the contrast sensitivity functions, features of Y.
struct FilterInput {
  SourcePlane y, xMinusY, yMinusZ, featureY;
};
inline constexpr FilterInput kReferenceInput = {kReferenceY, kReferenceXMinusY, kReferenceYMinusZ, kReferenceY};
inline constexpr FilterInput kTestInput = {kDifferenceY, kDifferenceXMinusY, kDifferenceYMinusZ, kTestY};

// Filters across rows. rows: 2*radius + kBatchRows pointers from the topmost row that the first output row needs, each
// to kSourcePlanes planes. Columns begin..end-1, which may be overrun by kMaxSimdStep. Of the batch only rowCount rows
// are needed; others may be left out, here and below.
void filterAcrossRows(const FlipFilters& filters, const FilterInput& input, const float* const* rows,
                      std::size_t stride, int begin, int end, int rowCount, float* values);

// Columns of a batch, filtered in both directions, kBatchRows values each: colours (of the reference, or their
// difference), and the squared magnitudes of the edge and the point filter over Y.
struct FilteredColumns {
  float *y, *xMinusY, *yMinusZ, *edge2, *point2;
};

// Filters a batch along its rows: columns begin..begin+count-1, overrun to a multiple of 4.
void filterAlongRows(const FlipFilters& filters, const float* values, std::size_t stride, int begin, int count,
                     int rowCount, const FilteredColumns& out);

// The metric from filtered values (of kReferenceInput and kTestInput): colour and feature difference and what they
// come to, each in [0,1] (Andersson 2020, sections 4.1.4 to 4.3). color and feature may be null. The colours given and
// the test's edges are overwritten. Overruns by kMaxSimdStep.
struct Differences {
  float *flip, *color, *feature;
};
void computeDifferences(const FilteredColumns& reference, const FilteredColumns& test, int count,
                        const Differences& out);

// Columns of a batch as rows, `stride` values apart. Overruns each row to a multiple of 4, and writes up to kBatchRows
// rows.
void rowsOfColumns(const float* columns, int count, int rowCount, float* rows, std::ptrdiff_t stride);

// Where a value is above the largest so far, it takes its place, and `mark` that of the mark beside it.
void keepLargest(const float* values, int count, float mark, float* largest, float* marks);

// Compares `count` bytes of two rows in cells of `cell` bytes: sets bit i of `bits` where cell i differs in any bit.
// (The last cell may be shorter.)
void markDifferences(const void* a, const void* b, std::size_t count, std::size_t cell, std::uint64_t* bits);

// Whether all are neither NaN nor infinite.
bool allFinite(const float* values, std::size_t count);

} // namespace parity::compare
