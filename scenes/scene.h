// The scene: plain, validated, device-free data that every path is given unchanged.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "base/image/image.h"
#include "scenes/scene_light.h"

namespace parity::scenes {

// ---- geometry
// --------------------------------------------------------------------------------------------------------

// A triangle list in object space; all attribute arrays have the same length. Metres, right-handed, +Y up.
// The loader generates what a file lacks: flat normals (vertices split), tangents where a material needs them.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;     // unit length
  std::vector<glm::vec4> tangents;    // xyz unit, w = +-1 handedness (bitangent = w * cross(n, t)); empty: none needed
  std::vector<glm::vec2> uv0, uv1;    // empty where absent (read as 0)
  std::vector<glm::vec4> colors;      // linear RGBA; empty where absent (read as 1)
  std::vector<std::uint32_t> indices; // 3 per triangle, counter-clockwise seen from the front
  std::uint32_t material = 0;         // index into Scene::materials
};

struct Instance {
  std::uint32_t mesh = 0;
  glm::mat4 toWorld{1.f}; // affine, finite; a negative determinant flips the winding
  std::string node;       // path of node names, for messages
};

// ---- materials
// -------------------------------------------------------------------------------------------------------

enum class Wrap : std::uint8_t { repeat, mirroredRepeat, clampToEdge };
enum class Filter : std::uint8_t { nearest, linear };

// glTF's sampler. useMips false: only the base level is read.
struct Sampler {
  Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
  Filter magFilter = Filter::linear, minFilter = Filter::linear, mipFilter = Filter::linear;
  bool useMips = true;
  bool operator==(const Sampler&) const = default;
};

// A texture as one material slot reads it. uv' = uvTransform * (u, v, 1), row-major 2x3 (KHR_texture_transform).
struct TextureSlot {
  int image = -1; // index into Scene::images; -1: none
  int texCoord = 0;
  Sampler sampler;
  std::array<float, 6> uvTransform{1, 0, 0, 0, 1, 0};
  bool present() const { return image >= 0; }
  bool operator==(const TextureSlot&) const = default;
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

// glTF metallic-roughness plus the supported extensions; factors as in the file.
struct Material {
  std::string name;         // unique in the scene: the loader appends " (2)" and so on
  glm::vec4 baseColor{1.f}; // linear
  float metallic = 1, roughness = 1;
  float normalScale = 1, occlusionStrength = 1;
  glm::vec3 emissive{0.f}; // linear; times emissiveStrength already
  float alphaCutoff = 0.5f;
  AlphaMode alphaMode = AlphaMode::opaque;
  bool doubleSided = false, unlit = false;
  bool fullyRough = false; // opt-in only: --fully-rough, suite file, or extras.fullyRough == true
  float ior = 1.5f;        // KHR_materials_ior
  float specular = 1;      // KHR_materials_specular
  glm::vec3 specularColor{1.f};
  float coat = 0, coatRoughness = 0; // KHR_materials_clearcoat: a layer of F0 .04 over all else; 0: none
  float coatNormalScale = 1;         // of the coat's own normal map; it does not read the base's
  glm::vec3 sheenColor{0.f}; // KHR_materials_sheen, linear, [0, 1]: fibres over the base, below the coat; 0: none
  float sheenRoughness = 0;
  float anisotropy = 0; // KHR_materials_anisotropy's strength, [0, 1]: roughness grows along one direction; 0: none
  float anisotropyRotation = 0; // of that direction from the tangent, radians, counter-clockwise
  float iridescence = 0;        // KHR_materials_iridescence: share of the surface under a thin film, [0, 1]; 0: none
  float iridescenceIor = 1.3f;  // of the film
  float iridescenceThicknessMin = 100, iridescenceThicknessMax = 400; // nm; without a texture the latter holds
  // KHR_materials_transmission: the share of the light that enters the base and passes through it, [0, 1]; 0: none.
  float transmission = 0;
  // KHR_materials_volume: of the body behind the surface, in the coordinates of the mesh, as it is seen along the
  // normal; 0: a thin wall.
  float thickness = 0;
  float attenuationDistance = 0; // metres of the world over which light keeps attenuationColor; 0: keeps all
  glm::vec3 attenuationColor{1.f};
  float dispersion = 0;          // KHR_materials_dispersion: 20 / Abbe number; 0: none
  float diffuseTransmission = 0; // KHR_materials_diffuse_transmission: share of diffuse light that passes; 0: none
  glm::vec3 diffuseTransmissionColor{1.f};
  std::vector<std::string> notModelled;        // what the file gives it and no path shows: "subsurface"
  TextureSlot baseColorTexture;                // RGB sRGB, A linear
  TextureSlot metallicRoughnessTexture;        // G roughness, B metallic
  TextureSlot normalTexture;                   // tangent space, +Y up (OpenGL)
  TextureSlot occlusionTexture;                // R
  TextureSlot emissiveTexture;                 // sRGB
  TextureSlot specularTexture;                 // A
  TextureSlot specularColorTexture;            // sRGB
  TextureSlot coatTexture;                     // R
  TextureSlot coatRoughnessTexture;            // G
  TextureSlot coatNormalTexture;               // as normalTexture
  TextureSlot sheenColorTexture;               // sRGB
  TextureSlot sheenRoughnessTexture;           // A
  TextureSlot anisotropyTexture;               // RG the direction in [-1, 1], B strength
  TextureSlot iridescenceTexture;              // R
  TextureSlot iridescenceThicknessTexture;     // G: from the least thickness to the greatest
  TextureSlot transmissionTexture;             // R
  TextureSlot thicknessTexture;                // G
  TextureSlot diffuseTransmissionTexture;      // A
  TextureSlot diffuseTransmissionColorTexture; // sRGB

  // Dielectric F0 before textures, linear RGB, clamped to [0,1]: ((ior-1)/(ior+1))^2 * specularColor * specular.
  // glTF's default gives exactly 0.04 = UE's Specular 0.5.
  glm::vec3 dielectricF0() const;
  // Whether it has the layer at all. An unlit material has none.
  bool hasCoat() const { return coat > 0 && !unlit; }
  bool hasSheen() const { return sheenColor != glm::vec3(0) && !unlit; }
  bool hasAnisotropy() const { return anisotropy > 0 && !unlit; }
  // A film of thickness 0 is none (Belcour and Barla 2017: its index then goes to that outside).
  bool hasIridescence() const {
    const bool isThick =
        iridescenceThicknessMax > 0 || (iridescenceThicknessTexture.present() && iridescenceThicknessMin > 0);
    return iridescence > 0 && isThick && !unlit;
  }
  // Of the body, 1 / metre: light keeps exp(-absorption distance).
  glm::vec3 absorption() const;
  // Light that keeps its direction, up to refraction and roughness.
  bool hasTransmission() const { return transmission > 0 && !unlit; }
  bool hasDiffuseTransmission() const { return diffuseTransmission > 0 && !unlit; }
  // The mesh bounds a body, which refracts and absorbs; else it is a thin wall.
  bool hasVolume() const { return thickness > 0 && (hasTransmission() || hasDiffuseTransmission()); }
  // Any of the six.
  bool hasLobes() const {
    return hasCoat() || hasSheen() || hasAnisotropy() || hasIridescence() || hasTransmission() ||
           hasDiffuseTransmission();
  }
  // Blended, unlit and mostly transmissive materials cast none.
  bool castsShadow() const { return alphaMode != AlphaMode::blend && !unlit && !(transmission > 0.5f); }
  // Metallic exactly 0 with no texture that could raise it, and F0 exactly 0.04 untinted (docs/design.md 6c).
  bool isNonmetal() const;
};

// RGBA, 8 bit; no pixels where only materials that no mesh shows read it. The same image may be read as colour (sRGB)
// by one slot and as data by another.
struct TextureImage {
  std::string name;
  base::Image8 pixels; // 4 channels
  std::string file{};  // that it was read from, without its folder; empty: within the scene's file, or made in code
};

// ---- light
// -----------------------------------------------------------------------------------------------------------

enum class LightKind : std::uint8_t { directional, point, spot };

struct Light {
  std::string name;
  LightKind kind = LightKind::point;
  // Linear Rec.709, times intensity: lux (directional), candela (point, spot), or with a falloff exponent the
  // illuminance at the light itself, lux.
  glm::vec3 color{1.f};
  glm::vec3 position{0.f};
  glm::vec3 direction{0.f, 0.f, -1.f};                   // unit; the way the light travels
  float range = 0;                                       // metres; 0: infinite, not with a falloff exponent
  Falloff falloff = Falloff::khr;                        // of point and spot lights
  float falloffExponent = 0;                             // above 0, with Falloff::exponent alone
  float innerConeAngle = 0, outerConeAngle = 0.7853982f; // radians from the axis (spot)
  float specularScale = 1;                               // of its specular light, >= 0: Unreal Engine 4's SpecularScale
};

// An HDR panorama, equirectangular: u = atan2(z,x)/2pi + 0.5, v from +Y down. Radiance, linear Rec.709.
struct Environment {
  std::string name;
  base::Image radiance;  // 3 channels, finite, >= 0
  float rotationDeg = 0; // turns the environment about +Y
};

// ---- views
// -----------------------------------------------------------------------------------------------------------

struct Camera {
  std::string name;
  glm::mat4 toWorld{1.f}; // rigid; looks along its -Z, +Y up
  bool orthographic = false;
  float fovYDeg = 45;              // perspective
  float halfHeight = 1;            // orthographic, metres
  float zNear = 0.01f, zFar = 100; // zFar 0: infinite, as a file may say; makeCamera returns a finite one
};

struct Bounds {
  glm::vec3 lower{0.f}, upper{0.f};
  glm::vec3 center() const { return 0.5f * (lower + upper); }
  float radius() const { return 0.5f * glm::length(upper - lower); }
};

// A file that a scene was read from, as the scene names it, links not resolved; and the hash (base::Hasher) of the very
// bytes that were read.
struct SourceFile {
  std::filesystem::path file;
  std::string hash;
};

// What a file says of itself, beyond what is shown of it.
struct SourceFacts {
  std::string version, generator, copyright;
  std::vector<std::string> extensionsUsed, extensionsRequired;
  std::vector<std::string> scenes, animations, variants;   // names, empty where there is none
  std::vector<double> animationSeconds;                    // the time of the last key of each animation
  std::vector<std::pair<std::string, std::size_t>> counts; // of the file's own arrays: "nodes", 12
};

struct Scene {
  std::string name;                // short, for reports
  std::filesystem::path file;      // empty for built-in scenes
  std::vector<SourceFile> sources; // that file first, then its buffers and images, as far as they were read
  SourceFacts facts;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<TextureImage> images;
  std::vector<Light> lights;
  std::vector<Camera> cameras; // names are unique
  int defaultCamera = -1;      // index into cameras of the one that the automatic view takes; -1: fit the bounds
  std::optional<Environment> environment;
  LightScales lightScales;
  std::optional<Fog> fog;
  std::vector<std::string> warnings; // one line each: what was ignored, replaced or cleaned

  bool hasLobes() const;                       // a material that a mesh shows has a lobe beside the base's
  Bounds boundsOf(std::size_t instance) const; // world space, over its triangles; empty at the origin without any
  Bounds bounds() const;                       // world space, over all instances' triangles
  std::size_t triangleCount() const;           // over instances
};

} // namespace parity::scenes
