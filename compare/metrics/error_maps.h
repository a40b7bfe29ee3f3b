// Per-pixel errors that several metrics pool, each in its own way.
#pragma once

#include "compare/metrics/metric_parts.h"

namespace parity::compare {

// Mean over R, G, B of the squared difference of displayed values. Where input.nonFinite says: 1, the largest there is.
MetricMaps squaredErrorMaps(const MetricInput& input, const MetricOptions& options);

} // namespace parity::compare
