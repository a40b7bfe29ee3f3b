// The walk over the lamps: a block of a vector belongs to four directions, which open a node or take it together. Each
// block goes its own way down the tree, and waits where another goes deeper.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "lighting/environment/lamp_steps.h"
#include "shading/shading.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lighting/environment/lamp_tree_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lighting/environment/simd_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace parity::lighting::HWY_NAMESPACE {

// The directions of kBlocks fours.
struct Walker {
  V x[3], sums[3];
  VI next; // the node that a block goes on at
};

// A node, seen from all directions of a walker.
struct Sight {
  V t, cosine;
  M isOut; // of the blocks that do not take the node
};

HWY_INLINE Sight lookAt(const LampNode& node, std::int32_t index, float a2, const Walker& walker) {
  const D d;
  const DI di;
  const V one = set(1.f), dx = hn::Sub(walker.x[0], set(node.direction.x)),
          dy = hn::Sub(walker.x[1], set(node.direction.y)), dz = hn::Sub(walker.x[2], set(node.direction.z));
  const V u = hn::Mul(hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz)), set(0.25f));
  return {hn::Add(u, hn::Mul(set(a2), hn::Sub(one, u))), hn::Sub(one, hn::Mul(set(2.f), u)),
          hn::RebindMask(d, hn::Gt(walker.next, hn::Set(di, index)))};
}

// Lanes of which the node is too near to stand for all below it.
HWY_INLINE M nearOf(const LampNode& node, const Sight& sight) {
  // kLampOpening: where the lobe's scale is 10 times a node's radius its light errs by some .1 %, of a long one by 3 %.
  // The scale is that of 1 / t^2, a parabola as wide as the distance or the lobe, and that of the cosine, which ends at
  // the horizon. findLampSteps knows it, too.
  const V ofCosine = hn::Add(hn::Mul(sight.cosine, sight.cosine), set(0.02f));
  return hn::AndNot(sight.isOut,
                    hn::Lt(hn::Mul(set(4.f), hn::Min(sight.t, ofCosine)), set(kLampOpening * node.spread)));
}

HWY_INLINE V weightOf(const LampNode& node, const Sight& sight, float a2, float scale) {
  const D d;
  const V zero = hn::Zero(d), one = set(1.f), inverse = hn::Div(one, sight.t);
  // meanOverSpread of shading/lamps.glsl
  const V spread = hn::Mul(hn::Mul(set(node.spread), inverse), hn::Sub(one, hn::Mul(set(1.5f * a2), inverse)));
  V curved = hn::Add(one, spread);
  const M isBelow = hn::Lt(spread, zero);
  if (!hn::AllFalse(d, isBelow)) curved = hn::IfThenElse(isBelow, hn::Div(one, hn::Sub(one, spread)), curved);
  const V lobe = hn::Mul(hn::Mul(inverse, inverse), set(scale));
  return hn::Mul(hn::Mul(hn::Max(sight.cosine, zero), lobe), curved);
}

HWY_INLINE void take(const LampNode& node, V weight, Walker& walker) {
  for (int c = 0; c < 3; ++c) walker.sums[c] = hn::Add(walker.sums[c], hn::Mul(weight, set(node.light[c])));
}

// All that is below a node, and itself.
HWY_INLINE void walk(const LampNode* nodes, std::int32_t first, float a2, float scale, Walker& walker) {
  const D d;
  const DI di;
  const auto end = static_cast<std::int32_t>(nodes[first].next);
  for (std::int32_t i = first; i < end;) {
    const LampNode& node = nodes[i];
    const auto afterAll = static_cast<std::int32_t>(node.next);
    Sight sight = lookAt(node, i, a2, walker);
    std::int32_t following = afterAll;
    if (afterAll != i + 1) {
      const M isNear = nearOf(node, sight);
      if (!hn::AllFalse(d, isNear)) {
        following = i + 1;
        sight.isOut = hn::Or(sight.isOut, wholeBlocks(isNear));
        if (hn::AllTrue(d, sight.isOut)) {
          i = following;
          continue;
        }
        walker.next = hn::IfThenElse(hn::RebindMask(di, sight.isOut), walker.next, hn::Set(di, afterAll));
      }
    }
    // Below the horizon of all: nothing to add.
    if (!hn::AllFalse(d, hn::Gt(sight.cosine, hn::Zero(d))))
      take(node, hn::IfThenZeroElse(sight.isOut, weightOf(node, sight, a2, scale)), walker);
    i = following;
  }
}

void AddLamps(const LampTree& tree, float a2, std::span<FourLampSums> fours) {
  const D d;
  const LampNode* nodes = tree.nodes.data();
  const std::vector<LampStep> steps = findLampSteps(tree, a2, fours);
  const float scale = 1 / shading::f32::prefilteredLobeIntegral(a2);
  for (std::size_t begin = 0; begin < fours.size(); begin += kBlocks) {
    FourLampSums* blocks[kBlocks]; // what is left over repeats the last
    for (std::size_t i = 0; i < kBlocks; ++i) blocks[i] = &fours[std::min(begin + i, fours.size() - 1)];
    Walker walker;
    walker.next = hn::Zero(DI());
    for (int c = 0; c < 3; ++c) {
      const auto direction = [&](std::size_t i)
                                 HWY_ATTR { return reinterpret_cast<const float*>(&blocks[i]->direction[c]); };
      const auto sum = [&](std::size_t i) HWY_ATTR { return reinterpret_cast<const float*>(&blocks[i]->sum[c]); };
      walker.x[c] = loadBlocks(d, direction);
      walker.sums[c] = loadBlocks(d, sum);
    }
    for (const LampStep step : steps) {
      const auto index = static_cast<std::int32_t>(step.node);
      if (step.isTaken)
        take(nodes[index], weightOf(nodes[index], lookAt(nodes[index], index, a2, walker), a2, scale), walker);
      else
        walk(nodes, index, a2, scale, walker);
    }
    for (int c = 0; c < 3; ++c) {
      alignas(64) float lanes[kLanes];
      hn::Store(walker.sums[c], d, lanes);
      for (std::size_t i = 0; i < std::min(kBlocks, fours.size() - begin); ++i)
        std::memcpy(&blocks[i]->sum[c], lanes + 4 * i, sizeof(Float4));
    }
  }
}

} // namespace parity::lighting::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::lighting {
namespace {

HWY_EXPORT(AddLamps);

} // namespace

void addLamps(const LampTree& tree, float a2, std::span<FourLampSums> fours) {
  HWY_DYNAMIC_DISPATCH(AddLamps)(tree, a2, fours);
}

} // namespace parity::lighting
#endif
