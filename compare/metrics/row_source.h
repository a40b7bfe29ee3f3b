// The pixels of a run, of both pictures of a pair, in the spaces that metrics need; each is made once, where asked for.
#pragma once

#include <cstddef>
#include <vector>

#include "compare/metrics/metric_input.h"

namespace parity::compare {

class RowSource {
public:
  // Room for runs of so many pixels.
  void reserve(int count);
  // The run that is meant from now on.
  void set(const MetricInput& input, int x, int y, int count);

  int count() const { return m_count; }
  // 3 count() values of the reference (0) or the test (1):
  const float* displayed(int i);
  const float* decoded(int i); // the displayed ones as linear light
  const float* light(int i);   // linear light as the images have it; decoded() where they have none
  // Room for 3 count() values of the caller's for each picture.
  float* room(int i);

private:
  enum Space { kDisplayed, kDecoded, kRoom, kSpaces };
  float* at(int i, Space space);

  const MetricInput* m_input = nullptr;
  int m_x = 0, m_y = 0, m_count = 0;
  std::size_t m_stride = 0; // values of one space
  bool m_has[2][kSpaces] = {};
  std::vector<float> m_values;
};

} // namespace parity::compare
