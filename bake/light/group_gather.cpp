#include "bake/light/group_gather.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <vector>

#include "bake/light/guide_training.h"
#include "reference/sampling.h"

namespace parity::bake {

namespace {

constexpr std::uint32_t kReplicates = 4;
constexpr double kOwnFreedom = kReplicates - 1; // degrees, of a texel's variance
// The same that neighbours may add: as many as 7 of them have.
constexpr double kMostOfOthers = 7 * kOwnFreedom;

// Samples that train a guide: of the group together, but of each texel this part of what it may take at most.
constexpr std::uint32_t kTraining = 8192, kTrainingPart = 8;
// Numbers of samples are multiples of it, so that each way of sampling has taken its part.
constexpr std::uint32_t kStep = 8;
// A replicate trains with this many at least: nextNumber() of it is a multiple of kStep, and so is every later one.
constexpr std::uint32_t kLeastTraining = 2 * kStep;
// The light's direction may be so many times less exact than its sum, over l0: it only tells apart a texel's normals.
constexpr double kDirectionSlack = 4;

// Samples of a replicate after n of them: 2^k and 3 * 2^k.
std::uint32_t nextNumber(std::uint32_t n) { return n + (std::has_single_bit(n) ? n / 2 : n / 3); }

// A texel while it is gathered for.
struct State {
  const GroupTexel* texel = nullptr;
  GatherPoints points;
  std::array<LightSum, kReplicates> unguided{}, guided{};
  double squaredError = 0, squaredErrorOfSh = 0; // of the mean, relative; of the worst coefficient of order 1
  double scatter = 0, counted = 0;               // error by the replicates alone, and samples, at the last step
  bool isDone = false;

  // Of a replicate, the samples that had no guide counted by `worth`.
  LightSum sumOf(std::uint32_t replicate, double worth) const {
    LightSum sum = unguided[replicate].scaledBy(worth);
    return sum += guided[replicate];
  }

  // n: samples of a replicate, as they count.
  void judge(double n, double worth, double floor) {
    double mean = 0, squares = 0;
    glm::dvec4 sh(0), shSquares(0);
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
      const LightSum sum = sumOf(r, worth).scaledBy(1 / n);
      const double luminance = lightmapLuminance(sum.irradiance + sum.back);
      mean += luminance / kReplicates;
      squares += luminance * luminance / kReplicates;
      sh += sum.sh / static_cast<double>(kReplicates);
      shSquares += sum.sh * sum.sh / static_cast<double>(kReplicates);
    }
    const auto over = [](double variance, double whole) {
      return variance > 0 ? variance / (kOwnFreedom * whole * whole) : 0;
    };
    squaredError = over(squares - mean * mean, std::max(mean + texel->known, floor));
    const glm::dvec4 variances = shSquares - sh * sh;
    squaredErrorOfSh = over(std::max({variances.y, variances.z, variances.w}), std::max(sh.x, floor * kY0));
  }
};

class Group {
public:
  Group(const Surroundings& around, std::span<const GroupTexel> texels, const GroupOptions& options,
        std::uint64_t& rays)
      : m_around(around), m_options(options), m_rays(rays) {
    std::vector<glm::vec3> normals;
    bool bothSides = false;
    for (std::size_t k = 0; k < texels.size(); ++k) {
      const GroupTexel& texel = texels[k];
      m_result[k] = texel.before;
      if (texel.points.count == 0) continue;
      const auto points = std::span(texel.points.points).first(texel.points.count);
      m_states.push_back({.texel = &texel, .points = {points, texel.bothSides}});
      m_places.push_back(k);
      for (const SurfacePoint& point : points) normals.push_back(point.normal);
      bothSides |= texel.bothSides;
    }
    m_active = static_cast<std::uint32_t>(m_states.size());
    if (m_active > 0) m_directions.emplace(normals, bothSides);
  }

  GatheredGroup run() {
    if (m_active == 0) return m_result;
    const auto most = static_cast<std::uint32_t>(m_options.maxSamples) / kReplicates; // of a replicate
    const std::uint32_t training = std::bit_floor(std::min(kTraining / kReplicates / m_active, most / kTrainingPart));
    const std::uint32_t unguided = std::min(std::max(training, kLeastTraining), most);
    std::uint64_t left = std::uint64_t{m_active} * (most - unguided); // of a replicate, over all texels
    const GuideTraining trained = train(unguided);
    finish(unguided, unguided, unguided, 1);

    const double unguidedError = meanSquaredError();
    const DirectionGuide guide = trained.guide();
    const GatherWay way{*m_directions, guide, trained.shares()};
    double worth = 1;
    for (std::uint32_t n = 0; m_active > 0;) {
      const std::uint32_t wanted = n == 0 ? unguided : nextNumber(n) - n;
      const auto affordable = static_cast<std::uint32_t>(left / m_active / kStep * kStep);
      const std::uint32_t more = std::min(wanted, affordable);
      if (more == 0 || more < wanted / 4) break; // it would hardly help
      left -= std::uint64_t{m_active} * more;
      for (State& state : m_states) addGuided(state, way, n, n + more);
      n += more;
      if (n == unguided) {
        // By as many of both: what one without a guide is worth.
        judge(n, 0);
        worth = unguidedError > 0 ? std::min(meanSquaredError() / unguidedError, 1.0) : 1;
      }
      const double counted = n + worth * unguided;
      judge(counted, worth);
      finish(n + unguided, unguided, counted, worth);
    }
    return m_result;
  }

private:
  GuideTraining train(std::uint32_t count) {
    GuideTraining training;
    const DirectionGuide even;
    const GatherWay way{*m_directions, even, kTrainingShares};
    for (State& state : m_states)
      for (std::uint32_t r = 0; r < kReplicates; ++r) {
        const std::uint32_t seed = reference::hashCombine(state.texel->seed, r);
        for (std::uint32_t s = 0; s < count; ++s) {
          const GatherSample sample = gatherSample(m_around, state.points, way, s, seed, m_rays);
          training.add(gatherPoint(s, seed), sample);
          state.unguided[r] += sample.sum;
        }
      }
    judge(count, 1);
    return training;
  }

  void addGuided(State& state, const GatherWay& way, std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t r = 0; r < kReplicates && !state.isDone; ++r) {
      const std::uint32_t seed = reference::hashCombine(state.texel->seed, kReplicates + r);
      for (std::uint32_t s = from; s < to; ++s)
        state.guided[r] += gatherSample(m_around, state.points, way, s, seed, m_rays).sum;
    }
  }

  void judge(double n, double worth) {
    for (State& state : m_states)
      if (!state.isDone) state.judge(n, worth, m_options.floor);
  }

  // Of those that are not done.
  double meanSquaredError() const {
    double sum = 0;
    for (const State& state : m_states) sum += state.isDone ? 0 : state.squaredError;
    return sum / std::max(m_active, 1u);
  }

  // Takes what has been found, of n samples of a replicate, some of them unguided; who is exact enough is done.
  void finish(std::uint32_t n, std::uint32_t unguided, double counted, double worth) {
    double all = 0, allOfSh = 0;
    for (const State& state : m_states)
      if (!state.isDone) {
        all += state.squaredError;
        allOfSh += state.squaredErrorOfSh;
      }
    const double others = m_active - 1, freedomOfOthers = std::min(kOwnFreedom * others, kMostOfOthers),
                 freedom = kOwnFreedom + freedomOfOthers, factor = studentOf95Percent(freedom);
    const auto errorOf = [&](double own, double sum) {
      const double theirs = others > 0 ? std::max(sum - own, 0.0) / others : 0;
      return factor * std::sqrt((kOwnFreedom * own + freedomOfOthers * theirs) / freedom);
    };
    for (std::size_t k = 0; k < m_states.size(); ++k) {
      State& state = m_states[k];
      if (state.isDone) continue;
      const Gathered& before = state.texel->before;
      Gathered& result = m_result[m_places[k]];
      const std::uint32_t samples = n * kReplicates;
      const double share = samples / static_cast<double>(before.samples + samples);
      LightSum sum;
      for (std::uint32_t r = 0; r < kReplicates; ++r) sum += state.sumOf(r, worth);
      // Not below what the last step's would be at the rate of an edge seen by stratified samples (Mitchell 1996): a
      // few replicates agree by chance, and are asked often.
      const double scatter = errorOf(state.squaredError, all);
      const double error = std::max(scatter, state.scatter * std::pow(state.counted / counted, 0.75));
      state.scatter = n > unguided ? scatter : 0; // the guide may have helped by more
      state.counted = counted;
      result.light = before.light.scaledBy(static_cast<float>(1 - share));
      result.light += sum.times(share / (counted * kReplicates));
      result.error = static_cast<float>(std::hypot(share * error, (1 - share) * before.error));
      result.samples = before.samples + samples;
      state.isDone = result.error <= m_options.error &&
                     share * errorOf(state.squaredErrorOfSh, allOfSh) <= kDirectionSlack * m_options.error;
    }
    m_active = static_cast<std::uint32_t>(std::ranges::count(m_states, false, &State::isDone));
  }

  const Surroundings& m_around;
  const GroupOptions& m_options;
  std::uint64_t& m_rays;
  std::vector<State> m_states;
  std::vector<std::size_t> m_places; // of each in the group
  std::optional<Directions> m_directions;
  std::uint32_t m_active = 0; // not done
  GatheredGroup m_result{};
};

} // namespace

GatheredGroup gatherGroup(const Surroundings& around, std::span<const GroupTexel> texels, const GroupOptions& options,
                          std::uint64_t& rays) {
  return Group(around, texels, options, rays).run();
}

} // namespace parity::bake
