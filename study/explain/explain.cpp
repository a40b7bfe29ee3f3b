#include "study/explain/explain.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "base/stopwatch.h"
#include "base/text/glob.h"
#include "job/context.h"
#include "job/scene/scene_content.h"
#include "scenes/view.h"
#include "study/explain/advice.h"
#include "study/explain/asset.h"
#include "study/explain/illustration.h"
#include "study/explain/judged_by.h"
#include "study/explain/ranges.h"
#include "study/explain/set_renderer.h"

namespace parity::explain {

namespace {

using Program = SetRenderer::Program;

job::PathChoice pathsFor(const job::Settings& settings) {
  switchedPath(settings);
  job::PathChoice choice = job::pathsOf(settings);
  choice.truth = false;
  return choice;
}

// All sets of a material whose costs are counted.
auto setsOf(MaterialExplanation& material) { return std::array{&material.best, &material.alone, &material.cheaper}; }

class Explainer {
public:
  Explainer(job::Context& context, const job::SceneRequest& request, const ExplainWish& wish,
            const compare::Budgets& budgets, const job::Progress& progress)
      : m_request(request), m_wish(wish), m_budgets(budgets), m_progress(progress), m_context(context),
        m_paths(pathsFor(request.settings)), m_prepared(job::prepareScene(context, request, m_paths)),
        m_scene(context, m_prepared, m_prepared.settings, m_paths),
        m_renderer(context, m_prepared, m_scene, m_prepared.settings, m_paths,
                   scenes::makeCamera(m_prepared.scene, request.views.front(),
                                      static_cast<float>(request.settings.width) /
                                          static_cast<float>(request.settings.height))) {
    m_result.scene = request.name;
    m_result.environment = m_prepared.environmentName;
    m_result.view = request.views.front().name;
    m_result.sources = m_prepared.scene.sources;
    m_result.width = settings().width;
    m_result.height = settings().height;
  }

  SceneExplanation run() {
    chooseMaterials();
    m_today = m_renderer.flip(settings(), Program::wide, m_materials);
    chooseSwitches();
    renderSets();
    addCosts();
    findRanges();
    suggestAssets(m_renderer, settings(), m_prepared.scene, m_materials, m_result.materials,
                  [&](double done) { tell("trying changes of the asset", done); });
    advise();
    if (m_wish.illustrates)
      illustrate(m_renderer, m_prepared.scene, settings(), m_result.switches, m_materials, m_errors,
                 m_result.materials);
    return std::move(m_result);
  }

private:
  const job::Settings& settings() const { return m_prepared.settings; }
  std::size_t count() const { return m_result.switches.size(); }
  job::Settings turned(SwitchMask mask) const { return withSwitches(settings(), m_result.switches, mask); }

  void chooseMaterials() {
    const std::vector<base::PixelList>& coverage = m_renderer.coverage();
    for (std::size_t m = 0; m < coverage.size(); ++m) {
      const std::string& name = m_prepared.scene.materials[m].name;
      if (!isWanted(name) || coverage[m].pixels.empty()) continue;
      const JudgedBy by = judgedBy(m_budgets, m_request.name, name);
      if (coverage[m].pixels.size() < by.leastPixels) {
        m_result.tooSmall.push_back(name);
        continue;
      }
      m_materials.push_back(m);
      MaterialExplanation& material = m_result.materials.emplace_back();
      material.name = name;
      material.pixels = coverage[m].pixels.size();
      material.limit = by.limit;
    }
    if (m_materials.empty())
      throw base::Error(base::ExitCode::notComparable, m_request.scene, m_result.view,
                        "no chosen material is seen, or only too small");
  }

  bool isWanted(const std::string& name) const {
    if (!m_wish.materials.empty()) return std::ranges::count(m_wish.materials, name) > 0;
    const std::vector<std::string>& globs = settings().materials;
    return globs.empty() || std::ranges::any_of(globs, [&](const auto& glob) { return base::matchesGlob(glob, name); });
  }

  void chooseSwitches() {
    const std::vector<std::string>& given = m_wish.switches;
    const std::set<std::string> has = job::contentOf(m_prepared);
    std::vector<Switch> candidates;
    if (given.size() > kMaxSwitches)
      throw base::Error(base::ExitCode::usage, "--switch", fmt::format("{} of them", given.size()),
                        fmt::format("at most {} are tried together", kMaxSwitches));
    for (const std::string& text : given) candidates.push_back(parseSwitch(text, settings()));
    if (given.empty()) candidates = proposedSwitches(settings());
    std::erase_if(candidates, [&](const Switch& each) {
      if (has.contains(each.needs)) return false;
      if (!given.empty())
        throw base::Error(base::ExitCode::usage, "--switch", each.id(),
                          fmt::format("the scene '{}' has no {}", m_request.name, each.needs));
      m_result.skipped.push_back({each.id(), fmt::format("the scene has no {}", each.needs)});
      return true;
    });
    m_result.switches = given.empty() ? mostUseful(std::move(candidates)) : std::move(candidates);
    std::ranges::stable_partition(m_result.switches, [](const Switch& each) { return !each.cheapens; });
    for (SwitchMask mask = 0; mask < SwitchMask{1} << count(); ++mask)
      turned(mask); // what does not go together is refused now
  }

  // Each alone, and each left out of all that bring something nearer: those that change most of what can be gained.
  std::vector<Switch> mostUseful(std::vector<Switch> candidates) {
    const auto effects = [&](SwitchMask without, SwitchMask with) {
      const std::vector<double> a = flipOf(candidates, without), b = flipOf(candidates, with);
      double most = 0;
      for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, a[i] - b[i]);
      return most;
    };
    SwitchMask nearer = 0;
    std::vector<double> use(candidates.size(), 0);
    std::map<std::size_t, std::string> failures; // of candidates that this scene cannot have
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      tell("trying switches alone", i, 2 * candidates.size());
      const SwitchMask bit = SwitchMask{1} << i;
      try {
        use[i] = effects(0, bit);
      } catch (const base::Error& error) {
        failures[i] = error.reason();
        continue;
      }
      if (candidates[i].cheapens)
        use[i] = harmlessOf(flipOf(candidates, bit));
      else
        nearer |= bit;
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      tell("leaving switches out", candidates.size() + i, 2 * candidates.size());
      if (!candidates[i].cheapens && !failures.contains(i))
        use[i] = std::max(use[i], effects(nearer & ~(SwitchMask{1} << i), nearer));
    }
    std::vector<std::size_t> order(candidates.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return use[i]; });
    std::set<std::size_t> kept;
    for (const std::size_t i : order)
      if (use[i] >= kLeastEffect && kept.size() < kMaxSwitches)
        kept.insert(i);
      else
        m_result.skipped.push_back({candidates[i].id(), failures.contains(i) ? failures[i]
                                                        : use[i] < kLeastEffect
                                                            ? fmt::format("helps no material by {:g}", kLeastEffect)
                                                            : fmt::format("{} others help more", kMaxSwitches)});
    std::vector<Switch> chosen;
    for (const std::size_t i : kept) chosen.push_back(candidates[i]);
    return chosen;
  }

  // How far below the rise that is accepted for a cheaper shader the override stays on some material; at most 0:
  // nowhere.
  double harmlessOf(const std::vector<double>& flip) const {
    double most = 0;
    for (std::size_t i = 0; i < flip.size(); ++i) most = std::max(most, m_today[i] + kHarmless - flip[i]);
    return most;
  }

  // Of sets of candidates; each is rendered once.
  std::vector<double> flipOf(const std::vector<Switch>& candidates, SwitchMask mask) {
    const auto [found, isNew] = m_tried.try_emplace(mask);
    if (isNew) found->second = m_renderer.flip(withSwitches(settings(), candidates, mask), Program::wide, m_materials);
    return found->second;
  }

  void renderSets() {
    m_tried.clear();
    const base::Stopwatch watch(nullptr, "");
    const SwitchMask sets = SwitchMask{1} << count();
    // Sets that differ in one format of storage alone follow each other: those are shaded once.
    SwitchMask stored = 0;
    for (std::size_t i = 0; i < count(); ++i)
      if (m_renderer.onlyStores(settings(), turned(SwitchMask{1} << i))) stored = SwitchMask{1} << i;
    std::vector<SwitchMask> order;
    for (SwitchMask mask = 0; mask < sets; ++mask)
      if ((mask & stored) == 0) {
        order.push_back(mask);
        if (stored != 0) order.push_back(mask | stored);
      }
    for (MaterialExplanation& material : m_result.materials) material.flip.resize(sets);
    for (std::size_t k = 0; k < order.size(); ++k) {
      tell("rendering sets", k, order.size());
      const std::vector<double> flip = m_renderer.flip(turned(order[k]), Program::wide, m_materials);
      for (std::size_t i = 0; i < flip.size(); ++i) m_result.materials[i].flip[order[k]] = flip[i];
    }
    m_result.seconds = watch.elapsedMs() / 1000;
    const auto nearer = static_cast<std::size_t>(std::ranges::count(m_result.switches, false, &Switch::cheapens));
    for (MaterialExplanation& material : m_result.materials) {
      const auto outcomeOf = [&](SwitchMask mask) { return SetOutcome{mask, material.flip[mask], {}, {}}; };
      const std::span<const double> values = std::span(material.flip).first(std::size_t{1} << nearer);
      for (const SwitchMask mask : bestOfEachSize(values, nearer)) material.best.push_back(outcomeOf(mask));
      for (std::size_t i = 0; i < count(); ++i) material.alone.push_back(outcomeOf(SwitchMask{1} << i));
      material.worth = shapleyValues(values, nearer);
      material.changing = changesSign(values, nearer, kLeastEffect);
      material.repair = chooseRepair(material);
      for (std::size_t i = nearer; i < count(); ++i)
        material.cheaper.push_back(outcomeOf(material.repair | SwitchMask{1} << i));
    }
  }

  void addCosts() {
    std::map<SwitchMask, std::vector<std::size_t>> wanted; // places in m_materials
    for (std::size_t i = 0; i < m_result.materials.size(); ++i)
      for (const auto* sets : setsOf(m_result.materials[i]))
        for (const SetOutcome& set : *sets)
          if (std::vector<std::size_t>& all = wanted[set.mask]; all.empty() || all.back() != i) all.push_back(i);
    tell("counting operations", 0, 1);
    std::vector<SetRenderer::CostRequest> requests;
    for (const auto& [mask, places] : wanted) {
      SetRenderer::CostRequest& request = requests.emplace_back(turned(mask));
      for (const std::size_t i : places) request.materials.push_back(m_materials[i]);
    }
    const std::vector<std::vector<Cost>> costs = m_renderer.costs(requests);
    std::size_t request = 0;
    for (const auto& [mask, places] : wanted) {
      for (std::size_t k = 0; k < places.size(); ++k)
        for (auto* sets : setsOf(m_result.materials[places[k]]))
          for (SetOutcome& set : *sets)
            if (set.mask == mask) set.cost = costs[request][k];
      ++request;
    }
  }

  void findRanges() {
    m_errors = m_renderer.flipMaps(settings(), m_materials);
    for (const auto& [view, quantity] :
         {std::pair{"Roughness", "roughness"}, {"Metallic", "metallic"}, {"NoV", "N.V"}}) {
      const std::optional<base::Image> values = m_renderer.intermediate(settings(), view);
      if (!values) continue;
      for (std::size_t i = 0; i < m_materials.size(); ++i) {
        std::vector<RangeShare> shares =
            sharesOf(quantity, m_renderer.coverage()[m_materials[i]], *values, m_errors[i]);
        std::ranges::move(shares, std::back_inserter(m_result.materials[i].ranges));
      }
    }
  }

  // What is said is rendered by the programs that an engine would have: set by set, once for all materials.
  void advise() {
    std::vector<std::vector<SwitchMask>> all;
    std::map<SwitchMask, std::vector<double>> rendered;
    for (const MaterialExplanation& material : m_result.materials) {
      all.push_back(chooseAdvice(material));
      for (const SwitchMask mask : all.back()) rendered[mask];
    }
    std::size_t done = 0;
    for (auto& [mask, flip] : rendered) {
      tell("rendering the advice again", done++, rendered.size());
      flip = m_renderer.flip(turned(mask), Program::specialised, m_materials);
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      MaterialExplanation& material = m_result.materials[i];
      for (auto* sets : setsOf(material))
        for (SetOutcome& set : *sets)
          if (std::ranges::count(all[i], set.mask) > 0) set.rendered = rendered[set.mask][i];
      material.advice = sentencesOf(material, m_result.switches);
    }
  }

  void tell(const char* what, std::size_t done, std::size_t of) const {
    tell(what, static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(of, 1)));
  }
  void tell(const char* what, double done) const {
    m_context.requireGoesOn();
    if (m_progress) m_progress(m_request.name + ": " + what, done);
  }

  const job::SceneRequest& m_request;
  const ExplainWish& m_wish;
  const compare::Budgets& m_budgets;
  const job::Progress& m_progress;
  job::Context& m_context;
  job::PathChoice m_paths;
  job::PreparedScene m_prepared;
  job::SceneOnDevice m_scene;
  SetRenderer m_renderer;
  std::vector<std::size_t> m_materials; // those of the result, in the scene
  std::vector<double> m_today;
  std::vector<std::vector<float>> m_errors; // FLIP of their pixels today
  std::map<SwitchMask, std::vector<double>> m_tried;
  SceneExplanation m_result;
};

} // namespace

SceneExplanation explainScene(job::Context& context, const job::SceneRequest& request, const ExplainWish& wish,
                              const compare::Budgets& budgets, const job::Progress& progress) {
  return Explainer(context, request, wish, budgets, progress).run();
}

} // namespace parity::explain
