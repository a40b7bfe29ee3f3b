// What a shading path is: a name, knobs, what it needs of the light, and a renderer of surfaces.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/cache.h"
#include "base/image/texture_block.h"
#include "base/stopwatch.h"
#include "gpu/surface/output_target.h"
#include "gpu/surface/shading_pass.h"
#include "lighting/baked_light.h"
#include "lighting/environment/environment_light.h"
#include "lighting/environment/panorama_cells.h"
#include "paths/env_brdf.h"
#include "paths/options.h"
#include "paths/store.h"
#include "shading/surface_model.h"

namespace parity::paths {

struct PresetHost;

// A step of the path's shader that a picture can show in place of the lit colour.
struct Intermediate {
  std::string_view name, meaning;
};

// The place of that name; nothing where there is none.
std::optional<std::uint32_t> placeOf(const std::vector<Intermediate>& all, std::string_view name);

// What the path reads of the environment, and what of other light it has there or in lightmaps.
struct LightNeeds {
  lighting::PrefilterOptions prefilter;
  bool cells = false;     // lighting::PanoramaCells, beside fine levels
  bool hasOneSun = false; // a sun that was extracted stays in the environment unless it is the brightest light of all
  bool bakesLocalLights = false; // where light is baked, stationary local lights are in its lightmap
  bool operator==(const LightNeeds&) const = default;
};

// The light as one path has it.
struct Light {
  std::vector<scenes::Light> lights; // the scene's, --sun and what was extracted
  // Null: no environment, or captures take its place.
  std::shared_ptr<const lighting::EnvironmentLight> environment;
  std::shared_ptr<const lighting::PanoramaCells> cells;
};

// Beyond one scene: of the run.
struct Services {
  base::Timings* timings = nullptr;
  const base::Cache& cache;
  const std::string& buildId; // belongs in every key of the cache
  Store& store;
};

// What a renderer is made from. All of it must outlive the renderer.
struct Inputs {
  const gpu::Device& device;
  const gpu::SceneBuffers& buffers;
  const std::vector<gpu::BinKind>& binKinds;
  const Light& light;
  bool isLit = true;                           // false: all that is placed is unlit
  const lighting::BakedLight* baked = nullptr; // null: none
  const gpu::Textures* textures = nullptr;     // in the path's own blocks; null: the scene's
  bool asksForShadows = false;                 // of all lights, as far as the path can
  const gpu::ShadowOptions& shadowMaps;
  bool onlyCompiles = false; // the renderer shades nothing: tables may hold anything
  bool terms = false;
  std::size_t leftOut = 0;  // at most gpu::kMaxLeftOut; not 0: so many pictures in place of the terms (leaveOut)
  bool lightsAlone = false; // of those: they hold the light of lights alone. Not with fog, nor with lobes
  std::uint32_t hiddenFeatures = 0; // of gpu::kFeatureLobes: what to leave out, of a path that hidesLobes
  bool wide = false;                // one program for any of the path's options, where the path has such
  std::uint32_t intermediate = 0;   // place in Path::intermediates(); 0: the lit colour
  gpu::Compilation compilation = {};
  std::uint64_t expectedPixels = 0; // that this run will shade by the renderer
  Services services;
  Store& store; // of the scene on this device: uploaded environments, shadow maps, ...
};

// What a renderer has done so far.
struct RendererWork {
  std::uint64_t directionalLights = 0, localLights = 0; // that its shaders loop over, where it takes all of the scene
  std::uint64_t lightLists = 0;                         // of local lights that reach a group of pixels
  std::uint64_t lightChoices = 0;                       // objects for which local lights were chosen
  std::uint64_t brdfTables = 0;                         // of the environment BRDF
};

// How a light fares on a path that has a limit of lights, over the objects that are asked about.
struct LightUse {
  std::size_t keptBy = 0;               // objects that are shaded with it
  std::vector<std::uint32_t> droppedBy; // instances that it reaches, and that do without it
  double effect = 0;                    // an estimate of what they lack: for ranking
};

class Renderer {
public:
  virtual ~Renderer() = default;

  virtual gpu::ShadedSurface shade(const gpu::Surface& surface, const scenes::Camera& camera) const = 0;
  // Its compile() makes the path's shaders ahead.
  virtual const gpu::ShadingPass& pass() const = 0;
  // Pairs of an image and a sampler that a permutation binds.
  virtual std::size_t countSamplers(const gpu::Permutation& permutation) const = 0;
  // What lies behind surfaces that light passes through, as this path shows it, from now on; null: nothing. It must
  // outlive the renderer or be taken off.
  virtual void setBackdrop(const gpu::Backdrop*) {}
  virtual bool readsBackdrop() const { return false; } // of some material of the scene
  // "needs 9 samplers on mobile, of at most 8"; empty: the material needs no more than the path allows.
  virtual std::string describeExcess(const scenes::Material&) const { return {}; }
  // Of a path that leavesOutLights: from now on the colour lacks the light at this place of Inputs::light (one or
  // none). Where Inputs::leftOut is set: `terms` are as many pictures as these lights, at most so many, and each lacks
  // its own; with Inputs::lightsAlone it holds the light of the others alone.
  virtual void leaveOut(std::span<const std::size_t>) {}
  virtual RendererWork work() const = 0;
  virtual const gpu::ShadowMaps* shadowMaps() const { return nullptr; } // null: none
  // What the path leaves out of the scene, in words ("2 of 6 local lights: ..."); and what its pictures so far do.
  virtual std::vector<std::string> notes() const { return {}; }
  virtual std::vector<std::string> warnings() const { return {}; }
};

class Path {
public:
  virtual ~Path() = default;

  virtual const std::string& name() const = 0;  // "mobile": in --path, reports, names of files
  virtual const std::string& title() const = 0; // in sentences
  virtual const base::KnobTable<Options>& knobs() const = 0;
  // The id of the knob whose choices are the path's presets; empty: it has none.
  virtual std::string presetKnob() const { return {}; }
  // What it offers to preset folders; null: it takes none. And the id of the knob that takes their names.
  virtual const PresetHost* presetHost() const { return nullptr; }
  virtual std::string folderKnob() const { return presetKnob(); }
  // Throws Error (usage) for options that do not go together. display: base::DisplayTransform's name.
  virtual void requireSense(const Options&, const std::string& /*display*/) const {}
  // Sets what the device makes of the options. Returns why, after a value: "as the device has no shaderFloat16"; empty:
  // it changes nothing.
  virtual std::string adapt(Options&, const gpu::DeviceReport&) const { return {}; }

  virtual LightNeeds lightNeeds(const Options& options) const = 0;
  virtual std::unique_ptr<Renderer> makeRenderer(const Inputs& inputs, const Options& options) const = 0;
  virtual const std::vector<Intermediate>& intermediates() const = 0; // the first: the lit colour

  // The surface that its lights meet, where the truth may take it over; null: none.
  virtual const shading::SurfaceModel* surfaceModel(const Options&) const { return nullptr; }
  // The environment BRDF by itself, for plots; null: it has none that is a function of roughness and N.V alone. And the
  // ids of the knobs that it depends on.
  virtual std::unique_ptr<EnvBrdf> environmentBrdf(const Options&) const { return nullptr; }
  virtual std::vector<std::string> environmentBrdfKnobs() const { return {}; }
  // What its colour is stored in; none: as it is computed. exposureEv: of the camera.
  virtual std::optional<gpu::TargetCodec> target(const Options&, const gpu::DeviceReport&, float /*exposureEv*/) const {
    return std::nullopt;
  }
  virtual std::string targetName(const Options&) const { return {}; } // empty where there is none
  // What its material textures are compressed in.
  virtual base::TextureBlock textureBlock(const Options&) const { return base::TextureBlock::none; }
  // Whether its own knobs ask for shadow maps.
  virtual bool asksForShadows(const Options&) const { return false; }
  // Notes about a material for the report; about the light, in a few words. hasCaptures: baked ones.
  virtual std::vector<std::string> notesOn(const scenes::Material&, const Options&) const { return {}; }
  virtual std::string describeLight(const Options&, bool /*hasCaptures*/) const { return {}; }

  virtual bool leavesOutLights() const { return false; } // Inputs::leftOut, lightsAlone and Renderer::leaveOut act
  // Of each light, over the instances with samples; empty: the path drops no light. mayDropLights: quick.
  virtual bool mayDropLights(const std::vector<scenes::Light>&, const Options&) const { return false; }
  virtual std::vector<LightUse> countLightUse(const scenes::Scene&, const std::vector<scenes::Light>&, const Options&,
                                              const std::vector<std::uint64_t>& /*samples*/) const {
    return {};
  }

  virtual bool hidesLobes() const { return false; } // Inputs::hiddenFeatures acts
  // The lobes of a lit material that the path leaves out, of gpu::kFeatureLobes.
  virtual std::uint32_t droppedLobes(const scenes::Material& material, const Options&) const {
    return gpu::lobesOf(material);
  }

  // Settings that a study tries besides each knob alone: a name, what a scene must have, values by id of the knob.
  struct KnobSet {
    std::string name, needs;
    std::vector<std::pair<std::string, std::string>> values;
  };
  virtual std::vector<KnobSet> knobSets() const { return {}; }
  // Changes that parity explain tries, alone and together.
  struct Change {
    std::string name, value;                                 // as a user writes them: "sky-sh", "9"
    std::string words;                                       // "nine SH coefficients of the sky"
    std::string approximation;                               // that it takes back, in words; empty: none
    std::vector<std::pair<std::string, std::string>> values; // by id of the knob
    bool proposed = true;                                    // tried where the user names none
    bool cheapens = false;                                   // it is there to save time: no way to look alike
    bool ofShadows = false;                                  // nothing without settings.shadows
  };
  virtual std::vector<Change> changes() const { return {}; }
  // Does again what a knob of the stage preparation prepares, and forgets it: for timing.
  virtual void prepareAgain(const std::string& /*knob*/, const Options&, const scenes::Environment&) const {}
};

} // namespace parity::paths
