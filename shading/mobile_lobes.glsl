// Clear coat and sheen of the mobile path: Unreal Engine 4's clear coat, and the forms of `refit`.
#ifndef PARITY_SHADING_MOBILE_LOBES
#define PARITY_SHADING_MOBILE_LOBES

#include "shading/mobile_base_pass.glsl"
#include "shading/real.glsl"
#include "shading/sheen.glsl"

// Which form of the clear coat.
CONSTANT int kCoatNone = 0;
CONSTANT int kCoatUE4 = 1;
CONSTANT int kCoatRefit = 2;

// Which form of the sheen.
CONSTANT int kSheenNone = 0;
CONSTANT int kSheenFit = 1;

// Schlick's reflectance of the coat, F0 = .04:  F = Fc + (1 - Fc) .04,  Fc = (1 - cosine)^5
// Unreal Engine 4, MobileShadingModels.ush (4.25). cosine in [0, 1].
FN real coatFresnel(real cosine) {
  PRECISE real x = R(1.0) - cosine;
  PRECISE real x2 = x * x;
  PRECISE real Fc = x2 * x2 * x;
  PRECISE real F = Fc + (R(1.0) - Fc) * R(0.04);
  return F;
}

FN real underCoatChannel(real color, real attenuation, real Metallic, real ClearCoat, real NoV, real refraction) {
  PRECISE real a = color * R(1.11111111);
  PRECISE real tint = a + (a * a - a) * R(-0.78);
  PRECISE real absorbed = a * ((NoV - R(1.0)) * R(0.85) * (R(1.0) - tint) + R(1.0));
  PRECISE real metal = R(0.9) * absorbed * refraction;
  PRECISE real share = Metallic * ClearCoat;
  PRECISE real result = color * attenuation + (metal - color * attenuation) * share;
  return max(result, R(0.0));
}

// The material under Unreal Engine 4's coat: a dielectric's colour dims by what the coat reflects at N.V, a metal's by the
// coat's refraction and absorption, and Specular by refraction,
//   RefractionScale = ((NoV / 2 + 1/2) NoV - 1) saturate(1.25 - 1.25 Roughness) + 1
//   a = BaseColor / .9,  Absorption = a ((NoV - 1) .85 (1 - lerp(a, a^2, -.78)) + 1)
//   BaseColor = lerp(BaseColor (1 - ClearCoat F(NoV)), .9 Absorption RefractionScale, Metallic ClearCoat)
//   Specular *= lerp(1, RefractionScale, ClearCoat)
// InitShadingModelContext with MATERIAL_SHADINGMODEL_CLEAR_COAT (MobileShadingModels.ush, 4.25), without its dither. All in
// [0, 1]. max(., 0): a bright colour at a grazing view comes out negative in the source.
FN MobileMaterial underCoatUE4(MobileMaterial m, real ClearCoat, real NoV) {
  PRECISE real bend = ((NoV * R(0.5) + R(0.5)) * NoV - R(1.0)) * saturate(R(1.25) - R(1.25) * m.Roughness);
  PRECISE real refraction = bend + R(1.0);
  PRECISE real attenuation = R(1.0) - ClearCoat * coatFresnel(NoV);
  PRECISE real dim = R(1.0) + ClearCoat * bend;
  MobileMaterial under = m;
  under.BaseColor = real3(underCoatChannel(m.BaseColor.x, attenuation, m.Metallic, ClearCoat, NoV, refraction),
                          underCoatChannel(m.BaseColor.y, attenuation, m.Metallic, ClearCoat, NoV, refraction),
                          underCoatChannel(m.BaseColor.z, attenuation, m.Metallic, ClearCoat, NoV, refraction));
  PRECISE real3 specular = real3(m.DielectricSpecular.x * dim, m.DielectricSpecular.y * dim, m.DielectricSpecular.z * dim);
  under.DielectricSpecular = specular;
  return under;
}

// What a light gives by Unreal Engine 4's coat, per colour of the light, which holds 1/pi:
//   NoL F Vis D,  F = ClearCoat F(VoH),  Vis = 1/2 / (NoL (NoV (1 - a) + a) + NoV (NoL (1 - a) + a)),  a = Roughness^2
// D: GGX_Mobile. MobileIntegrateBxDF with MATERIAL_SHADINGMODEL_CLEAR_COAT (4.25); what lies below keeps 1 - F of the light.
// F, NoV, NoL in [0, 1]; Roughness in [0.015625, 1]. max(., kSmallest): finite where both cosines are 0. The
// last product is a float's, as Vis is in the source, and saturates: a smooth coat at grazing is beyond half.
FN real coatLightUE4(real F, real Roughness, real NoV, real NoL, real32 NoH) {
  PRECISE real a = Roughness * Roughness;
  PRECISE real smithV = NoL * (NoV * (R(1.0) - a) + a);
  PRECISE real smithL = NoV * (NoL * (R(1.0) - a) + a);
  PRECISE real sum = smithV + smithL;
  PRECISE real Vis = R(0.5) / max(sum, kSmallest);
  PRECISE real weight = F * (NoL * Vis);
  PRECISE real32 lit = real32(weight) * real32(GGX_Mobile(Roughness, NoH));
  return narrow(lit);
}

// What a light gives by the sheen at sheenColor 1, per colour of the light, which holds 1/pi: pi D V NoL of Charlie's
// distribution and Neubelt's visibility. alpha of sheenAlpha; the others in [0, 1].
FN real sheenLightFit(real alpha, real NoV, real NoL, real NoH) {
  PRECISE real visible = V_Neubelt(NoV, NoL) * NoL; // at most 1/4: D V alone overflows in half
  PRECISE real lit = kPi * D_Charlie(alpha, NoH) * visible;
  return lit;
}

// What the sheen leaves to the base: 1 - max(sheenColor) E, with E the albedo of its lobe at this view, [0, 1].
FN real belowSheen(real3 sheenColor, real E) {
  PRECISE real rest = R(1.0) - max(max(sheenColor.x, sheenColor.y), sheenColor.z) * E;
  return max(rest, R(0.0));
}

#endif
