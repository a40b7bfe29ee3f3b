// The metrics there are: each is made by a file of its own, metric_NAME.cpp.
#pragma once

#include "compare/metrics/metric.h"

namespace parity::compare {

Metric makeFlipMetric();
Metric makeHdrFlipMetric();
Metric makeSsimMetric();
Metric makeMsSsimMetric();
Metric makeDeltaEMetric();
Metric makeRmseMetric();
Metric makeRelMseMetric();
Metric makePsnrMetric();
Metric makeMaxAbsMetric();
Metric makeBiasMetric();

} // namespace parity::compare
