// From what artists set (BaseColor, Metallic, Specular) to the two colours that lighting uses.
#ifndef PARITY_SHADING_MATERIAL
#define PARITY_SHADING_MATERIAL

#include "shading/real.glsl"

// F0 of a dielectric: 0.08 Specular (Burley 2012, section 5.5; UE4's MobileShadingModels.ush). Specular in [0, 1]; 0.5
// is glTF's default of 0.04, an index of refraction of 1.5.
FN real dielectricSpecular(real Specular) {
  PRECISE real F0 = R(0.08) * Specular;
  return F0;
}

// DiffuseColor = BaseColor - BaseColor Metallic (UE4, MobileShadingModels.ush). All in [0, 1].
FN real3 diffuseColor(real3 BaseColor, real Metallic) {
  PRECISE real3 c = real3(BaseColor.x - BaseColor.x * Metallic, BaseColor.y - BaseColor.y * Metallic,
                          BaseColor.z - BaseColor.z * Metallic);
  return c;
}

// SpecularColor = (DielectricSpecular - DielectricSpecular Metallic) + BaseColor Metallic (UE4, MobileShadingModels.ush).
// DielectricSpecular is RGB here, so that a tinted KHR_materials_specular keeps its colour; grey gives the source's
// formula. All in [0, 1]. Metallic 1 over black is exactly 0.
FN real3 specularColor(real3 DielectricSpecular, real3 BaseColor, real Metallic) {
  PRECISE real3 c = real3((DielectricSpecular.x - DielectricSpecular.x * Metallic) + BaseColor.x * Metallic,
                          (DielectricSpecular.y - DielectricSpecular.y * Metallic) + BaseColor.y * Metallic,
                          (DielectricSpecular.z - DielectricSpecular.z * Metallic) + BaseColor.z * Metallic);
  return c;
}

#endif
