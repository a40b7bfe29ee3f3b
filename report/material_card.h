// What a material is made of, as its file has it and as it is decoded: what the page's card shows. Colours are linear
// Rec.709.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace parity::report {

struct CardTexture {
  std::string name;          // the image's
  std::string file;          // that it was read from; empty: within the scene's own file, or made in code
  std::string channels;      // that the input reads: "rgb", "g"
  int width = 0, height = 0; // texels; 0: not decoded, as no mesh shows the material
  int texCoord = 0;
  std::string picture; // a small one of these channels, relative to the report's folder; empty: none
  // Of each channel over the texels, times the factor; empty: not decoded, or a normal map.
  std::vector<double> least, most, mean;
};

// One input: its value, or the factor of its texture.
struct CardInput {
  std::string name;          // one of kCardInputs
  std::vector<double> value; // three of a colour, else one
  std::optional<CardTexture> texture;
};
inline constexpr const char* kCardInputs =
    "baseColor|opacity|metallic|roughness|normal|occlusion|emissive|specular|specularColor|coat|coatRoughness|"
    "coatNormal|sheenColor|sheenRoughness|anisotropy|anisotropyRotation|iridescence|iridescenceIor|"
    "iridescenceThickness|transmission|diffuseTransmission|diffuseTransmissionColor|ior|thickness|attenuationColor|"
    "attenuationDistance|dispersion";

struct MaterialCard {
  std::string name;
  std::vector<CardInput> inputs;     // base colour, metallic, roughness; others where they are not glTF's default
  std::string alphaMode = "opaque";  // or mask, blend
  std::optional<double> alphaCutoff; // of a mask
  bool doubleSided = false, unlit = false;
  bool nonmetal = false, fullyRough = false; // found; asked for
  bool vertexColors = false;                 // they multiply base colour and opacity
  std::vector<double> f0;                    // of a dielectric, before textures
  std::vector<std::string> notModelled;      // parts that no path models
};

} // namespace parity::report
