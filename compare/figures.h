// The figures of a comparison: what is measured of a region (a material or the whole image).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parity::compare {

// Of a per-pixel error map over a region, weighted by the region's pixel weights. Percentiles are exact order
// statistics: the first value, ascending, whose running weight exceeds p times the total (FLIP.md, pooling).
struct Distribution {
  double mean = 0, p50 = 0, p95 = 0, max = 0;
};

// What is known of one region. Display-encoded images in [0,1].
struct Figures {
  std::uint64_t pixels = 0;               // in the region (weight > 0); all else is meaningless where this is 0
  Distribution flip;                      // LDR-FLIP, 0..1
  double rmse = 0;                        // over pixels and RGB, display-encoded
  double psnr = 0;                        // dB, 10*log10(1/mse); +infinity where identical (JSON: null)
  double referenceLuma = 0, testLuma = 0; // mean Rec.709 luma of the displayed image: says which is darker
  std::uint64_t nonFinite = 0;            // pixels of the region where either scene-referred image is NaN or infinite
};

// A region's figures over all its pixels, and over interior ones: eroded by FLIP's filter radius, so that no neighbour
// bleeds in (DESIGN 9). The interior may be empty.
struct RegionFigures {
  std::string name;
  Figures all, interior;
};

} // namespace parity::compare
