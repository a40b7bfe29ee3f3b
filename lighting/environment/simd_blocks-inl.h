// Vectors of one, two or four blocks of four floats, for each instruction set that Highway compiles the including file
// for. What one block holds does not depend on how many there are.
#if defined(PARITY_LIGHTING_SIMD_BLOCKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PARITY_LIGHTING_SIMD_BLOCKS_INL_H_
#undef PARITY_LIGHTING_SIMD_BLOCKS_INL_H_
#else
#define PARITY_LIGHTING_SIMD_BLOCKS_INL_H_
#endif

#include <cstddef>

#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR
#include "lighting/environment/simd_four-inl.h"
#endif

HWY_BEFORE_NAMESPACE();
namespace parity::lighting::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR
namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using DI = hn::RebindToSigned<D>;
using VI = hn::Vec<DI>;
#endif

constexpr std::size_t kLanes = hn::MaxLanes(D()), kBlocks = kLanes / 4;

// Block i is the four floats at `of(i)`. Tag: of a vector of some blocks, the first of which is block `first`.
template <std::size_t first = 0, typename Tag, typename Of> HWY_INLINE hn::Vec<Tag> loadBlocks(Tag d, const Of& of) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(Tag()) > 4) {
    const hn::Half<Tag> half;
    return hn::Combine(d, loadBlocks<first + hn::MaxLanes(Tag()) / 8>(half, of), loadBlocks<first>(half, of));
  } else
#endif
    return hn::LoadU(d, of(first));
}

// Block i is four times the float at `of(i)`.
template <std::size_t first = 0, typename Tag, typename Of> HWY_INLINE hn::Vec<Tag> fillBlocks(Tag d, const Of& of) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(Tag()) > 4) {
    const hn::Half<Tag> half;
    return hn::Combine(d, fillBlocks<first + hn::MaxLanes(Tag()) / 8>(half, of), fillBlocks<first>(half, of));
  } else
#endif
    return hn::Set(d, *of(first));
}

// The same four floats in each block.
HWY_INLINE V repeatBlock(const float* p) { return hn::LoadDup128(D(), p); }
HWY_INLINE V set(float value) { return hn::Set(D(), value); }

} // namespace parity::lighting::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
