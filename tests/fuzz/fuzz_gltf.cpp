// libFuzzer's target for the scene loader.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "base/parallel.h"
#include "fuzz/gltf_mutator.h"
#include "fuzz/inputs.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // One thread: the same input takes the same way.
  static const parity::base::ThreadLimit oneThread(1);
  static const parity::tests::InputFolder folder;
  const auto result = parity::tests::loadGltfBytes(folder, {reinterpret_cast<const std::byte*>(data), size});
  if (result.fault.empty()) return 0;
  std::fprintf(stderr, "fault: %s\n", result.fault.c_str());
  std::abort();
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
  return parity::tests::mutateGltf(data, size, maxSize, seed, LLVMFuzzerMutate);
}
