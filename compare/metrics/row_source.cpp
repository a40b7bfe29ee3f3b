#include "compare/metrics/row_source.h"

#include <algorithm>
#include <utility>

#include "compare/metrics/color_rows.h"

namespace parity::compare {

void RowSource::reserve(int count) {
  m_stride = std::max(m_stride, 3 * static_cast<std::size_t>(count));
  m_values.resize(std::max(m_values.size(), 2 * kSpaces * m_stride));
}

void RowSource::set(const MetricInput& input, int x, int y, int count) {
  m_input = &input, m_x = x, m_y = y, m_count = count;
  for (auto& spaces : m_has) std::fill_n(spaces, int{kSpaces}, false);
}

float* RowSource::at(int i, Space space) {
  return m_values.data() + (static_cast<std::size_t>(i) * kSpaces + static_cast<std::size_t>(space)) * m_stride;
}

const float* RowSource::displayed(int i) {
  float* row = at(i, kDisplayed);
  if (!std::exchange(m_has[i][kDisplayed], true))
    readDisplayRow(i == 0 ? m_input->reference : m_input->test, m_x, m_y, m_count, row);
  return row;
}

const float* RowSource::decoded(int i) {
  float* row = at(i, kDecoded);
  if (!std::exchange(m_has[i][kDecoded], true))
    readLinearRow(i == 0 ? m_input->reference : m_input->test, nullptr, m_x, m_y, m_count, row);
  return row;
}

const float* RowSource::light(int i) {
  const base::Image* linear = i == 0 ? m_input->referenceLinear : m_input->testLinear;
  return linear ? linear->at(m_x, m_y) : decoded(i);
}

float* RowSource::room(int i) { return at(i, kRoom); }

} // namespace parity::compare
