// The environment BRDF of a path as a function of roughness and N.V: A and B of F0 A + F90 B, and apart from it what
// the path adds for light that scatters more than once between microfacets.
//
// How the environment is read away from N = V = R is no part of it: that changes the light that it is multiplied with.
#pragma once

#include <string>

#include <glm/glm.hpp>

namespace parity::paths {

// A material at one point of a surface, linear Rec.709, all numbers in [0, 1].
struct EnvBrdfMaterial {
  glm::dvec3 baseColor{0.0};
  double metallic = 0, roughness = 1;
  glm::dvec3 dielectric{0.04}; // F0 where it is no metal
  double dielectricF90 = 1;
  bool nonmetal = false, fullyRough = false; // as scenes::Material says of all its points

  glm::dvec3 F0() const { return dielectric * (1 - metallic) + baseColor * metallic; }
  double F90() const { return dielectricF90 + (1 - dielectricF90) * metallic; }
};

// What it is called, each a few words.
struct EnvBrdfWords {
  std::string label;    // heads a column of numbers, and differs from that of other paths: "table", "mobile"
  std::string kind;     // "table", "approximation"
  std::string variant;  // of its kind, in "mobile's ue4-2020": "table", "ue4-2020"
  std::string formula;  // "EnvBRDFApprox (Karis 2014)"
  std::string numbers;  // how it is computed: "in double", "128 x 128"
  std::string multiple; // what returns light that scatters more than once: "kulla-conty", "none"
};

class EnvBrdf {
public:
  struct AB {
    double A = 0, B = 0;
  };

  virtual ~EnvBrdf() = default;

  virtual EnvBrdfWords words() const = 0;
  // roughness, NoV in [0, 1]; as at an F0 of 2 % or more where B depends on F0.
  virtual AB at(double roughness, double NoV) const = 0;
  // F0 A + F90 B of the material, by the formula that the path takes for it; and what scatters more than once. RGB.
  virtual glm::dvec3 once(const EnvBrdfMaterial& material, double NoV) const = 0;
  virtual glm::dvec3 multiple(const EnvBrdfMaterial& material, double NoV) const = 0;
  // Which formula that is, of those that the path has.
  virtual std::string form(const EnvBrdfMaterial&) const { return "general"; }

  // The same of a metal of that F0.
  glm::dvec3 once(double roughness, double NoV, const glm::dvec3& F0) const {
    return once(metalOf(roughness, F0), NoV);
  }
  glm::dvec3 multiple(double roughness, double NoV, const glm::dvec3& F0) const {
    return multiple(metalOf(roughness, F0), NoV);
  }

private:
  static EnvBrdfMaterial metalOf(double roughness, const glm::dvec3& F0) {
    return {.baseColor = F0, .metallic = 1, .roughness = roughness};
  }
};

} // namespace parity::paths
