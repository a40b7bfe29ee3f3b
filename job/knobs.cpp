#include "job/knobs.h"

#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/image/color.h"
#include "base/member_count.h"
#include "job/condition_text.h"
#include "job/paths.h"
#include "job/scene/view_rows.h"
#include "job/what_if.h"

namespace parity::job {

namespace {

using base::ActsOn, base::KnobStage, base::KnobTable, base::KnobType;
using S = Settings;

static_assert(base::memberCount<gpu::ShadowOptions>() == 3 && base::memberCount<reference::Options>() == 3 &&
                  base::memberCount<reference::IntegralOptions>() == 4 && base::memberCount<reference::Model>() == 2,
              "a new member needs a row");
// Without a row: budgets, which judge afterwards, and what is of the machine: device, cacheFolder, cacheBytes.
static_assert(base::memberCount<S>() == 27, "a new member needs a row, or a reason to have none");

constexpr int kMaxInterreflection = 64;

void setSize(S& s, const std::string& text) {
  const char* const end = text.data() + text.size();
  const auto [x, widthError] = std::from_chars(text.data(), end, s.width);
  const bool split = widthError == std::errc() && x != end && *x == 'x';
  const auto [tail, heightError] = std::from_chars(split ? x + 1 : end, end, s.height);
  if (!split || heightError != std::errc() || tail != end || std::min(s.width, s.height) < 1 ||
      std::max(s.width, s.height) > base::kMaxImageSide)
    throw base::KnobError{fmt::format("'{}' is not WIDTHxHEIGHT with sides of 1 to {}", text, base::kMaxImageSide)};
}

void setBackground(S& s, const std::string& text) {
  const auto n = base::readNumbers(text, "three numbers R,G,B");
  if (n[0] < 0 || n[1] < 0 || n[2] < 0)
    throw base::KnobError{fmt::format("'{}' is not a colour: no channel may be negative", text)};
  s.background = {n[0], n[1], n[2]};
}

void setMetrics(S& s, const std::string& text) {
  try {
    s.metrics = compare::parseMetricNames(text, "--metrics");
  } catch (const base::Error& error) {
    throw base::KnobError{error.place() + ": " + error.reason()};
  }
}

std::string metricNames() {
  std::vector<std::string> names;
  for (const compare::Metric& metric : compare::metricRegistry()) names.push_back(metric.name);
  return fmt::format("{}", fmt::join(names, ","));
}

void addPicture(KnobTable<S>& t) {
  t.section("Picture");
  t.special(KnobType::text, "size", "WIDTHxHEIGHT", "Size of the picture in pixels", setSize, [](const S& s) {
     return fmt::format("{}x{}", s.width, s.height);
   }).notInSuite();
  t.whole<&S::samples>("samples", 1, 64, "Samples per pixel").notInSuite();
  t.number<&S::filterWidth>("filter-width", 0.25, 2.5,
                            "Width of the box over which the samples of a pixel lie, pixels");
  t.number<&S::exposureEv>("exposure", -32, 32, "Exposure, EV").inWords([](const S& s) {
    return fmt::format("{} EV", s.exposureEv);
  });
  t.special(
       KnobType::choice, "display", "", "Display transform of the pictures",
       [](S& s, const std::string& text) {
         s.display = base::DisplayTransform::names()[base::readChoice(text, base::DisplayTransform::names())];
       },
       [](const S& s) { return s.display; })
      .notInSuite()
      .knob.choices = base::DisplayTransform::names();
  t.special(KnobType::numbers, "background", "R,G,B", "Colour behind the scene in every path, linear R,G,B",
            setBackground, [](const S& s) { return base::numbersText(&s.background.x, 3); })
      .notInSuite();
  t.texts<&S::materials>("material", "all", "Show only these materials (glob, repeatable)")
      .titled("materials")
      .actsOn(ActsOn::wholes)
      .notInSuite()
      .inWords([](const S& s) { return wordsOf(s.materials, "all"); });
}

void addShadows(KnobTable<S>& t) {
  using O = gpu::ShadowOptions;
  t.flag<&S::shadows>("shadows", "Lights cast shadows: paths use shadow maps, the truth uses rays.\n"
                                 "In the truth the environment casts shadows, too");
  std::vector<std::string> sizes;
  for (std::uint32_t size = gpu::kMinShadowMapSize; size <= gpu::kMaxShadowMapSize; size *= 2)
    sizes.push_back(std::to_string(size));
  t.oneOf<&S::shadowMaps, &O::mapSize>("shadow-map-size", sizes,
                                       "Side of a directional light's shadow map in texels. Spot lights use half,\n"
                                       "the faces of cube maps a quarter");
  t.oneOf<&S::shadowMaps, &O::filter>("shadow-filter", {"0", "1", "3", "5", "7"},
                                      "Width of the shadow filter in texels; 0: hard shadows from one texel");
  t.whole<&S::shadowMaps, &O::maxBytes>("shadow-memory", 0, 1e15, "Largest size of all shadow maps together in bytes")
      .titled("memory of shadow maps")
      .inWords([](const S& s) { return fmt::format("{} MiB at most", s.shadowMaps.maxBytes >> 20); })
      .noOption();
}

void setPaths(S& s, const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    names.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  const std::vector<std::string> known = pathNames();
  for (const std::string& name : names)
    if (std::ranges::count(known, name) == 0 || std::ranges::count(names, name) > 1)
      throw base::KnobError{
          fmt::format("'{}' is not a list of different paths; the paths are {}", text, fmt::join(known, ", "))};
  if (names.size() < 2)
    throw base::KnobError{fmt::format("'{}' names only one path: give at least two to compare", text)};
  s.pathNames = std::move(names);
}

void addPaths(KnobTable<S>& t) {
  t.section("Paths");
  addShadows(t);
  for (const paths::Path* path : allPaths()) t.addAll<&S::options>(path->knobs());
  t.section("Paths");
  t.choice<&S::specularAa>(
       "specular-aa", {"off", "toksvig"},
       "Specular anti-aliasing of normal maps in every path; toksvig turns lost detail into roughness")
      .titled("specular anti-aliasing")
      .inWords([](const S& s) { return s.specularAa == gpu::SpecularAa::toksvig ? "Toksvig" : "off"; });
  t.special(KnobType::text, "paths", "NAME,NAME", "Paths to compare: each of the others with the first", setPaths,
            [](const S& s) { return fmt::format("{}", fmt::join(s.pathNames, ",")); })
      .notInSuite();
  t.flag<&S::costs>("costs", "Also count operations, texture fetches and samplers of each specialised shader")
      .actsOn(ActsOn::nothing)
      .notInSuite();
}

// Which truth it is, in a sentence.
std::string describeTruth(const S& s) {
  if (!s.truth) return "off";
  const reference::Model& model = s.reference.model;
  const bool multiple = model.scattering == reference::Scattering::multiple;
  const bool correlated = model.surface.geometryTerm == reference::GeometryTerm::heightCorrelated;
  const int bounces = s.reference.bounces;
  return fmt::format(
      "exact integrals, {} scattering between microfacets{}, {}, {} Fresnel curve, {} diffuse lobe{}{}, to a standard "
      "error of {:.3g} %",
      multiple ? "multiple" : "single", multiple ? " (Kulla-Conty)" : "",
      correlated ? "height-correlated Smith" : "Schlick-Smith", knobs().find("fresnel")->text(s),
      knobs().find("diffuse")->text(s), s.shadows || bounces > 0 ? ", with shadows" : "",
      bounces > 0 ? fmt::format(", {} bounce{} between surfaces", bounces, bounces > 1 ? "s" : "") : "",
      100 * s.reference.integral.relativeError);
}

void addTruth(KnobTable<S>& t) {
  using O = reference::Options;
  using I = reference::IntegralOptions;
  t.section("Truth", {"truth"});
  t.flag<&S::truth>("truth", "Also compare all paths with the ground truth (exact integrals), term by term.\n"
                             "Slow; does not change verdicts")
      .alias("reference")
      .actsOn(ActsOn::truth)
      .inWords(describeTruth)
      .notInSuite();
  t.special(
       KnobType::text, "error", "SHARE",
       "Relative standard error at which the truth stops sampling a pixel, such as 0.5%",
       [](S& s, const std::string& text) { s.reference.integral.relativeError = base::readShare(text); },
       [](const S& s) { return base::numberText(s.reference.integral.relativeError); })
      .titled("error of the truth")
      .actsOn(ActsOn::truth)
      .otherwise("0.5%")
      .needs("truth");
  t.choice<&S::reference, &O::model, &reference::Model::scattering>(
       "scattering", {"multiple", "single"}, "Light between microfacets: multiple (Kulla-Conty) or single")
      .titled("scattering of the truth")
      .actsOn(ActsOn::truth)
      .needs("truth");
  t.whole<&S::reference, &O::bounces>("interreflection", 0, kMaxInterreflection,
                                      "Bounces of light between surfaces in the truth, with shadows; 0: none")
      .actsOn(ActsOn::truth)
      .needs("truth");
  t.whole<&S::reference, &O::integral, &I::minSamples>("truth-min-samples", 1, 1 << 30,
                                                       "Smallest number of samples a pixel")
      .actsOn(ActsOn::truth)
      .needs("truth")
      .noOption();
  t.whole<&S::reference, &O::integral, &I::maxSamples>("truth-max-samples", 1, 1 << 30,
                                                       "Largest number of samples a pixel")
      .actsOn(ActsOn::truth)
      .needs("truth")
      .noOption();
  t.whole<&S::reference, &O::integral, &I::seed>("truth-seed", 0, 4294967295.0, "Seed of the random samples")
      .actsOn(ActsOn::truth)
      .needs("truth")
      .noOption();
}

void addVerdict(KnobTable<S>& t) {
  t.section("Verdict");
  t.special(KnobType::text, "metrics", "LIST", "Metrics to report. All: " + metricNames(), setMetrics,
            [](const S& s) { return fmt::format("{}", fmt::join(s.metrics, ",")); })
      .actsOn(ActsOn::nothing)
      .notInSuite();
  t.choice<&S::attribution>("attribution", {kAttributionNames.begin(), kAttributionNames.end()},
                            "Name the term of light that makes a material differ, for these materials")
      .noCondition()
      .notInSuite();
  t.whole<&S::droppedLights>(
       "dropped-lights", 0, 100000,
       "Lights to measure in each view among those that a path drops, the brightest first;\n0: none, and no dropped "
       "lobes of materials")
      .actsOn(ActsOn::nothing)
      .notInSuite();
  base::KnobRow<S>& whatIf =
      t.special(
           KnobType::texts, "what-if", "PRESET", "Also measure what this preset would give (repeatable, or a list)",
           [](S& s, const std::string& text) { setWhatIfs(s, {text}); }, whatIfText)
          .otherwise("none")
          .actsOn(ActsOn::nothing)
          .pinnedBy(pinnedWhatIfs)
          .notInSuite();
  whatIf.set = setWhatIfs;
  whatIf.knob.choices = presetsOfPaths();
  t.flag<&S::terms>("terms", "Also measure each term of the light: sun, sky, lights (diffuse and specular) and others")
      .actsOn(ActsOn::nothing)
      .notInSuite();
  t.flag<&S::coverage>("coverage", "Find the pixels of each material even if only one path is rendered")
      .actsOn(ActsOn::nothing)
      .noOption();
}

KnobTable<S> makeKnobs() {
  KnobTable<S> t;
  t.addAll<&S::scene>(scenes::sceneKnobs());
  addPicture(t);
  addPaths(t);
  addTruth(t);
  addVerdict(t);
  return t;
}

// With what other members decide.
Settings derived(Settings settings) {
  for (const paths::Path* path : allPaths())
    if (const shading::SurfaceModel* model = path->surfaceModel(settings.options)) {
      settings.reference.model.surface = *model;
      break;
    }
  settings.terms |= settings.truth || settings.attribution == Attribution::all;
  return settings;
}

bool isOn(const std::string& text) { return text != "off" && text != "none"; }

// What was given, and needs what is off.
void requireNeeds(const Settings& settings, const base::GivenKnobs& given) {
  for (const auto& [id, value] : given) {
    const base::Knob& knob = knobs().find(id)->knob;
    if (!isActive(knob, settings))
      throw base::Error(base::ExitCode::usage, value.where, "",
                        fmt::format("has no effect without {}", knob.needsKnob));
  }
}

} // namespace

const KnobTable<Settings>& knobs() {
  static const KnobTable<Settings> table = makeKnobs();
  return table;
}

const scenes::SuiteKnobs& suiteKnobs() {
  static const scenes::SuiteKnobs all = [] {
    scenes::SuiteKnobs s;
    for (const auto& row : knobs().rows())
      if (row.knob.inSuite) s.knobs.push_back(row.knob);
    s.check = [](const base::Knob& knob, const base::KnobValue& value) {
      Settings scratch;
      knobs().find(knob.id)->set(scratch, value);
    };
    return s;
  }();
  return all;
}

base::GivenKnobs withPinnedFolders(base::GivenKnobs given, const Settings& settings) {
  for (const base::KnobRow<Settings>& row : knobs().rows()) {
    const auto found = given.find(row.knob.id);
    if (found != given.end() && row.pinned) found->second.value = {row.pinned(settings)};
  }
  return given;
}

bool isActive(const base::Knob& knob, const Settings& settings) {
  return knob.needsKnob.empty() || isOn(knobs().find(knob.needsKnob)->text(settings));
}

Settings withKnobs(Settings settings, const base::GivenKnobs& given) {
  const Settings plain = settings;
  knobs().apply(settings, given);
  settings = derived(settings);
  deriveWhatIfs(settings, plain, given);
  requireWhatIfs(settings);
  for (const paths::Path* path : allPaths()) path->requireSense(settings.options, settings.display);
  const paths::Path& first = pathByName(settings.pathNames.front());
  if (const auto target = first.target(settings.options, {}, 0); target && target->isDisplayed())
    throw base::Error(
        base::ExitCode::usage, "--paths", "",
        fmt::format(
            "'{}' comes first, but its target '{}' clips light above white; the first path needs a target that holds "
            "light above white",
            first.name(), first.targetName(settings.options)));
  return settings;
}

Settings defaultsOf(const base::GivenKnobs& ofSuite, const Settings& settings, const base::GivenKnobs& commandLine) {
  Settings all = settings;
  const base::GivenKnobs given = base::merged(ofSuite, commandLine);
  knobs().apply(all, given); // a scene may say what makes it go together
  deriveWhatIfs(all, settings, given);
  return derived(all);
}

std::vector<SceneRequest> requestsOf(const scenes::Suite& suite, const Settings& settings,
                                     const base::GivenKnobs& commandLine) {
  std::vector<SceneRequest> requests;
  for (const scenes::SuiteEntry& entry : suite.entries) {
    SceneRequest& request =
        requests.emplace_back(SceneRequest{entry.name, entry.scene, {}, entry.captures, entry.views, entry.budgets});
    request.tags = entry.tags;
    request.externals = entry.externals;
    try {
      const base::GivenKnobs defaults = base::merged(suite.given, entry.defaults);
      request.given = base::merged(base::merged(defaults, commandLine), entry.given);
      request.settings = withKnobs(settings, request.given);
      requireNeeds(request.settings, entry.given);
      requireExternals(request);
    } catch (const base::Error& error) {
      throw base::Error(base::ExitCode::failed, fmt::format("scene '{}'", entry.name), error.subject(), error.reason());
    }
  }
  return requests;
}

} // namespace parity::job
