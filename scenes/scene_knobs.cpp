// The knobs of a scene and of its views.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/image/image.h"
#include "base/member_count.h"
#include "scenes/scene_settings.h"

namespace parity::scenes {
namespace {

using base::ActsOn, base::KnobTable, base::KnobType;

static_assert(base::memberCount<SceneSettings>() == 11 && base::memberCount<LoadOptions>() == 8 &&
                  base::memberCount<LightScales>() == 3 && base::memberCount<Fog>() == 6 &&
                  base::memberCount<ViewRequest>() == 5,
              "a new member needs a row");

template <auto... member> auto vec3Text() {
  return [](const auto& t) { return base::numbersText(&base::memberAt<member...>(t).x, 3); };
}

// A colour whose channels are from 0 to `most`.
template <auto... member, typename T>
base::KnobRow<T>& addColor(KnobTable<T>& t, const char* id, float most, const char* help) {
  return t.special(
      KnobType::numbers, id, "R,G,B", help,
      [most](T& settings, const std::string& text) {
        const auto n = base::readNumbers(text, "R,G,B");
        for (const float channel : n)
          if (channel < 0 || channel > most)
            throw base::KnobError{fmt::format("'{}' is not three numbers R,G,B from 0 to {:.0f}", text, most)};
        base::memberAt<member...>(settings) = glm::vec3(n[0], n[1], n[2]);
      },
      vec3Text<member...>());
}

void addLoading(KnobTable<SceneSettings>& t) {
  using S = SceneSettings;
  using L = LoadOptions;
  t.number<&S::load, &L::timeSeconds>("time", -kMaxPoseSeconds, kMaxPoseSeconds,
                                      "Time in seconds; the file's animations are posed at it")
      .ofScene()
      .inWords([](const S& s) { return fmt::format("{} s", s.load.timeSeconds); });
  t.text<&S::load, &L::animation>("animation", "all",
                                  "Only this animation, by name or number; none: the rest pose. Default: every\n"
                                  "animation that moves nothing an earlier one moves")
      .ofScene();
  t.text<&S::load, &L::scene>("scene", "the default",
                              "Scene in the file, by name or number. Default: the file's default scene")
      .titled("scene of the file")
      .ofScene();
  t.text<&S::load, &L::variant>("variant", "none", "Variant of the materials, by name or number. Default: none")
      .ofScene();
  t.choice<&S::subject>(
       "subject", {"scene", "ball"},
       "scene: the scene as it is; ball: each material of the file on a sphere, so that all are visible")
      .ofScene();
  t.special(
       KnobType::text, "max-image", "SIDE[,MEGAPIXELS]",
       "Largest side of a texture, and megapixels of all textures together. Default 16384,512",
       [](S& s, const std::string& text) {
         const bool both = text.find(',') != std::string::npos;
         const std::string form = both ? "SIDE,MEGAPIXELS" : "SIDE";
         const auto n = base::readNumbers(text, form);
         if (!(n[0] >= 1 && n[0] <= static_cast<float>(base::kMaxImageSide)) || (both && !(n[1] >= 1 && n[1] <= 4096)))
           throw base::KnobError{fmt::format("'{}' is not SIDE from 1 to {}, or SIDE,MEGAPIXELS from 1 to 4096", text,
                                             base::kMaxImageSide)};
         s.load.maxImageSide = static_cast<std::size_t>(n[0]);
         if (both) s.load.maxImageTexels = static_cast<std::size_t>(n[1]) << 20;
       },
       [](const S& s) { return fmt::format("{},{}", s.load.maxImageSide, s.load.maxImageTexels >> 20); })
      .titled("limit of images")
      .actsOn(ActsOn::nothing)
      .otherwise("16384,512");
  t.special(
       KnobType::text, "max-memory", "BYTES",
       "Memory limit for loading a scene (files, meshes and images together), for the pictures of --size,\n"
       "and for the texels of a bake; such as 512M. Default 4G",
       [](S& s, const std::string& text) { s.load.maxMemoryBytes = base::readBytes(text); },
       [](const S& s) { return std::to_string(s.load.maxMemoryBytes); })
      .titled("limit of memory")
      .actsOn(ActsOn::nothing)
      .otherwise("4G");
}

void addSky(KnobTable<SceneSettings>& t) {
  using S = SceneSettings;
  t.file<&S::environment>("env", "ENVIRONMENT", "not given",
                          "HDR environment: .hdr, .exr or .pfm file, or builtin:sky, studio, night, white")
      .alias("environment")
      .listedAs("environments")
      .titled("environment")
      .ofScene();
  t.number<&S::environmentRotationDeg>("env-rotation", -3600, 3600, "Rotation of the environment about +Y, degrees")
      .alias("environment-rotation")
      .titled("environment rotation")
      .ofScene();
  t.flag<&S::extractSun>("sun-extraction",
                         "Turn small bright sources of the environment, such as the sun, into lights");
  t.special(
       KnobType::numbers, "sun", "AZIMUTH,ELEVATION,LUX", "Add a directional light: AZIMUTH,ELEVATION,LUX (degrees)",
       [](S& s, const std::string& text) {
         const auto n = base::readNumbers(text, "AZIMUTH,ELEVATION,LUX");
         if (std::abs(n[1]) > 90)
           throw base::KnobError{fmt::format("'{}' is not a direction: ELEVATION must be from -90 to 90", text)};
         if (n[2] < 0) throw base::KnobError{fmt::format("'{}' is not a light: LUX must not be negative", text)};
         s.sun = SunRequest{n[0], n[1], n[2]};
       },
       [](const S& s) {
         return s.sun ? fmt::format("{},{},{}", s.sun->azimuthDeg, s.sun->elevationDeg, s.sun->lux) : "none";
       })
      .otherwise("none")
      .ofScene();
}

void addLight(KnobTable<SceneSettings>& t) {
  using S = SceneSettings;
  using Scales = LightScales;
  addColor<&S::lightScales, &Scales::skyLightColor>(t, "sky-light-color", kMaxLightScale,
                                                    "Scale of the environment's light")
      .ofScene();
  addColor<&S::lightScales, &Scales::indirectColorScale>(t, "indirect-color-scale", kMaxLightScale,
                                                         "Scale of the light in lightmaps (--baked)")
      .alias("indirect-lighting-color-scale")
      .ofScene();
  t.number<&S::lightScales, &Scales::sunSpecularScale>("sun-specular-scale", 0, kMaxLightScale,
                                                       "Scale of the specular light of directional lights")
      .alias("directional-specular-scale")
      .ofScene();
  t.choice<&S::falloff>("falloff", falloffNames(),
                        "Falloff of point and spot lights in every path: as in KHR_lights_punctual or as in UE4")
      .ofScene();
  t.special(
       KnobType::numbers, "fog", "DENSITY,FALLOFF,HEIGHT",
       "Height fog: DENSITY in 1/m at HEIGHT metres; density halves with each 1/FALLOFF metres of height",
       [](S& s, const std::string& text) {
         const auto n = base::readNumbers(text, "DENSITY,FALLOFF,HEIGHT");
         if (n[0] < 0 || n[0] > kMaxFogDensity || n[1] < 0 || n[1] > kMaxFogFalloff || std::abs(n[2]) > kMaxFogLength)
           throw base::KnobError{fmt::format(
               "'{}' is not a fog: DENSITY must be from 0 to {:.0f}, FALLOFF from 0 to {:.0f}, HEIGHT within {:.0f} m",
               text, kMaxFogDensity, kMaxFogFalloff, kMaxFogLength)};
         s.fog.density = n[0], s.fog.heightFalloff = n[1], s.fog.height = n[2];
       },
       [](const S& s) {
         return s.fog.isSeen() ? fmt::format("{},{},{}", s.fog.density, s.fog.heightFalloff, s.fog.height) : "none";
       })
      .otherwise("none")
      .ofScene();
  addColor<&S::fog, &Fog::color>(t, "fog-color", kMaxFogRadiance, "Radiance of dense fog, linear R,G,B")
      .needs("fog")
      .ofScene();
  t.number<&S::fog, &Fog::startDistance>("fog-start", 0, kMaxFogLength, "Distance at which fog starts, metres")
      .needs("fog")
      .ofScene();
  t.number<&S::fog, &Fog::maxOpacity>("fog-opacity", 0, 1, "Largest opacity of fog, 0 to 1").needs("fog").ofScene();
}

KnobTable<SceneSettings> makeSceneKnobs() {
  using S = SceneSettings;
  KnobTable<S> t;
  t.section("Scene");
  addSky(t);
  addLoading(t);
  addLight(t);
  t.texts<&S::fullyRough>("fully-rough", "none",
                          "Materials that use the mobile path's fully-rough shortcut (glob, repeatable)");
  t.file<&S::baked>("baked", "FOLDER", "none",
                    "Folder of baked light from 'parity bake'. All scenes of the command use it")
      .titled("baked light")
      .ofScene();
  return t;
}

template <auto member> auto optionalText() {
  return [](const ViewRequest& view) {
    return view.*member ? base::numbersText(&(view.*member)->x, 3) : std::string("not given");
  };
}

KnobTable<ViewRequest> makeViewKnobs() {
  using V = ViewRequest;
  KnobTable<V> t;
  t.section("View");
  t.special(
       KnobType::text, "camera", "", "glTF camera, by name or number, or auto",
       [](V& v, const std::string& text) { v.camera = text == "auto" ? "" : text; },
       [](const V& v) {
         return v.camera.empty() || v.camera == "auto" ? std::string("automatic") : base::listText({v.camera}, "");
       })
      .otherwise("auto");
  t.special(
       KnobType::numbers, "orbit", "THETA,PHI,RADIUS",
       "Camera around the target: angles in degrees, radius in metres (0: fit the scene)",
       [](V& v, const std::string& text) {
         const auto n = base::readNumbers(text, "THETA,PHI,RADIUS");
         if (n[1] < 0 || n[1] > 180 || n[2] < 0)
           throw base::KnobError{
               fmt::format("'{}' is not an orbit: PHI must be from 0 to 180, RADIUS at least 0", text)};
         v.orbit = glm::vec3(n[0], n[1], n[2]);
       },
       optionalText<&V::orbit>())
      .otherwise("not given");
  t.special(
       KnobType::numbers, "target", "X,Y,Z", "Point to look at, metres. Default: the centre of the scene",
       [](V& v, const std::string& text) {
         const auto n = base::readNumbers(text, "X,Y,Z");
         v.target = glm::vec3(n[0], n[1], n[2]);
       },
       optionalText<&V::target>())
      .otherwise("not given");
  t.number<&V::fovYDeg>("fov", 1, 170, "Vertical field of view, degrees. Does not apply to a camera of the file")
      .titled("field of view");
  return t;
}

} // namespace

const KnobTable<SceneSettings>& sceneKnobs() {
  static const KnobTable<SceneSettings> table = makeSceneKnobs();
  return table;
}

const KnobTable<ViewRequest>& viewKnobs() {
  static const KnobTable<ViewRequest> table = makeViewKnobs();
  return table;
}

void requireSense(const ViewRequest& view) {
  if (!view.camera.empty() && view.orbit)
    throw base::Error(base::ExitCode::usage, "--camera", "", "cannot be combined with --orbit");
}

} // namespace parity::scenes
