// docs/shading.md 8: lights and environments at their edges.
#include <fmt/format.h>

#include "lighting/environment/environment_light.h"
#include "scenes/environment.h"
#include "study/stress/scene_parts.h"

namespace parity::stress {

using namespace parts;

namespace {

StressScene ball(const char* name, const char* wants, float roughness, std::vector<scenes::Light> lights) {
  StressScene s = makeScene(name, wants, makeBall(), makeMaterial(roughness, 0.5f));
  s.scene.lights = std::move(lights);
  return s;
}

// V = -L: the half vector has no length.
StressScene backlight() {
  StressScene s = makeScene("backlight", "V = -L: H is N or 0, and all values are finite", makeQuad({0, 0, -1}),
                            makeMaterial(0.2f, 1));
  s.scene.lights = {makeSun({0, 0, -1}, 2)};
  return s;
}

StressScene light1e6() {
  StressScene s = ball("light-1e6", "half targets saturate at 65504, and no value is infinite", 0.2f,
                       {makeSun({0.2f, 0.3f, 1}, 1e6f), makePoint({0, 0, 1.5f}, 1e6f), makePoint({1, 0, 1.5f}, 1e6f)});
  s.check = [](const SceneFrames& frames, const SceneFrames*) { return requireWithinHalf(frames); };
  return s;
}

StressScene denormalLight() {
  StressScene s = ball("denormal-light", "0, or a denormal that the target rounds to 0", 0.4f,
                       {makeSun({0.2f, 0.3f, 1}, 1e-41f), makePoint({0, 0, 2}, 1e-41f)});
  s.check = [](const SceneFrames& frames, const SceneFrames*) {
    std::vector<std::string> wrong;
    for (const PathFrame& path : frames.paths) {
      const float limit = path.preset.empty() ? std::numeric_limits<float>::min() : 0.f;
      if (const float most = greatest(path.frame.color); most > limit)
        wrong.push_back(fmt::format("{}: {:.4g}", path.path, most));
    }
    return wrong;
  };
  return s;
}

StressScene infiniteRadius() {
  const auto make = [](float range) {
    return ball("infinite-radius", "the same picture as without a range", 0.4f, {makePoint({0, 0.5f, 2}, 8, range)});
  };
  StressScene s = make(kInf32);
  s.twin = std::make_shared<StressScene>(make(0));
  s.check = [](const SceneFrames& frames, const SceneFrames* twin) { return requireSame(frames, twin, "no range"); };
  return s;
}

// A range of 0 stands for an infinite one (scenes/scene.h): the smallest that is one.
StressScene zeroRadius() {
  StressScene s = ball("vanishing-radius", "ranges of 1e-6 m and of a denormal: no light", 0.4f,
                       {makePoint({0, 0.5f, 2}, 8, 1e-6f), makePoint({0, 0.5f, 2}, 8, 1e-40f)});
  s.check = [](const SceneFrames& frames, const SceneFrames*) {
    std::vector<std::string> wrong;
    for (const PathFrame& path : frames.paths)
      append(wrong, requireZero(path, {Term::localDiffuse, Term::localSpecular}));
    return wrong;
  };
  return s;
}

// In the plane of the quad, at the middle of a pixel of a 64x64 picture and between pixels.
StressScene lightOnSurface() {
  StressScene s = makeScene("light-on-the-surface", "a light exactly at a surface point: finite", makeQuad(),
                            makeMaterial(0.3f, 0.5f));
  const float step = 2.2f / 64;
  s.scene.lights = {makePoint({0.5f * step, 0.5f * step, 0}, 10), makePoint({0, 0, 0}, 10)};
  return s;
}

StressScene badTexels() {
  scenes::Environment environment = makeEnvironment("bad texels", 1, [](base::Image& image) {
    image.pixels[100] = kNan32;
    image.pixels[200] = kInf32;
    image.pixels[300] = -3;
    image.pixels[301] = -kInf32;
  });
  const scenes::CleanedCounts counts = scenes::cleanRadiance(environment.radiance, environment.name);
  const bool counted = counts.notANumber == 1 && counts.infinite == 1 && counts.negative == 2;
  StressScene s =
      ball("nan-and-inf-texels", "bad texels are cleaned once and counted, and the rest is finite", 0.3f, {});
  s.scene.environment = std::move(environment);
  s.check = [counted](const SceneFrames&, const SceneFrames*) {
    return counted ? std::vector<std::string>{} : std::vector<std::string>{"some bad texels were not counted"};
  };
  return s;
}

StressScene hotSun() {
  scenes::Environment environment = makeEnvironment("hot sun", 1, [](base::Image& image) {
    for (int c = 0; c < 3; ++c) image.at(7, 5)[c] = 65504;
  });
  StressScene s = ball("sun-65504", "a texel of 65504: finite mips", 0.3f, {});
  bool finite = true;
  for (const auto& mip :
       lighting::makeEnvironmentLight(environment, {.faceSize = lighting::kMinFaceSize}).prefiltered.mips)
    for (const glm::vec4& texel : mip) finite = finite && std::isfinite(texel.x + texel.y + texel.z);
  s.scene.environment = std::move(environment);
  s.check = [finite](const SceneFrames& frames, const SceneFrames*) {
    std::vector<std::string> wrong = requireWithinHalf(frames);
    if (!finite) wrong.push_back("the prefiltered mips are not finite");
    return wrong;
  };
  return s;
}

StressScene blackEnvironment() {
  StressScene s = ball("black-environment", "average brightness 0: no light from the sky, and no NaN", 0.3f,
                       {makeSun({0.2f, 0.3f, 1}, 2)});
  s.scene.environment = makeEnvironment("black", 0);
  s.check = [](const SceneFrames& frames, const SceneFrames*) {
    std::vector<std::string> wrong;
    for (const PathFrame& path : frames.paths) append(wrong, requireZero(path, {Term::skyDiffuse, Term::skySpecular}));
    return wrong;
  };
  return s;
}

} // namespace

std::vector<StressScene> lightScenes() {
  return {backlight(), light1e6(),       denormalLight(), infiniteRadius(),  zeroRadius(),
          badTexels(), lightOnSurface(), hotSun(),        blackEnvironment()};
}

} // namespace parity::stress
