// One function of the table under stress: in f64, f32 and half on the CPU, in single and half on the device.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "study/stress/finding.h"
#include "study/stress/tally.h"

namespace parity::gpu {
class Device;
}

namespace parity::stress {

// A function on the CPU, for a row that is rounded to the precision already.
using CpuFunction = std::function<Result(Precision, const Row&)>;

// Evaluates rows that are rounded to the precision already.
using Evaluate = std::function<std::vector<Result>(const std::vector<Row>&)>;

struct FunctionOptions {
  std::uint32_t points = 10'000'000;     // of the low-discrepancy sequence, besides the special values
  std::uint32_t devicePoints = 1u << 18; // 0: the device is left out
};

// One precision on one side.
struct Column {
  Precision precision = Precision::f64;
  bool onDevice = false;
  std::string skipped; // why it was not run; empty where it was
  Tally tally;

  std::string name() const; // "cpu fp16"
};

struct FunctionResult {
  FunctionCase function;
  std::uint64_t points = 0, devicePoints = 0; // that were run
  std::vector<Column> columns;
  double timeMs = 0;
};

// The CPU's columns alone, of any function: `evaluate` in place of the one that function.id names.
FunctionResult stressOnCpu(const FunctionCase& function, std::uint32_t points, const CpuFunction& evaluate);

// device: null where options.devicePoints is 0. The result does not depend on the number of threads. Throws Error (exit
// 4) for a lost device or a message of the validation layer.
FunctionResult stressFunction(const FunctionCase& function, const FunctionOptions& options, const gpu::Device* device);

// Unexpected faults, expected ones, expectations that no row met.
std::vector<Finding> findingsOf(const FunctionResult& result);

// What --at takes for this row: "D_GGX:0.5,1".
std::string formatAt(const FunctionCase& function, const Row& row);
// Back: the function and its row, not rounded. Throws Error (usage).
struct At {
  FunctionCase function;
  Row row{};
};
At parseAt(const std::string& text);

// Each precision and side at that input, in words; device may be null.
std::string describeAt(const At& at, const gpu::Device* device);

// A number in its shortest form that reads back the same; "nan", "inf", "-inf".
std::string formatExactly(double value);

// The device's results for rows that are rounded to the precision (single or half).
Evaluate deviceEvaluator(const gpu::Device& device, int id, Precision precision);

} // namespace parity::stress
