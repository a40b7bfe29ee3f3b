#include "gpu/surface/shading_pass.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <span>

#include "shading/shading.h"
#include "shading/terms.h"

namespace parity::gpu {

namespace {

constexpr auto kCompute = vk::ShaderStageFlagBits::eCompute;
constexpr std::size_t kConstantTerms = 6; // kWriteTerms of path.glsl: the place in constantsOf

struct Push {
  std::uint32_t first = 0, count = 0, planeSize = 0, firstGroup = 0;
};

DeviceImage makeBlackCube(const Device& device) {
  const std::vector<std::uint8_t> black(6 * 4, 0);
  const std::span<const std::byte> mip = std::as_bytes(std::span{black});
  return DeviceImage(device, {.width = 1, .height = 1, .mips = 1, .cube = true}, std::span{&mip, 1});
}

DeviceImage makeWhite(const Device& device, bool array = false) {
  const std::vector<std::uint8_t> white(4, 255);
  const std::span<const std::byte> mip = std::as_bytes(std::span{white});
  return DeviceImage(device, {.width = 1, .height = 1, .mips = 1, .array = array}, std::span{&mip, 1});
}

// Of pictures of this size, where none was rendered.
Backdrop makeNothingBehind(const Device& device, std::uint32_t width, std::uint32_t height) {
  return BackdropBuilder(standInSide(width), standInSide(height), 1).take(device);
}

vk::raii::Sampler makeLinearClamp(const Device& device) {
  vk::SamplerCreateInfo info({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear);
  info.addressModeU = info.addressModeV = info.addressModeW = vk::SamplerAddressMode::eClampToEdge;
  info.maxLod = VK_LOD_CLAMP_NONE;
  return vk::raii::Sampler(device.handle(), info);
}

std::vector<MaterialClass> classesOf(const std::vector<BinKind>& kinds) {
  std::set<MaterialClass> classes;
  for (const BinKind& kind : kinds) classes.insert(kind.materialClass);
  return {classes.begin(), classes.end()};
}

Textures::Need needOf(const BinKind& kind) { return {kind.textureSet, kind.materialClass.textures}; }

} // namespace

std::vector<Textures::Need> texturesOf(std::span<const Bin> bins, std::span<const BinKind> kinds) {
  std::vector<Textures::Need> needs;
  for (const Bin& bin : bins) needs.push_back(needOf(kinds[bin.key]));
  return needs;
}

std::vector<std::uint32_t> CompiledPermutation::constantsWithoutTerms() const {
  std::vector<std::uint32_t> all = constants;
  all.at(kConstantTerms) = 0;
  return all;
}

GpuLight packLight(const scenes::Light& light, const ShadowOfLight& shadow) {
  GpuLight out;
  const std::uint32_t kind = light.kind == scenes::LightKind::directional ? kLightDirectional
                             : light.kind == scenes::LightKind::point     ? kLightPoint
                                                                          : kLightSpot;
  out.colorRange = vec4(light.color, light.range);
  out.positionKind = vec4(light.position, static_cast<float>(kind));
  out.directionCosOuter = vec4(light.direction, std::cos(light.outerConeAngle));
  out.cone = vec4(std::cos(light.innerConeAngle), light.specularScale,
                  shadow.count > 0 ? static_cast<float>(shadow.first + 1) : 0.f, static_cast<float>(shadow.count));
  out.falloff = vec4(static_cast<float>(light.falloff), light.falloffExponent, 0, 0);
  return out;
}

std::uint32_t falloffsOf(std::span<const scenes::Light> lights) {
  std::uint32_t falloffs = 0;
  for (const scenes::Light& light : lights)
    if (light.kind != scenes::LightKind::directional) falloffs |= 1u << static_cast<std::uint32_t>(light.falloff);
  return falloffs;
}

namespace {

// The shader is given the enumerators' numbers.
constexpr bool is(scenes::Falloff falloff, int number) { return static_cast<int>(falloff) == number; }
static_assert(is(scenes::Falloff::khr, shading::f32::kFalloffKhr) &&
              is(scenes::Falloff::ue4, shading::f32::kFalloffUE4) &&
              is(scenes::Falloff::exponent, shading::f32::kFalloffExponent));

std::array<std::uint32_t, 4> countsOf(const SceneBuffers& scene, const PathProgram& program) {
  return {program.directionalCount, program.localCount, program.environment ? 1u : 0u, scene.vertexData()};
}

// Binding 4: the scene's counts (path.glsl), then the path's own data.
std::vector<std::uint32_t> withCounts(const SceneBuffers& scene, const PathProgram& program) {
  const auto counts = countsOf(scene, program);
  std::vector<std::uint32_t> data(counts.begin(), counts.end());
  data.insert(data.end(), program.pathData.begin(), program.pathData.end());
  return data;
}

} // namespace

struct ShadingPass::Impl {
  const Device& device;
  const SceneBuffers& scene;
  std::vector<BinKind> kinds;
  PathProgram program;
  DeviceImage blackCube, white, whiteArray;
  const Backdrop* backdrop = nullptr;
  std::optional<Backdrop> nothingBehind; // made when the size of the pictures is known
  vk::raii::Sampler linearClamp;
  Buffer view, lights, pathData, nothing, nothingUniform;
  Buffer materials; // without program.hiddenFeatures; empty where they are left to the shader
  vk::raii::DescriptorSetLayout textureLayout{nullptr}, surfaceLayout{nullptr};
  std::vector<std::unique_ptr<DescriptorSets>> textureSets; // of each kind of bin that was seen
  vk::raii::PipelineLayout layout{nullptr};
  bool shadesLobes;
  std::shared_ptr<PermutationPlan> plan;
  std::vector<CompiledPermutation> compiled;
  std::vector<vk::Pipeline> pipelines; // of those, in the store
  std::size_t pictures = 0;            // that lack a light now, of program.leftOut
  PipelineStore ownStore;
  PipelineStore& store;

  Impl(const Device& dev, const SceneBuffers& buffers, const std::vector<BinKind>& binKinds, PathProgram p)
      : device(dev), scene(buffers), kinds(binKinds), program(std::move(p)), blackCube(makeBlackCube(dev)),
        white(makeWhite(dev)), whiteArray(makeWhite(dev, true)), linearClamp(makeLinearClamp(dev)),
        view(dev, sizeof(GpuView)), lights(dev, std::span<const GpuLight>(program.lights)),
        pathData(dev, std::span<const std::uint32_t>(withCounts(buffers, program))), nothing(dev, 0),
        nothingUniform(dev, std::span<const std::byte>(std::vector<std::byte>(kLargestUniform))),
        shadesLobes(buffers.hasLobes() && !program.spirvOfLobes.empty()),
        plan(program.compilation.plan
                 ? program.compilation.plan
                 : std::make_shared<PermutationPlan>(shadesLobes ? program.compilation.budget.withLobes()
                                                                 : program.compilation.budget,
                                                     buffers.textureBits(), classesOf(kinds))),
        store(program.compilation.store ? *program.compilation.store : ownStore) {
    if (shadesLobes) program.spirv = program.spirvOfLobes;
    if (hidesAtRunTime()) materials = scene.materialsWithout(device, program.hiddenFeatures);
    const auto none = textures().bindings({});
    textureLayout = makeSetLayout(device, std::vector<Binding>(none.begin(), none.end()), kCompute);
    textureSets.resize(kinds.size());
  }

  bool mayWriteTerms() const { return program.terms || program.compilation.planWritesTerms; }
  bool hidesAtRunTime() const { return program.hiddenFeatures != 0 && program.compilation.plan; }
  // That its shader leaves out.
  std::uint32_t hiddenIn(const Permutation& permutation) const {
    const bool atRunTime = hidesAtRunTime() && (permutation.mustFeatures & program.hiddenFeatures) == 0;
    return atRunTime ? 0 : program.hiddenFeatures;
  }

  const Textures& textures() const { return program.textures ? *program.textures : scene.textures(); }

  // Textures of the bins' materials, and of no others.
  void bindTextures(const Surface& surface) {
    textures().require(texturesOf(surface.bins, kinds));
    for (const Bin& bin : surface.bins) {
      if (textureSets[bin.key]) continue;
      const auto infos = textures().bindings(needOf(kinds[bin.key]));
      const std::vector<Binding> bindings(infos.begin(), infos.end());
      textureSets[bin.key] = std::make_unique<DescriptorSets>(device, textureLayout, std::span(&bindings, 1));
    }
  }

  std::vector<Binding> surfaceBindings(const Surface& s, const Buffer& data, const Buffer& color, const Buffer& termsA,
                                       const Buffer& termsB) const {
    std::vector<Binding> bindings = {uniform(view), storage(hidesAtRunTime() ? materials : scene.materials),
                                     storage(scene.instances), storage(lights), storage(data)};
    for (const Buffer* buffer : {&s.position, &s.normal, &s.tangent, &s.uv, &s.uv0Derivatives, &s.uv1Derivatives,
                                 &s.color, &s.fog, &s.lightmap, &color, &termsA, &termsB})
      bindings.push_back(storage(*buffer));
    const EnvironmentMaps* sky = program.environment;
    const vk::DescriptorImageInfo noSky(*linearClamp, blackCube.view(), kReadOnlyLayout);
    bindings.push_back(sky ? vk::DescriptorImageInfo(*sky->sampler, sky->cube.view(), kReadOnlyLayout) : noSky);
    bindings.push_back(vk::DescriptorImageInfo(
        *linearClamp, program.pathTexture ? program.pathTexture->view() : white.view(), kReadOnlyLayout));
    bindings.push_back(program.shadows ? program.shadows->image()
                                       : vk::DescriptorImageInfo(*linearClamp, whiteArray.view(), kReadOnlyLayout));
    bindings.push_back(storage(program.shadows ? program.shadows->views() : nothing));
    const BakedMaps* baked = program.baked;
    const vk::DescriptorImageInfo noPages(*linearClamp, whiteArray.view(), kReadOnlyLayout);
    const auto pages = [&](std::uint32_t part, const DeviceImage& image) {
      return baked && (baked->parts & part) != 0 ? vk::DescriptorImageInfo(*linearClamp, image.view(), kReadOnlyLayout)
                                                 : noPages;
    };
    bindings.push_back(baked ? pages(kBakedLightmap, baked->lightmap) : noPages);
    bindings.push_back(baked ? pages(kBakedSunShadow, baked->sunShadow) : noPages);
    bindings.push_back(storage(baked ? baked->captures : nothing));
    bindings.push_back(storage(baked ? baked->scales : nothing));
    bindings.push_back(sky && sky->irradiance
                           ? vk::DescriptorImageInfo(*linearClamp, sky->irradiance->view(), kReadOnlyLayout)
                           : noSky);
    bindings.push_back(vk::DescriptorImageInfo(
        *linearClamp, sky && sky->panorama ? sky->panorama->view() : white.view(), kReadOnlyLayout));
    bindings.push_back(uniform(sky && sky->lamps ? *sky->lamps : nothingUniform));
    bindings.push_back(uniform(sky && sky->points ? *sky->points : nothingUniform));
    bindings.push_back(
        vk::DescriptorImageInfo(*linearClamp, (backdrop ? *backdrop : *nothingBehind).image().view(), kReadOnlyLayout));
    return bindings;
  }

  // For the classes that these layers are the first to show, scaled to what the whole run will shade: the largest layer
  // is taken to fill all of its pictures.
  void planFor(std::span<const std::vector<Bin>> layers) {
    std::map<MaterialClass, std::uint64_t> pixels;
    std::uint64_t largest = 1;
    for (const std::vector<Bin>& bins : layers) {
      std::uint64_t size = 0;
      for (const Bin& bin : bins) {
        size += bin.count;
        if (const MaterialClass& c = kinds[bin.key].materialClass; !plan->has(c)) pixels[c] += bin.count;
      }
      largest = std::max(largest, size);
    }
    const double scale = std::max(1.0, static_cast<double>(program.expectedPixels) / static_cast<double>(largest));
    std::vector<ClassPixels> classes;
    for (const auto& [c, count] : pixels)
      classes.push_back({c, static_cast<std::uint64_t>(static_cast<double>(count) * scale)});
    plan->add(std::move(classes));
  }

  // A bit for each term that some pixel may have: the shader writes no others.
  std::uint32_t termsToWrite(bool any) const {
    if (!program.termsFollowLight) return ~0u;
    std::uint32_t terms = (1u << shading::kTermCount) - 1;
    if (any || program.baked) return terms;
    using shading::Term;
    const auto remove = [&](std::initializer_list<Term> absent) {
      for (const Term term : absent) terms &= ~(1u << static_cast<std::uint32_t>(term));
    };
    remove({Term::lightmap});
    if (program.directionalCount == 0) remove({Term::sunDiffuse, Term::sunSpecular});
    if (program.localCount == 0 && !program.listLights) remove({Term::localDiffuse, Term::localSpecular});
    if (!program.environment) remove({Term::skyDiffuse, Term::skySpecular});
    if ((scene.vertexData() & kVertexFog) == 0) remove({Term::fog});
    return terms;
  }

  std::vector<std::uint32_t> constantsOf(const Permutation& permutation) const {
    const bool any = permutation.everyScene || program.asksForCounts;
    const std::uint32_t vertexData = scene.vertexData(), hidden = hiddenIn(permutation);
    const bool writesTerms = hidden == 0 ? mayWriteTerms() : program.terms; // another shader than the plan's
    std::vector<std::uint32_t> constants = {permutation.textures,
                                            permutation.mayFeatures & ~hidden,
                                            permutation.mustFeatures & ~hidden,
                                            any ? kUnknown : program.directionalCount,
                                            any                  ? kUnknown
                                            : program.listLights ? kListed
                                                                 : program.localCount,
                                            any                   ? kUnknown
                                            : program.environment ? 1u
                                                                  : 0u,
                                            writesTerms ? termsToWrite(any) : 0,
                                            any ? kVertexAll : vertexData | vertexData << kVertexMustShift};
    const auto& own = permutation.everyScene && !program.everySceneConstants.empty() ? program.everySceneConstants
                                                                                     : program.constants;
    constants.insert(constants.end(), own.begin(), own.end());
    return constants;
  }

  // entries: that it shades.
  vk::Pipeline pipelineFor(const MaterialClass& c, std::uint32_t entries) {
    const Permutation permutation = plan->of(c);
    const auto found =
        std::ranges::find(compiled, permutation, [](const CompiledPermutation& each) { return each.permutation; });
    if (found != compiled.end()) {
      found->entries += entries;
      return pipelines[static_cast<std::size_t>(found - compiled.begin())];
    }
    const std::vector<std::uint32_t> constants = constantsOf(permutation);
    vk::Pipeline pipeline = store.find(program.spirv, constants);
    if (!pipeline) {
      const base::Stopwatch watch(device.timings(), "compile " + program.name);
      pipeline = store.add(program.spirv, constants, makeComputePipeline(device, layout, program.spirv, constants));
    }
    pipelines.push_back(pipeline);
    compiled.push_back({permutation, constants, entries});
    return pipeline;
  }

  // runs: else nothing but compiled; the result is empty.
  ShadedSurface shade(const Surface& surface, const scenes::Camera& camera, bool runs);
};

// The plane at this place of a buffer, of n values: in place where the host can read the device's memory.
static ShadedPlane planeOf(const std::shared_ptr<const Buffer>& buffer, std::size_t n, std::size_t place) {
  const vk::DeviceSize offset = place * n * sizeof(glm::vec4);
  if (const std::span<const glm::vec4> values = buffer->mappedAs<glm::vec4>(n, offset); !values.empty())
    return {buffer, values};
  return buffer->downloadAs<glm::vec4>(n, offset);
}

ShadedSurface ShadingPass::Impl::shade(const Surface& surface, const scenes::Camera& camera, bool runs) {
  ShadedSurface result;
  result.premultiplied = program.premultiplied;
  const std::size_t n = surface.size();
  if (program.terms) result.terms.resize(shadesLobes ? program.planesOfLobes : scene.termCount());
  if (program.leftOut != 0) result.terms.resize(pictures);
  if (n == 0) return result;

  GpuView gpuView = makeView(scene.scene(), camera, surface.width, surface.height);
  std::copy(program.numbers.begin(), program.numbers.end(), gpuView.path);
  view.upload(std::as_bytes(std::span{&gpuView, 1}));

  const std::size_t written = program.leftOut != 0 ? program.leftOut
                              : !mayWriteTerms()   ? 0
                              : shadesLobes        ? program.planesOfLobes
                                                   : shading::kBaseTermCount;
  const std::size_t inA = std::min<std::size_t>(written, kTermsInA);
  const vk::DeviceSize plane = (runs ? n : 1) * sizeof(glm::vec4);
  const auto makePlanes = [&](std::size_t count) { return std::make_shared<const Buffer>(device, count * plane); };
  const auto color = makePlanes(program.leftOut == 0 ? 1 : 0), termsA = makePlanes(inA),
             termsB = makePlanes(written - inA);
  const bool hasLists = program.listLights && runs;
  const Buffer lists = hasLists ? program.listLights(surface, countsOf(scene, program)) : Buffer();
  if (!backdrop && !nothingBehind) nothingBehind = makeNothingBehind(device, surface.width, surface.height);
  const std::vector<Binding> bindings = surfaceBindings(surface, hasLists ? lists : pathData, *color, *termsA, *termsB);
  if (!*surfaceLayout) {
    surfaceLayout = makeSetLayout(device, bindings, kCompute);
    layout = makePipelineLayout(device, std::array{*surfaceLayout, *textureLayout}, sizeof(Push), kCompute);
  }
  planFor({&surface.bins, 1});
  bindTextures(surface);
  const DescriptorSets set(device, surfaceLayout, std::span(&bindings, 1));

  device.submit((runs ? "shade " : "compile ") + program.name, [&](const vk::raii::CommandBuffer& commands) {
    std::uint32_t firstGroup = 0;
    for (const Bin& bin : surface.bins) {
      const BinKind& kind = kinds[bin.key];
      commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipelineFor(kind.materialClass, runs ? bin.count : 0));
      commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 0, {set[0], (*textureSets[bin.key])[0]},
                                  {});
      commands.pushConstants<Push>(*layout, kCompute, 0,
                                   Push{bin.first, bin.count, static_cast<std::uint32_t>(n), firstGroup});
      const std::uint32_t groups = (bin.count + kGroupSize - 1) / kGroupSize;
      firstGroup += groups;
      if (runs)
        commands.dispatch(std::min(groups, kMaxGroupsInRow), (groups + kMaxGroupsInRow - 1) / kMaxGroupsInRow, 1);
      else
        commands.dispatch(0, 0, 0); // a driver that compiles at the first dispatch does so for this one
    }
    fullBarrier(commands);
  });
  if (!runs) return {};
  if (program.leftOut == 0) result.color = planeOf(color, n, 0);
  // Shaders of every scene write more than this scene has: zeros.
  const std::uint32_t terms = program.leftOut != 0 ? ~0u : program.terms ? termsToWrite(false) : 0;
  for (std::size_t t = 0; t < result.terms.size(); ++t)
    result.terms[t] = t >= written || (terms >> t & 1u) == 0 ? ShadedPlane::zeros(n)
                      : t < kTermsInA                        ? planeOf(termsA, n, t)
                                                             : planeOf(termsB, n, t - kTermsInA);
  return result;
}

ShadingPass::ShadingPass(const Device& device, const SceneBuffers& scene, const std::vector<BinKind>& binKinds,
                         PathProgram program)
    : m_impl(std::make_unique<Impl>(device, scene, binKinds, std::move(program))) {}
ShadingPass::~ShadingPass() = default;
void ShadingPass::expect(std::span<const std::vector<Bin>> layers) const { m_impl->planFor(layers); }
ShadedSurface ShadingPass::shade(const Surface& surface, const scenes::Camera& camera) const {
  return m_impl->shade(surface, camera, true);
}
void ShadingPass::compile(const Surface& surface, const scenes::Camera& camera) const {
  m_impl->shade(surface, camera, false);
}
void ShadingPass::leaveOut(std::span<const std::size_t> lights) {
  std::vector<GpuLight> changed = m_impl->program.lights;
  const bool atOnce = m_impl->program.leftOut != 0;
  assert(lights.size() <= std::max<std::size_t>(m_impl->program.leftOut, 1));
  for (std::size_t k = 0; k < lights.size(); ++k)
    if (GpuLight& light = changed.at(lights[k]); atOnce)
      light.falloff.z = static_cast<float>(k + 1);
    else
      light.colorRange = vec4(0, 0, 0, light.colorRange.w);
  m_impl->pictures = atOnce ? lights.size() : 0;
  m_impl->lights.upload(std::as_bytes(std::span{changed}));
}
void ShadingPass::setBackdrop(const Backdrop* backdrop) { m_impl->backdrop = backdrop; }
std::vector<std::uint32_t> ShadingPass::exactConstants(const MaterialClass& c) const {
  return m_impl->constantsOf({c.textures, c.features, c.features});
}
const std::vector<CompiledPermutation>& ShadingPass::compiled() const { return m_impl->compiled; }
Spirv ShadingPass::spirv() const { return m_impl->program.spirv; }
std::shared_ptr<PermutationPlan> ShadingPass::plan() const { return m_impl->plan; }
std::uint32_t ShadingPass::directionalCount() const { return m_impl->program.directionalCount; }
std::uint32_t ShadingPass::localCount() const { return m_impl->program.localCount; }

} // namespace parity::gpu
