// Random rows for the tests of agreement between device and CPU, and for bench/half_errors: less far out than a stress
// run's (study/stress/domain.h).
#pragma once

#include <functional>
#include <random>

#include "study/stress/evaluate.h"

namespace parity::stress {

using Random = std::mt19937;
using Maker = std::function<Row(Random&)>;

Maker uniforms(int count, double low, double high); // the first `count` inputs in [low, high]
Maker units(int count);                             // in [0, 1], ends included
Maker lobe(double low, double cosineLow); // a roughness in [low, 1], then a cosine, often within a smooth lobe
Maker directions(int count);              // unit vectors, one after the other
Row roughnessNearOne(Random& random);
Row normalAndCoefficients(Random& random);
Row distanceAndRange(Random& random);
Row distanceRangeAndExponent(Random& random); // squared distance, up to a quarter beyond the range
Row spotCosines(Random& random);
Row vectorAndFallback(Random& random);
Row litPoint(Random& random);
Row litLobe(Random& random);
Row localLight(Random& random);
Row radiance(Random& random);
Row fogAndWay(Random& random);
Row shadowAndFade(Random& random);

} // namespace parity::stress
