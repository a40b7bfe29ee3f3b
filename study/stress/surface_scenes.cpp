// docs/shading.md 8: materials, normals and tangents at their edges.
#include <fmt/format.h>

#include "scenes/gltf/mesh_repair.h"
#include "scenes/gltf/tangents.h"
#include "study/stress/scene_parts.h"

namespace parity::stress {

using namespace parts;

namespace {

StressScene lit(StressScene s, const glm::vec3& towards = {0.3f, 0.5f, 0.8f}) {
  s.scene.lights = {makeSun(towards, 2)};
  s.scene.environment = makeEnvironment("white", 1);
  return s;
}

scenes::TextureSlot oneTexel(scenes::Scene& scene, std::array<std::uint8_t, 4> texel) {
  scenes::TextureImage image;
  image.name = "texel";
  image.pixels = base::Image8(1, 1, 4);
  std::copy(texel.begin(), texel.end(), image.pixels.pixels.begin());
  scenes::TextureSlot slot;
  slot.image = static_cast<int>(scene.images.size());
  scene.images.push_back(std::move(image));
  return slot;
}

StressScene roughness0() {
  StressScene s = lit(makeScene("roughness-0", "finite, except karis2014, which has no roughness floor and is NaN",
                                makeBall(), makeMaterial(0, 1)));
  s.karisMustFail = true;
  return s;
}

StressScene roughnessAbove1() {
  const auto make = [](float roughness) {
    return lit(
        makeScene("roughness-above-1", "the same picture as with roughness 1", makeBall(), makeMaterial(roughness, 1)));
  };
  StressScene s = make(5);
  s.twin = std::make_shared<StressScene>(make(1));
  s.check = [](const SceneFrames& frames, const SceneFrames* twin) { return requireSame(frames, twin, "roughness 1"); };
  return s;
}

// NoV = 0: the normal is at right angles to the view, the light comes along it.
StressScene grazing() {
  StressScene s = makeScene("grazing", "N.V = 0: finite, and direct light is at most its irradiance",
                            makeQuad({1, 0, 0}), makeMaterial(0.5f, 0, glm::vec3(1)));
  s.scene.lights = {makeSun({1, 0, 0}, 2)};
  s.check = [](const SceneFrames& frames, const SceneFrames*) {
    std::vector<std::string> wrong;
    for (const PathFrame& path : frames.paths) {
      const float light = greatest(termOf(path, Term::sunDiffuse)) + greatest(termOf(path, Term::sunSpecular));
      if (!(light <= 2)) wrong.push_back(fmt::format("{}: {:.4g} of an irradiance of 2", path.path, light));
    }
    return wrong;
  };
  return s;
}

StressScene facingAway() {
  StressScene s =
      makeScene("facing-away", "N.V < 0, lit from behind: finite", makeQuad({0, 0, -1}), makeMaterial(0.3f));
  return lit(s, {0, 0.2f, -1});
}

StressScene flippedNormals() {
  StressScene s = makeScene("flipped-normals", "normals away from the light: direct light is 0", makeQuad({0, 0, -1}),
                            makeMaterial(0.4f));
  s.scene.lights = {makeSun({0, 0.2f, 1}, 2), makePoint({0, 0, 2}, 5)};
  s.scene.environment = makeEnvironment("white", 1);
  s.check = [](const SceneFrames& frames, const SceneFrames*) {
    std::vector<std::string> wrong;
    for (const PathFrame& path : frames.paths)
      append(wrong, requireZero(path, {Term::sunDiffuse, Term::sunSpecular, Term::localDiffuse, Term::localSpecular}));
    return wrong;
  };
  return s;
}

StressScene twoSided() {
  scenes::Material material = makeMaterial(0.4f);
  material.doubleSided = true;
  StressScene s = lit(
      makeScene("two-sided", "seen and lit from behind: the normal flips, and there is light", makeQuad(), material),
      {0, 0.2f, -1});
  s.camera = makeCamera(true);
  s.check = [](const SceneFrames& frames, const SceneFrames*) {
    std::vector<std::string> wrong;
    for (const PathFrame& path : frames.paths)
      if (!(greatest(termOf(path, Term::sunDiffuse)) > 0.1f)) wrong.push_back(path.path + ": no light");
    return wrong;
  };
  return s;
}

StressScene badNormals() {
  scenes::Mesh mesh = makeQuad();
  mesh.normals = {{0, 0, 0}, {kNan32, 0, 1}, {0, 0, 1e-30f}, {kInf32, 0, 0}};
  scenes::mendNormals(mesh);
  StressScene s =
      lit(makeScene("zero-and-nan-normals", "the loader repairs them: the same picture as with the face normal",
                    std::move(mesh), makeMaterial(0.4f)));
  s.twin = std::make_shared<StressScene>(lit(makeScene("zero-and-nan-normals", "", makeQuad(), makeMaterial(0.4f))));
  s.check = [](const SceneFrames& frames, const SceneFrames* twin) {
    return requireSame(frames, twin, "correct normals");
  };
  return s;
}

StressScene degenerateTangents() {
  scenes::Mesh mesh = makeQuad();
  mesh.uv0.assign(4, {0.5f, 0.5f}); // no area in uv
  scenes::makeTangents(mesh, 0);
  bool orthonormal = true;
  for (std::size_t v = 0; v < mesh.tangents.size(); ++v) {
    const glm::vec3 t(mesh.tangents[v]);
    orthonormal =
        orthonormal && std::fabs(glm::length(t) - 1) < 1e-5f && std::fabs(glm::dot(t, mesh.normals[v])) < 1e-5f;
  }
  StressScene s = lit(makeScene("degenerate-tangents",
                                "no uv area: the tangents fall back to an orthonormal frame, and all is finite",
                                std::move(mesh), makeMaterial(0.4f)));
  s.scene.materials[0].normalTexture = oneTexel(s.scene, {200, 90, 220, 255});
  s.check = [orthonormal](const SceneFrames&, const SceneFrames*) {
    return orthonormal ? std::vector<std::string>{}
                       : std::vector<std::string>{"the loader's tangents do not form a frame"};
  };
  return s;
}

StressScene zeroTangents() {
  scenes::Mesh mesh = makeQuad();
  mesh.tangents.assign(4, {0, 0, 0, 1}); // as if a file's had not been mended
  StressScene s = lit(makeScene("zero-tangents", "tangents of length 0: finite", std::move(mesh), makeMaterial(0.4f)));
  s.scene.materials[0].normalTexture = oneTexel(s.scene, {200, 90, 220, 255});
  return s;
}

StressScene badNormalMap() {
  StressScene s = makeScene("normal-map-into-the-surface", "normals below the surface and of almost no length: finite",
                            makeQuad(), makeMaterial(0.2f, 1));
  scenes::makeTangents(s.scene.meshes[0], 0);
  s.scene.materials[0].normalTexture = oneTexel(s.scene, {127, 128, 0, 255});
  return lit(s);
}

// Exactly 0 wherever the formulas have no F90 of their own: the fit of karis2014 is negative or positive there.
StressScene blackMetal() {
  StressScene s = lit(makeScene("black-metal", "metallic 1 over black: no diffuse light; in ue4-2020 no light",
                                makeBall(), makeMaterial(0.4f, 1, glm::vec3(0))));
  s.check = [](const SceneFrames& frames, const SceneFrames*) {
    std::vector<std::string> wrong;
    for (const PathFrame& path : frames.paths) {
      append(wrong, requireZero(path, {Term::sunDiffuse, Term::localDiffuse, Term::skyDiffuse}));
      if (path.preset == "ue4-2020") append(wrong, requireZero(path, {Term::sunSpecular, Term::skySpecular}));
    }
    return wrong;
  };
  return s;
}

StressScene brightEmissive() {
  StressScene s = makeScene("emissive-1e6", "saturates at 65504 in a half target", makeQuad(), makeMaterial(0.5f));
  s.scene.materials[0].emissive = glm::vec3(1e6f);
  s.scene.lights = {makeSun({0, 0, 1}, 2)};
  s.check = [](const SceneFrames& frames, const SceneFrames*) { return requireWithinHalf(frames); };
  return s;
}

} // namespace

std::vector<StressScene> surfaceScenes() {
  return {roughness0(), roughnessAbove1(),    grazing(),      facingAway(),   flippedNormals(), twoSided(),
          badNormals(), degenerateTangents(), zeroTangents(), badNormalMap(), blackMetal(),     brightEmissive()};
}

std::vector<StressScene> namedScenes() {
  std::vector<StressScene> all = surfaceScenes();
  for (StressScene& scene : lightScenes()) all.push_back(std::move(scene));
  return all;
}

} // namespace parity::stress
