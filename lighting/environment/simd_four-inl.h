// Four floats for the target of Highway that has vectors of one: its functions, of the same names, on the compiler's
// own vectors. Results are those of all other targets. For simd_blocks-inl.h alone, which takes care to include it
// once.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "lighting/environment/float4.h"

HWY_BEFORE_NAMESPACE();
namespace parity::lighting::HWY_NAMESPACE {

struct D {};
struct DI {};
using V = Float4;
using VI = Int4;
using M = Int4; // -1 where it holds

namespace hn {

template <typename Tag> struct VectorOf { using Type = V; };
template <> struct VectorOf<DI> { using Type = VI; };
template <typename Tag> using Vec = typename VectorOf<Tag>::Type;
template <typename Tag> constexpr std::size_t MaxLanes(Tag) { return 4; }

inline V Set(D, float v) { return V{v, v, v, v}; }
inline VI Set(DI, std::int32_t v) { return VI{v, v, v, v}; }
inline V Zero(D) { return V{}; }
inline V LoadU(D, const float* p) {
  V v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline V LoadDup128(D d, const float* p) { return LoadU(d, p); }
template <typename T, typename Tag> void Store(const Vec<Tag>& v, Tag, T* p) { std::memcpy(p, &v, sizeof v); }

template <typename T> T Add(const T& a, const T& b) { return a + b; }
template <typename T> T Sub(const T& a, const T& b) { return a - b; }
template <typename T> T Mul(const T& a, const T& b) { return a * b; }
inline V Div(const V& a, const V& b) { return a / b; }
inline V Neg(const V& a) { return -a; }
inline V Abs(const V& a) { return a < 0 ? -a : a; }
template <typename T> T Min(const T& a, const T& b) { return a < b ? a : b; }
template <typename T> T Max(const T& a, const T& b) { return a > b ? a : b; }
template <int bits> VI ShiftLeft(const VI& v) { return v << bits; }

inline M Lt(const V& a, const V& b) { return a < b; }
inline M Ge(const V& a, const V& b) { return a >= b; }
inline M Eq(const V& a, const V& b) { return a == b; }
template <typename T> M Gt(const T& a, const T& b) { return a > b; }
template <typename T> T And(const T& a, const T& b) { return a & b; }
template <typename Tag> M RebindMask(Tag, const M& m) { return m; }
inline bool AllTrue(D, const M& m) { return (m[0] & m[1] & m[2] & m[3]) != 0; }
inline bool AllFalse(D, const M& m) { return (m[0] | m[1] | m[2] | m[3]) == 0; }
template <typename T> T IfThenElse(const M& m, const T& yes, const T& no) { return m ? yes : no; }

inline VI ConvertTo(DI, const V& v) { return __builtin_convertvector(v, VI); }
inline V ConvertTo(D, const VI& v) { return __builtin_convertvector(v, V); }
inline V BitCast(D, const VI& v) {
  V bits;
  std::memcpy(&bits, &v, sizeof bits);
  return bits;
}
template <int lane> V Broadcast(const V& v) { return V{v[lane], v[lane], v[lane], v[lane]}; }

} // namespace hn

} // namespace parity::lighting::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
