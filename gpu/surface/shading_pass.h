// One path's shader run over a surface, bin by bin: what highend/ and mobile/ are built on.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/device/pipeline.h"
#include "gpu/shadows/shadow_maps.h"
#include "gpu/surface/backdrop.h"
#include "gpu/surface/baked_maps.h"
#include "gpu/surface/permutations.h"
#include "gpu/surface/shaded_plane.h"
#include "gpu/surface/surface_pass.h"
#include "shading/terms.h"

namespace parity::gpu {

// The prefiltered cube on the device with its sampler, and the irradiance that goes with it: SH and the numbers of
// TintedSky (as kPathSkySh of gpu/shaders/interface.h has them), or a cube of irradiance over pi (an array of one), as
// the path reads it. With baked captures (BakedMaps) the cubes of one after another, in their order, and the irradiance
// of the sky, for what has no lightmap.
struct EnvironmentMaps {
  DeviceImage cube;
  vk::raii::Sampler sampler{nullptr};
  std::array<glm::vec4, 9> sh{};
  std::optional<DeviceImage> irradiance{};
  std::array<glm::vec4, kTintedSkyNumbers> tintedSky{};
  // The panorama's cells (lighting/environment/panorama_cells.h), where the cube has fine levels to go with them.
  std::optional<DeviceImage> panorama = std::nullopt;
  float panoramaTurns = 0;
  std::optional<Buffer> lamps = std::nullopt;  // kMaxLamps of GpuLamp, as path.glsl has them
  std::optional<Buffer> points = std::nullopt; // kEnvironmentPoints of GpuEnvironmentPoint: for scenes with sheen
};

// What a scene may compile, and what its run has compiled already.
struct Compilation {
  PermutationBudget budget;
  PipelineStore* store = nullptr;                  // of the run; null: the pass has its own
  std::shared_ptr<PermutationPlan> plan = nullptr; // of another pass of the scene and path; null: a new one
  bool planWritesTerms = false; // that pass has terms: its shaders are taken also where this one has none
};

// What a path brings along. Referenced objects must outlive the pass.
struct PathProgram {
  std::string name; // for timings
  Spirv spirv;
  Spirv spirvOfLobes =
      {}; // for scenes with kFeatureLobes (PARITY_LOBES of path.glsl); empty: the path has none of them
  std::vector<GpuLight> lights;       // directional ones first
  std::uint32_t directionalCount = 0; // lights the shader loops over; constants 3 and 4
  std::uint32_t localCount = 0;
  std::vector<std::uint32_t> pathData; // binding 4, behind the counts
  // Instead of pathData where it is set: makes binding 4 for a surface, given the four counts that it begins with.
  // Local lights are listed there for each group of kGroupSize entries of a bin.
  std::function<Buffer(const Surface&, const std::array<std::uint32_t, 4>&)> listLights;
  const Textures* textures = nullptr;            // the materials', as the path stores them; null: the scene's
  const DeviceImage* pathTexture = nullptr;      // binding 18; null: white
  const EnvironmentMaps* environment = nullptr;  // bindings 17, 25 to 27; null: no environment
  const ShadowMaps* shadows = nullptr;           // bindings 19 and 20; null: none
  const BakedMaps* baked = nullptr;              // bindings 21 to 24; null: none
  std::array<glm::vec4, kPathNumbers> numbers{}; // the path's own, GpuView::path
  std::vector<std::uint32_t> constants;          // the path's own specialization constants, from kConstantPath
  // kFeature... bits that materials are shaded without. If `compilation` has the plan of another pass, that pass's
  // shaders are taken, and the materials lack the features at run time. Shaders without them are made where there is no
  // such plan, and where all materials of a permutation have one of them.
  std::uint32_t hiddenFeatures = 0;
  std::vector<std::uint32_t> everySceneConstants; // in place of those in permutations of every scene; empty: the same
  bool asksForCounts = false; // at run time, as permutations of every scene do: for lights, environment and vertex data
  bool terms = false;
  // The shader's terms of light are 0 where directionalCount, localCount with listLights, environment, baked, or the
  // scene's fog is none: it need not write them. False: it may write any values in their planes.
  bool termsFollowLight = false;
  std::size_t leftOut = 0; // at most kMaxLeftOut; not 0: so many pictures, each without a light, in place of the terms
  std::size_t planesOfLobes = shading::kTermCount; // that spirvOfLobes writes where it writes terms
  bool premultiplied = false;                      // the shader multiplies colour and terms by the opacity
  std::uint64_t expectedPixels = 0; // that this run will shade by this path: decides what is worth compiling
  Compilation compilation;
};

// Per entry of a surface, in its order.
struct ShadedSurface {
  ShadedPlane color;              // radiance, opacity; empty where lights are left out
  std::vector<ShadedPlane> terms; // SceneBuffers::termCount() planes, or none; or pictures, as `color`
  bool premultiplied = false;     // radiance and terms are times the opacity already
};

// A permutation that was needed, and for how much.
struct CompiledPermutation {
  Permutation permutation;
  std::vector<std::uint32_t> constants; // all specialization constants, from 0
  std::uint64_t entries = 0;            // of surfaces, shaded by it

  // Those of the shader that writes no terms: what an engine would run.
  std::vector<std::uint32_t> constantsWithoutTerms() const;
};

class ShadingPass {
public:
  ShadingPass(const Device& device, const SceneBuffers& scene, const std::vector<BinKind>& binKinds,
              PathProgram program);
  ~ShadingPass();

  // Plans for the bins of several layers together. If each is planned when it is shaded, more permutations are needed.
  void expect(std::span<const std::vector<Bin>> layers) const;
  ShadedSurface shade(const Surface& surface, const scenes::Camera& camera) const;
  // Has the driver compile what shade() would run, and runs nothing.
  void compile(const Surface& surface, const scenes::Camera& camera) const;

  // From now on the colour lacks this light of the program's list (one or none); no shader is compiled. Where
  // PathProgram::leftOut is set: `terms` are as many pictures as these lights, at most so many, and each lacks its own.
  void leaveOut(std::span<const std::size_t> lights);

  // From now on what lies behind surfaces that light passes through (binding 29); null: nothing. It must outlive the
  // pass or be taken off.
  void setBackdrop(const Backdrop* backdrop);

  // All specialization constants of the permutation that is made for this class alone; nothing is compiled.
  std::vector<std::uint32_t> exactConstants(const MaterialClass& materialClass) const;
  // In order of their first use.
  const std::vector<CompiledPermutation>& compiled() const;
  Spirv spirv() const;
  // For another pass of the scene and path, so that it needs the same shaders.
  std::shared_ptr<PermutationPlan> plan() const;
  // Lights that its shaders loop over.
  std::uint32_t directionalCount() const;
  std::uint32_t localCount() const;

private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

// What shading the bins of a surface reads of the scene's textures: for Textures::require, whichever path comes first.
std::vector<Textures::Need> texturesOf(std::span<const Bin> bins, std::span<const BinKind> kinds);

// scenes::Light as the shaders read it, with its shadow maps if it has any.
GpuLight packLight(const scenes::Light& light, const ShadowOfLight& shadow = {});
// The ways in which the local ones of these fade, as bits: a path's constant (gpu/shaders/local_light.glsl).
std::uint32_t falloffsOf(std::span<const scenes::Light> lights);

} // namespace parity::gpu
