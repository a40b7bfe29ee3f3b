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
                                      "The pose of the file's animations at this time, seconds")
      .ofScene()
      .inWords([](const S& s) { return fmt::format("{} s", s.load.timeSeconds); });
  t.text<&S::load, &L::animation>("animation", "all",
                                  "Only this animation, by name or number; none: the rest pose. Default: all that\n"
                                  "move nothing an earlier one does")
      .ofScene();
  t.text<&S::load, &L::scene>("scene", "the default",
                              "The scene of the file, by name or number. Default: the file's own choice")
      .titled("scene of the file")
      .ofScene();
  t.text<&S::load, &L::variant>("variant", "none", "The variant of its materials, by name or number. Default: none")
      .ofScene();
  t.choice<&S::subject>("subject", {"scene", "ball"},
                        "scene, or ball: each material of the file on a sphere, so that every one is seen")
      .ofScene();
  t.special(
       KnobType::text, "max-image", "SIDE[,MEGAPIXELS]",
       "SIDE or SIDE,MEGAPIXELS: largest texture, and all of a scene together. Default 16384,512",
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
       "Most that loading a scene may take: its files, meshes, images together, such as 512M; and most\n"
       "for the pictures of --size. Default 4G",
       [](S& s, const std::string& text) { s.load.maxMemoryBytes = base::readBytes(text); },
       [](const S& s) { return std::to_string(s.load.maxMemoryBytes); })
      .titled("limit of memory")
      .actsOn(ActsOn::nothing)
      .otherwise("4G");
}

void addSky(KnobTable<SceneSettings>& t) {
  using S = SceneSettings;
  t.file<&S::environment>("env", "FILE", "not given",
                          "HDR environment: .hdr, .exr, .pfm or builtin:sky, studio, night, white")
      .alias("environment")
      .titled("environment")
      .ofScene();
  t.number<&S::environmentRotationDeg>("env-rotation", -3600, 3600, "Turn the environment about +Y, degrees")
      .alias("environment-rotation")
      .titled("environment rotation")
      .ofScene();
  t.flag<&S::extractSun>("sun-extraction", "Bright compact sources (the sun) of the environment become lights");
  t.special(
       KnobType::numbers, "sun", "AZIMUTH,ELEVATION,LUX", "Add a directional light: AZIMUTH,ELEVATION,LUX (degrees)",
       [](S& s, const std::string& text) {
         const auto n = base::readNumbers(text, "AZIMUTH,ELEVATION,LUX");
         if (std::abs(n[1]) > 90)
           throw base::KnobError{fmt::format("'{}' is not a place in the sky: ELEVATION is from -90 to 90", text)};
         if (n[2] < 0) throw base::KnobError{fmt::format("'{}' is not a light: LUX is negative", text)};
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
                                                    "R,G,B that scales the environment's light")
      .ofScene();
  addColor<&S::lightScales, &Scales::indirectColorScale>(t, "indirect-color-scale", kMaxLightScale,
                                                         "R,G,B that scales the light of lightmaps (--baked)")
      .alias("indirect-lighting-color-scale")
      .ofScene();
  t.number<&S::lightScales, &Scales::sunSpecularScale>("sun-specular-scale", 0, kMaxLightScale,
                                                       "Scales the specular light of directional lights")
      .alias("directional-specular-scale")
      .ofScene();
  t.choice<&S::falloff>("falloff", falloffNames(),
                        "How point and spot lights fade, in every path: as KHR_lights_punctual or as UE4")
      .ofScene();
  t.special(
       KnobType::numbers, "fog", "DENSITY,FALLOFF,HEIGHT",
       "Height fog: DENSITY,FALLOFF,HEIGHT (1/m at HEIGHT; halves every 1/FALLOFF m upwards; m)",
       [](S& s, const std::string& text) {
         const auto n = base::readNumbers(text, "DENSITY,FALLOFF,HEIGHT");
         if (n[0] < 0 || n[0] > kMaxFogDensity || n[1] < 0 || n[1] > kMaxFogFalloff || std::abs(n[2]) > kMaxFogLength)
           throw base::KnobError{fmt::format(
               "'{}' is not a fog: DENSITY is from 0 to {:.0f}, FALLOFF from 0 to {:.0f}, HEIGHT within {:.0f} m", text,
               kMaxFogDensity, kMaxFogFalloff, kMaxFogLength)};
         s.fog.density = n[0], s.fog.heightFalloff = n[1], s.fog.height = n[2];
       },
       [](const S& s) {
         return s.fog.isSeen() ? fmt::format("{},{},{}", s.fog.density, s.fog.heightFalloff, s.fog.height) : "none";
       })
      .otherwise("none")
      .ofScene();
  addColor<&S::fog, &Fog::color>(t, "fog-color", kMaxFogRadiance, "Radiance of thick fog, linear R,G,B")
      .needs("fog")
      .ofScene();
  t.number<&S::fog, &Fog::startDistance>("fog-start", 0, kMaxFogLength, "No fog nearer than this, metres")
      .needs("fog")
      .ofScene();
  t.number<&S::fog, &Fog::maxOpacity>("fog-opacity", 0, 1, "The most that fog hides, 0 to 1").needs("fog").ofScene();
}

KnobTable<SceneSettings> makeSceneKnobs() {
  using S = SceneSettings;
  KnobTable<S> t;
  t.section("Scene");
  addSky(t);
  addLoading(t);
  addLight(t);
  t.texts<&S::fullyRough>("fully-rough", "none", "Materials that take the fully-rough shortcut (glob, repeatable)");
  t.file<&S::baked>("baked", "FOLDER", "none",
                    "Folder of baked light, by 'parity bake'; of several scenes: that of all")
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
       KnobType::text, "camera", "", "A glTF camera by name or number, or auto",
       [](V& v, const std::string& text) { v.camera = text == "auto" ? "" : text; },
       [](const V& v) {
         return v.camera.empty() || v.camera == "auto" ? std::string("automatic") : base::listText({v.camera}, "");
       })
      .otherwise("auto");
  t.special(
       KnobType::numbers, "orbit", "THETA,PHI,RADIUS", "THETA,PHI,RADIUS: degrees, metres (radius 0 fits the scene)",
       [](V& v, const std::string& text) {
         const auto n = base::readNumbers(text, "THETA,PHI,RADIUS");
         if (n[1] < 0 || n[1] > 180 || n[2] < 0)
           throw base::KnobError{fmt::format("'{}' is not an orbit: PHI is from 0 to 180, RADIUS at least 0", text)};
         v.orbit = glm::vec3(n[0], n[1], n[2]);
       },
       optionalText<&V::orbit>())
      .otherwise("not given");
  t.special(
       KnobType::numbers, "target", "X,Y,Z", "X,Y,Z to look at, metres. Default: the centre of the scene",
       [](V& v, const std::string& text) {
         const auto n = base::readNumbers(text, "X,Y,Z");
         v.target = glm::vec3(n[0], n[1], n[2]);
       },
       optionalText<&V::target>())
      .otherwise("not given");
  t.number<&V::fovYDeg>("fov", 1, 170, "Vertical field of view, degrees; a scene's own camera keeps its own")
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
