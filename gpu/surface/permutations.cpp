#include "gpu/surface/permutations.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gpu/shaders/interface.h"

namespace parity::gpu {

namespace {

// Bits of a texture mask and of features, from the lowest.
constexpr std::array<const char*, kSlotCount + 1> kTextureNames = {"base colour",
                                                                   "metallic-roughness",
                                                                   "normal",
                                                                   "occlusion",
                                                                   "emissive",
                                                                   "specular",
                                                                   "specular colour",
                                                                   "coat",
                                                                   "coat roughness",
                                                                   "coat normal",
                                                                   "sheen colour",
                                                                   "sheen roughness",
                                                                   "anisotropy",
                                                                   "iridescence",
                                                                   "film thickness",
                                                                   "transmission",
                                                                   "thickness",
                                                                   "diffuse transmission",
                                                                   "diffuse transmission colour",
                                                                   "spread of normals"};
constexpr std::array<const char*, 11> kFeatureNames = {
    "unlit",       "nonmetal",     "fully rough",          "blended", "coat", "sheen", "anisotropy",
    "iridescence", "transmission", "diffuse transmission", "volume"};
static_assert(kNormalVariance == 1u << (kTextureNames.size() - 1) &&
              kFeatureVolume == 1u << (kFeatureNames.size() - 1));

std::string join(const std::vector<std::string>& words) {
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

constexpr std::uint32_t kSlots = (1u << kSlotCount) - 1;

// Whether the permutation has the code that the class needs, and none that the class must not run. It serves the class
// once it is widened for it.
bool serves(const Permutation& p, const MaterialClass& c) {
  constexpr std::uint32_t kCode = kSlots | kNormalVariance;
  return (c.textures & kCode & ~p.textures) == 0 && (c.features & ~p.mayFeatures) == 0 &&
         (p.mustFeatures & ~c.features) == 0;
}

// The permutation with what the class needs it to ask at run time, and to read apart; the same where it does not serve
// the class.
Permutation widenFor(Permutation p, const MaterialClass& c) {
  if (!serves(p, c)) return p;
  p.textures |= c.textures & kTextureReads;
  if (((p.textures ^ c.textures) & kSlots) != 0) p.textures |= kTexturesVary;
  return p;
}

} // namespace

Permutation everyScenePermutation(std::uint32_t textures) {
  return {(textures & ~kLobeTextures) | kTextureReads | kTexturesVary,
          kFeatureUnlit | kFeatureNonmetal | kFeatureFullyRough | kFeatureBlend, 0, true};
}

PermutationBudget PermutationBudget::withLobes() const {
  // Two: what its first view shows, and what is seen later.
  return shares ? PermutationBudget{.own = std::max<std::size_t>(own, 2)} : *this;
}

PermutationBudget shareOf(std::size_t scene, std::size_t sceneCount) {
  const bool shares = sceneCount > kMaxPermutations;
  const std::size_t own = shares ? kMaxPermutations - 1 : kMaxPermutations;
  return {.own = own * (scene + 1) / sceneCount - own * scene / sceneCount, .shares = shares};
}

PermutationPlan::PermutationPlan(const PermutationBudget& budget, std::uint32_t textures,
                                 std::vector<MaterialClass> classes)
    : m_budget(budget), m_textures(textures), m_classes(std::move(classes)) {}

void PermutationPlan::add(std::vector<ClassPixels> seen) {
  std::erase_if(seen, [&](const ClassPixels& c) { return has(c.materialClass); });
  std::ranges::stable_sort(seen, std::ranges::greater(), &ClassPixels::pixels);
  std::vector<MaterialClass> rest;
  const std::size_t before = m_own.size();
  for (const auto& [c, pixels] : seen) {
    const auto isExact = [&](const Permutation& p) {
      return ((p.textures ^ c.textures) & ~(kTextureReads | kTexturesVary)) == 0 &&
             (c.textures & kTextureReads & ~p.textures) == 0 && p.mayFeatures == c.features &&
             p.mustFeatures == c.features;
    };
    const double savingMs = static_cast<double>(pixels) * kPermutationSavingNsPerPixel * 1e-6;
    const bool isLeft = m_budget.shares ? m_own.size() < m_budget.own : !isLast();
    auto exact = std::ranges::find_if(m_own, isExact);
    if (exact == m_own.end()) {
      if (!isLeft || savingMs <= kPermutationCostMs) {
        rest.push_back(c);
        continue;
      }
      exact = m_own.insert(m_own.end(), Permutation{c.textures, c.features, c.features});
    }
    m_planned[c] = *exact;
  }
  if (m_budget.shares) {
    for (const MaterialClass& c : rest) m_planned[c] = everyScenePermutation(m_textures);
    return;
  }
  for (std::size_t i = before; i < m_own.size(); ++i) widenForOthers(m_own[i]);
  std::erase_if(rest, [&](const MaterialClass& c) {
    const auto found = std::ranges::find_if(m_own, [&](const Permutation& p) { return serves(p, c); });
    if (found != m_own.end()) m_planned[c] = *found;
    return found != m_own.end();
  });
  if (rest.empty()) return;
  if (isLast())
    for (const MaterialClass& c : m_classes)
      if (!has(c) && std::ranges::find(rest, c) == rest.end()) rest.push_back(c);
  Permutation wide{0, 0, ~0u};
  for (const MaterialClass& c : rest) {
    wide.textures |= c.textures;
    wide.mayFeatures |= c.features;
    wide.mustFeatures &= c.features;
  }
  for (const MaterialClass& c : rest) wide = widenFor(wide, c);
  for (const MaterialClass& c : rest) m_planned[c] = wide;
  m_own.push_back(wide);
  widenForOthers(m_own.back());
}

void PermutationPlan::widenForOthers(Permutation& own) {
  const Permutation before = own;
  for (const MaterialClass& c : m_classes)
    if (!has(c)) own = widenFor(own, c);
  for (auto& [c, permutation] : m_planned)
    if (permutation == before) permutation = own;
}

std::size_t countTextures(std::uint32_t textures) { return static_cast<std::size_t>(std::popcount(textures & kSlots)); }

std::string describeTextures(std::uint32_t textures) {
  std::vector<std::string> words;
  for (std::size_t bit = 0; bit < kTextureNames.size(); ++bit)
    if ((textures >> bit & 1u) != 0) words.emplace_back(kTextureNames[bit]);
  return join(words);
}

std::string describeFeatures(const Permutation& permutation) {
  std::vector<std::string> words;
  for (std::size_t bit = 0; bit < kFeatureNames.size(); ++bit)
    if ((permutation.mustFeatures >> bit & 1u) != 0)
      words.emplace_back(kFeatureNames[bit]);
    else if ((permutation.mayFeatures >> bit & 1u) != 0)
      words.push_back(std::string("some ") + kFeatureNames[bit]);
  return join(words);
}

} // namespace parity::gpu
