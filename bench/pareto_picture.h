// Cost against error of many settings, as a picture.
#pragma once

#include <string>
#include <vector>

namespace parity::bench {

// One setting over all pairs of scene and environment: time over the default's, errors (median, worst).
struct Row {
  std::string name;
  double ratio, relMse, worstRelMse, relMseSpecular, worstSpecular, flip, worstFlip;
};

// An SVG: time over the default's (x) against the median relMSE (y, logarithmic), each row a dot with its name; the
// first row in red, dominated ones in grey (as cheap or cheaper is another that is nearer to the truth).
std::string paretoPicture(const std::vector<Row>& rows);

} // namespace parity::bench
