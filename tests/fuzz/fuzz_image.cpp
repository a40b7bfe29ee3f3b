// libFuzzer's target for pictures: JPEG, PNG, TIFF, WebP, Radiance HDR, OpenEXR and what else is read.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "base/parallel.h"
#include "fuzz/inputs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const parity::base::ThreadLimit oneThread(1);
  static const parity::tests::InputFolder folder;
  const auto result = parity::tests::loadImageBytes(folder, {reinterpret_cast<const std::byte*>(data), size});
  if (result.fault.empty()) return 0;
  std::fprintf(stderr, "fault: %s\n", result.fault.c_str());
  std::abort();
}
