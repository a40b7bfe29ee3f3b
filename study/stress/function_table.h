// The one table of the functions of shading/*.glsl: what each takes, what must hold of what it gives, where it is known
// to fail and why; and the rows on which device and CPU are compared, with how closely they agree.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/stress/domain.h"
#include "study/stress/random_rows.h"

namespace parity::stress {

// Agreement of the device with the CPU at equal precision, in units of the last place of max(|expected|, scale), over
// the rows of makeRow.
struct Agreement {
  double ulps32 = 0;
  double ulps16 = 0;
  double scale = 0;        // size of what cancels: an error of an operand shows as an error of the difference
  const char* reason = ""; // why not 0 ulp; empty where it is
};

// What can be found wrong with a value.
enum class Fault {
  notFinite,      // NaN or infinite, inside the domain
  negative,       // where it may not be
  overUnity,      // above 1 by more than 4 units in the last place, where it may not be
  notMonotone,    // moves against the direction that the formula has
  notReciprocal,  // changes when two inputs are swapped
  brokenContract, // outside the domain, where the function's contract promises a finite value
};
inline constexpr std::size_t kFaultCount = 6;
const char* nameOf(Fault fault); // "not finite", "not monotone"...

// For which rows outside its domain a function promises finite values.
enum class Contract { none, forFinite, forNumbers /* infinities too, but no NaN */ };

// Something that the maths demands of two rows.
struct Claim {
  enum class Kind { increasing, decreasing, symmetric };
  Kind kind;
  int input;             // index into Domain::inputs
  int other = -1;        // the one it is swapped with (symmetric)
  std::uint32_t outputs; // bits: of which outputs
  double slackUlps = 16; // rounding: of max(|values|, scale)
  double scale = 0;
  double above = -1e300; // only where the input exceeds this
};

inline constexpr unsigned kIn64 = 1, kIn32 = 2, kIn16 = 4, kInAll = 7;
constexpr unsigned bitOf(Precision precision) { return 1u << static_cast<unsigned>(precision); }

// A failure that is known, with its cause. It must be there: one that no row shows any more has vanished, which is a
// finding as much as a new one.
struct Expectation {
  Fault fault;
  unsigned precisions;        // kIn... bits
  bool (*region)(const Row&); // of the row as rounded to the precision
  const char* regionText;     // the same in words
  const char* reason;
  Row witness; // is always tried: a row that shows it
};

// Where in the row roughness and cosine stand, for the map of errors; -1: it has none.
struct MapAxes {
  int roughness = -1, cosine = -1;
};

struct FunctionCase {
  std::string name;
  int id = -1;
  Maker makeRow;
  Agreement agreement;

  Domain domain;
  int outputs = 1;               // how many of the numbers that come out are meant
  std::uint32_t nonNegative = 0; // bits: outputs that may not be negative
  std::uint32_t atMostOne = 0;   // bits: outputs that may not exceed 1
  double errorScale = 0;         // errors are relative to max(|reference|, this, the smallest normal number)
  Contract contract = Contract::none;
  std::vector<Claim> claims;
  std::vector<Expectation> expected;
  MapAxes map;

  // How the table is written.
  FunctionCase& takes(std::vector<Input> inputs);
  FunctionCase& also(std::vector<Input> inputs);
  FunctionCase& where(bool (*holds)(const Row&));
  FunctionCase& settledBy(void (*settle)(Row&, double u));
  FunctionCase& gives(int count, std::uint32_t notNegative = 0, std::uint32_t notAboveOne = 0);
  FunctionCase& promises(Contract promised);
  FunctionCase& relativeTo(double scale);
  FunctionCase& increases(const char* input, std::uint32_t of = 1, double scale = 0, double above = -1e300);
  FunctionCase& decreases(const char* input, std::uint32_t of = 1, double scale = 0, double above = -1e300);
  FunctionCase& sameSwapping(const char* input, const char* with, std::uint32_t of = 1);
  FunctionCase& mapped(int roughness, int cosineAt);
  FunctionCase& expect(const Expectation& expectation);
};

// One entry per id, in order.
std::vector<FunctionCase> functionTable();

// The same with what the command line names: entries whose name the glob matches. Throws Error (usage) where none does.
std::vector<FunctionCase> functionsNamed(const std::string& glob);

// The pieces of functionTable, by the subject of the shading sources.
std::vector<FunctionCase> generalFunctions();  // real, material, light, mips, sh, fog, target, specular_aa
std::vector<FunctionCase> specularFunctions(); // brdf, env_brdf, mobile_direct, off_specular
std::vector<FunctionCase> mobileFunctions();   // mobile_base_pass, rgbm, sky_sh, refit
std::vector<FunctionCase> bakedFunctions();    // lightmap, capture

} // namespace parity::stress
