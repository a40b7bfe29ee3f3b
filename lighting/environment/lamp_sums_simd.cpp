// The walk over the lamps: sixteen directions open a node or take it together.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "lighting/environment/lamp_sums.h"
#include "shading/shading.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lighting/environment/lamp_sums_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lighting/environment/simd_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace parity::lighting::HWY_NAMESPACE {

constexpr std::size_t kFours = 4; // of a walker, on every processor: they open a node together
constexpr std::size_t kParts = kFours / kBlocks;
static_assert(kFours % kBlocks == 0);

struct Walker {
  V x[kParts][3], sums[kParts][3];
};

// A node, seen from a part of a walker's directions.
struct Sight {
  V t, cosine;
};

HWY_INLINE Sight lookAt(const LampNode& node, float a2, const V (&x)[3]) {
  const V one = set(1.f), dx = hn::Sub(x[0], set(node.direction.x)), dy = hn::Sub(x[1], set(node.direction.y)),
          dz = hn::Sub(x[2], set(node.direction.z));
  const V u = hn::Mul(hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz)), set(0.25f));
  return {hn::Add(u, hn::Mul(set(a2), hn::Sub(one, u))), hn::Sub(one, hn::Mul(set(2.f), u))};
}

// Whether the node is too near to one of the directions to stand for all below it.
HWY_INLINE bool isNear(const LampNode& node, const Sight& sight) {
  const V ofCosine = hn::Add(hn::Mul(sight.cosine, sight.cosine), set(kLampHorizonScale));
  const M isTooNear = hn::Lt(hn::Mul(set(4.f), hn::Min(sight.t, ofCosine)), set(kLampOpening * node.spread));
  return !hn::AllFalse(D(), isTooNear);
}

// Mean of max(cosine, 0) over a node, whose spread is above 0. Where the horizon cuts it, between -h and h, it is a
// parabola. At the horizon that is the mean of a normal distribution with half of the spread along each axis:
// h / 4 = sqrt(spread / 2) / sqrt(2 pi).
HWY_INLINE V cosineOf(const LampNode& node, V cosine) {
  const D d;
  const M isCut = hn::Lt(hn::Mul(cosine, hn::Abs(cosine)), set(kLampHorizon * kLampHorizon * node.spread));
  if (hn::AllFalse(d, isCut)) return cosine;
  const float h = kLampHorizon * std::sqrt(node.spread);
  const V above = hn::Add(hn::Max(cosine, set(-h)), set(h));
  return hn::IfThenElse(isCut, hn::Mul(hn::Mul(above, above), set(0.25f / h)), cosine);
}

HWY_INLINE V weightOf(const LampNode& node, const Sight& sight, float a2, float scale) {
  const D d;
  const V one = set(1.f), inverse = hn::Div(one, sight.t);
  // meanOverSpread of shading/lamps.glsl
  const V spread = hn::Mul(hn::Mul(set(node.spread), inverse), hn::Sub(one, hn::Mul(set(1.5f * a2), inverse)));
  V curved = hn::Add(one, spread);
  const M isInside = hn::Lt(spread, hn::Zero(d));
  if (!hn::AllFalse(d, isInside)) curved = hn::IfThenElse(isInside, hn::Div(one, hn::Sub(one, spread)), curved);
  const V lobe = hn::Mul(hn::Mul(inverse, inverse), set(scale));
  return hn::Mul(hn::Mul(cosineOf(node, sight.cosine), lobe), curved);
}

HWY_INLINE void take(const LampNode& node, V weight, V (&sums)[3]) {
  for (int c = 0; c < 3; ++c) sums[c] = hn::Add(sums[c], hn::Mul(weight, set(node.light[c])));
}

// All that is below a node, and itself.
HWY_INLINE void walk(const LampNode* nodes, std::uint32_t first, float a2, float scale, Walker& walker) {
  const std::uint32_t end = nodes[first].next;
  for (std::uint32_t i = first; i < end;) {
    const LampNode& node = nodes[i];
    Sight sights[kParts];
    bool isOpen = false;
    for (std::size_t part = 0; part < kParts; ++part) {
      sights[part] = lookAt(node, a2, walker.x[part]);
      isOpen |= isNear(node, sights[part]);
    }
    if (isOpen && node.next != i + 1) {
      ++i;
      continue;
    }
    for (std::size_t part = 0; part < kParts; ++part)
      take(node, weightOf(node, sights[part], a2, scale), walker.sums[part]);
    i = node.next;
  }
}

using Fours = std::array<FourLampSums*, kFours>;

HWY_INLINE Walker makeWalker(const Fours& fours) {
  const D d;
  Walker walker;
  for (std::size_t part = 0; part < kParts; ++part)
    for (int c = 0; c < 3; ++c) {
      const auto four = [&](std::size_t i) HWY_ATTR { return fours[part * kBlocks + i]; };
      const auto direction = [&](std::size_t i)
                                 HWY_ATTR { return reinterpret_cast<const float*>(&four(i)->direction[c]); };
      const auto sum = [&](std::size_t i) HWY_ATTR { return reinterpret_cast<const float*>(&four(i)->sum[c]); };
      walker.x[part][c] = loadBlocks(d, direction);
      walker.sums[part][c] = loadBlocks(d, sum);
    }
  return walker;
}

HWY_INLINE void storeSums(const Walker& walker, const Fours& fours) {
  for (std::size_t part = 0; part < kParts; ++part)
    for (int c = 0; c < 3; ++c) {
      alignas(64) float lanes[kLanes];
      hn::Store(walker.sums[part][c], D(), lanes);
      for (std::size_t i = 0; i < kBlocks; ++i)
        std::memcpy(&fours[part * kBlocks + i]->sum[c], lanes + 4 * i, sizeof(Float4));
    }
}

void AddLamps(const LampTree& tree, float a2, const LampSteps& steps, std::span<FourLampSums> fours) {
  const LampNode* nodes = tree.nodes.data();
  const float scale = 1 / shading::f32::prefilteredLobeIntegral(a2);
  for (std::size_t begin = 0; begin < fours.size(); begin += kFours) {
    Fours together; // what is left over repeats the last
    for (std::size_t i = 0; i < kFours; ++i) together[i] = &fours[std::min(begin + i, fours.size() - 1)];
    Walker walker = makeWalker(together);
    for (const auto& taken : {std::span(steps.smooth), std::span(steps.taken)})
      for (const std::uint32_t i : taken)
        for (std::size_t part = 0; part < kParts; ++part)
          take(nodes[i], weightOf(nodes[i], lookAt(nodes[i], a2, walker.x[part]), a2, scale), walker.sums[part]);
    for (const std::uint32_t i : steps.walked) walk(nodes, i, a2, scale, walker);
    storeSums(walker, together);
  }
}

} // namespace parity::lighting::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::lighting {
namespace {

HWY_EXPORT(AddLamps);

} // namespace

void addLamps(const LampTree& tree, float a2, const LampSteps& steps, std::span<FourLampSums> fours) {
  HWY_DYNAMIC_DISPATCH(AddLamps)(tree, a2, steps, fours);
}

} // namespace parity::lighting
#endif
