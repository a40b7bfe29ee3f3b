// Shorthand that the pieces of the table share. Private to study/stress/table_*.cpp.
#pragma once

#include <initializer_list>
#include <utility>
#include <vector>

#include "study/stress/function_table.h"

namespace parity::stress::parts {

inline FunctionCase entry(const char* name, int id, Maker makeRow, const Agreement& agreement = {}) {
  FunctionCase function;
  function.name = name;
  function.id = id;
  function.makeRow = std::move(makeRow);
  function.agreement = agreement;
  return function;
}

inline std::vector<Input> join(std::initializer_list<std::vector<Input>> lists) {
  std::vector<Input> all;
  for (const std::vector<Input>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

inline Row rowOf(std::initializer_list<std::pair<int, double>> numbers) {
  Row row{};
  for (const auto& [at, value] : numbers) row[at] = value;
  return row;
}

// Outputs 0 to count - 1, as bits.
constexpr std::uint32_t first(int count) { return (1u << count) - 1; }

// Below one code of 8 bits an error of an albedo shows nowhere: it is relative to no less.
inline constexpr double kCode = 1.0 / 255;

// lavapipe's exp2 is within 2.9 ulp; what is computed from it inherits that.
inline const Agreement kEnvBrdf{8, 8, 1.04, "exp2; -1.04 a004 + r.z and 1.04 a004 + r.w cancel"};
inline const Agreement kMip{8, 8, 5, "log2; near roughness 1 it is small compared with the 5 that it is added to"};
inline const Agreement kExp2{8, 8, 0, "exp2"};
inline const Agreement kPow{32, 16, 1, "pow as exp2 of a product with log2"};
inline const Agreement kExp2AtOne{8, 8, 1, "exp2"};

} // namespace parity::stress::parts
