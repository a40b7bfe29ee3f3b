#include "job/view/display_table.h"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "report/pixel_chunk.h"

namespace parity::job {

base::Image makeDisplayTable(const base::DisplayTransform& display) {
  constexpr int kSide = kDisplayTableSide;
  std::array<float, kSide> nodes;
  for (int i = 0; i < kSide; ++i)
    nodes[static_cast<std::size_t>(i)] = static_cast<float>(
        std::exp2(kDisplayTableMinLog2 + i * double{kDisplayTableMaxLog2 - kDisplayTableMinLog2} / (kSide - 1)));
  base::Image linear(kSide * kSide, kSide, 3);
  auto value = linear.pixels.begin();
  for (const float blue : nodes)
    for (const float green : nodes)
      for (const float red : nodes) {
        *value++ = red;
        *value++ = green;
        *value++ = blue;
      }
  return display.apply(linear);
}

bool needsDisplayTable(const base::DisplayTransform& display) {
  return display.name() != "sRGB" && display.name() != "raw";
}

std::vector<std::byte> encodeDisplayTable(const base::DisplayTransform& display) {
  const base::Image table = makeDisplayTable(display);
  const report::EncodedPlane planes[] = {report::encodePlane({"table", report::PlaneKind::rgb16f, &table})};
  const std::pair<std::string_view, int> range[] = {{"minLog2", kDisplayTableMinLog2},
                                                    {"maxLog2", kDisplayTableMaxLog2}};
  return report::makeChunk(kDisplayTableFile, table.width, table.height, planes, range);
}

} // namespace parity::job
