// The mobile base pass, piece by piece and with the names of Unreal Engine 4's MobileBasePassPixelShader.usf and
// MobileShadingModels.ush (2020), for every preset: what differs between presets is an argument. The order in which the
// pieces are added up is the shader's (mobile/shaders/mobile.glsl).
//
// Types are those of the sources: half but for positions, normalisation, squared distances and uniforms (colours of
// lights, SH), and for a product of such a uniform with a half, which is stored by narrow().
#ifndef PARITY_SHADING_MOBILE_BASE_PASS
#define PARITY_SHADING_MOBILE_BASE_PASS

#include "shading/real.glsl"
#include "shading/capture.glsl"
#include "shading/env_brdf.glsl"
#include "shading/light.glsl"
#include "shading/material.glsl"
#include "shading/mobile_direct.glsl"
#include "shading/refit.glsl"
#ifdef PARITY_PRESET
#include "shading/sky_sh.glsl"
#endif

// Which environment BRDF.
CONSTANT int kEnvironmentBrdfKaris2014 = 0; // EnvBRDFApprox
CONSTANT int kEnvironmentBrdfUE4 = 1;       // AB.y *= saturate(50 g)
CONSTANT int kEnvironmentBrdfRefit = 2;     // shading/refit.glsl: with what scatters more than once, and what diffuse light has left
CONSTANT int kEnvironmentBrdfRefitNonmetal = 3; // the same where all materials are nonmetals
CONSTANT int kEnvironmentBrdfOwn = 4; // presetEnvironmentBrdf, of a preset folder

// Which lobe direct light has.
CONSTANT int kSunDApprox = 0;      // around the reflection vector (Karis 2014)
CONSTANT int kSunCalcSpecular = 1; // GGX_Mobile around the half vector (UE4 2020)
CONSTANT int kSunRefit = 2;        // shading/refit.glsl; goes with kEnvironmentBrdfRefit
CONSTANT int kSunPhongApprox = 3;  // D_Approx as the engine ships it
CONSTANT int kSunRefitNonmetal = 4; // kSunRefit with kEnvironmentBrdfRefitNonmetal
CONSTANT int kSunOwn = 5;           // presetDirectLobe, of a preset folder
CONSTANT int kSunOwnLocal = 6;      // presetLocalLobe

// The material's outputs that the base pass reads (GBuffer), after texturing.
struct MobileMaterial {
  real3 BaseColor;
  real Metallic;
  real3 DielectricSpecular; // 0.08 Specular, RGB: a tinted KHR_materials_specular keeps its colour
  real F90;                 // of a dielectric: 1 but for KHR_materials_specular; read by refit alone
  real Roughness;           // not below the preset's floor
};

// FMobileShadingModelContext.
struct MobileShadingModelContext {
  real3 DiffuseColor;
  real3 SpecPreEnvBrdf;
  real3 SpecularColor; // SpecPreEnvBrdf through the environment BRDF
  real Roughness;
  RefitLobe lobe; // with kEnvironmentBrdfRefit... alone
};

// A shading point's directions, unit: as the engine has them, and before they were rounded.
struct MobileFrame {
  real3 N;
  real3 V;
  real3 reflection; // reflectionVector(N, V)
  real32x3 N32;
  real32x3 V32;
};

// FMobileDirectLighting: what one light is multiplied with.
struct MobileDirectLighting {
  real3 Diffuse;
  real3 Specular;
};

#ifdef PARITY_PRESET
#include "shading/mobile_preset.glsl"
#endif

// InitShadingModelContext. nonmetal: EnvBRDFApproxNonmetal takes the place of the general form; fullyRough: FullyRough, and
// the environment is not to be fetched. NoV in [0, 1]. Of refit, SpecularColor is the albedo of light scattered once.
FN MobileShadingModelContext initShadingModelContext(int environmentBrdf, bool nonmetal, bool fullyRough, MobileMaterial m,
                                                     real NoV) {
  MobileShadingModelContext c;
  c.Roughness = m.Roughness;
  c.DiffuseColor = diffuseColor(m.BaseColor, m.Metallic);
  c.SpecularColor = specularColor(m.DielectricSpecular, m.BaseColor, m.Metallic);
  c.SpecPreEnvBrdf = c.SpecularColor;
  if (fullyRough) {
    c.Roughness = R(1.0);
    FullyRough(c.DiffuseColor, c.SpecularColor);
  } else if (environmentBrdf == kEnvironmentBrdfRefit || environmentBrdf == kEnvironmentBrdfRefitNonmetal) {
    real3 share;
    if (environmentBrdf == kEnvironmentBrdfRefitNonmetal) {
      c.lobe = refitNonmetalLobe(c.Roughness, NoV);
      real grey = refitDiffuseShare(c.lobe.single.y, R(0.0));
      share = real3(grey, grey, grey);
    } else {
      PRECISE real F90 = m.F90 + (R(1.0) - m.F90) * m.Metallic;
      c.SpecPreEnvBrdf = refitSpecularColor(m.DielectricSpecular, m.BaseColor, m.Metallic);
      c.lobe = refitLobe(c.SpecPreEnvBrdf, F90, c.Roughness, NoV);
      if (nonmetal) c.lobe.multiple = real3(R(0.0), R(0.0), R(0.0)); // so that both have the same colour
      share = real3(refitDiffuseShare(c.lobe.single.x, c.lobe.multiple.x), refitDiffuseShare(c.lobe.single.y, c.lobe.multiple.y),
                    refitDiffuseShare(c.lobe.single.z, c.lobe.multiple.z));
    }
    c.SpecularColor = c.lobe.single;
    c.DiffuseColor = refitDiffuseColor(m.BaseColor, m.Metallic, share);
#ifdef PARITY_OWN_presetEnvironmentBrdfNonmetal
  } else if (environmentBrdf == kEnvironmentBrdfOwn && nonmetal) {
    real E = presetEnvironmentBrdfNonmetal(c.Roughness, NoV);
    c.SpecularColor = real3(E, E, E);
#endif
#ifdef PARITY_OWN_presetEnvironmentBrdf
  } else if (environmentBrdf == kEnvironmentBrdfOwn) {
    real2 AB = presetEnvironmentBrdf(c.SpecPreEnvBrdf, c.Roughness, NoV);
    PRECISE real3 E = real3(c.SpecPreEnvBrdf.x * AB.x + AB.y, c.SpecPreEnvBrdf.y * AB.x + AB.y, c.SpecPreEnvBrdf.z * AB.x + AB.y);
    c.SpecularColor = E;
#endif
  } else if (nonmetal) {
    real E = EnvBRDFApproxNonmetal(c.Roughness, NoV);
    c.SpecularColor = real3(E, E, E);
  } else if (environmentBrdf == kEnvironmentBrdfKaris2014) {
    c.SpecularColor = EnvBRDFApprox(c.SpecPreEnvBrdf, c.Roughness, NoV);
  } else {
    c.SpecularColor = EnvBRDFApproxUE4(c.SpecPreEnvBrdf, c.Roughness, NoV);
  }
  return c;
}

// A and B of the preset's environment BRDF, to be looked at: what initShadingModelContext multiplies SpecPreEnvBrdf with, and
// what it adds. Of a nonmetal those of the general form, which EnvBRDFApproxNonmetal shortens (to within 1.53e-3); of fully
// rough materials .45 and 0, which go to the diffuse colour; of refit B is times F90. SpecPreEnvBrdf, Roughness, NoV in [0, 1].
FN real2 environmentBrdfAB(int environmentBrdf, bool fullyRough, real3 SpecPreEnvBrdf, real Roughness, real NoV) {
  if (fullyRough) return real2(R(0.45), R(0.0));
  if (environmentBrdf == kEnvironmentBrdfRefit || environmentBrdf == kEnvironmentBrdfRefitNonmetal) {
    real b = refitB(Roughness, NoV);
    PRECISE real a = R(1.0) - refitLoss(refitAlpha(Roughness), NoV) - b;
    return real2(a, b);
  }
#ifdef PARITY_OWN_presetEnvironmentBrdf
  if (environmentBrdf == kEnvironmentBrdfOwn) return presetEnvironmentBrdf(SpecPreEnvBrdf, Roughness, NoV);
#endif
  real2 AB = EnvBRDFApproxAB(Roughness, NoV);
  if (environmentBrdf == kEnvironmentBrdfKaris2014) return AB;
  PRECISE real faded = AB.y * saturate(R(50.0) * SpecPreEnvBrdf.y);
  return real2(AB.x, faded);
}

// 2 (N.V) N - V, not cut off below the horizon. Unit vectors; in the working precision, as UE4's ReflectionVector.
FN real3 reflectionVector(real3 N, real3 V) {
  PRECISE real twice = R(2.0) * dot3(N, V);
  PRECISE real3 r = real3(twice * N.x - V.x, twice * N.y - V.y, twice * N.z - V.z);
  return r;
}

// The half vector H = (V + L)/|V + L|, normalised in fp32; N where V = -L.
FN real3 halfVector(real3 N, real3 V, real32x3 L) {
  PRECISE real32x3 sum = real32x3(real32(V.x) + L.x, real32(V.y) + L.y, real32(V.z) + L.z);
  return narrow(safeNormalize(sum, widen(N)));
}

// max(0, N.L): half times float is float, then stored as half.
FN real cosineOf(real3 N, real32x3 L) { return narrow(max(dot32(widen(N), L), R32(0.0))); }

FN MobileFrame mobileFrame(real32x3 N, real32x3 V) {
  MobileFrame f;
  f.N32 = N;
  f.V32 = V;
  f.N = narrow(N);
  f.V = narrow(V);
  f.reflection = reflectionVector(f.N, f.V);
  return f;
}

// max(0, N.V): in half, as in the source; refit keeps the digits that a grazing view needs.
FN real viewCosine(int environmentBrdf, MobileFrame f) {
  if (environmentBrdf == kEnvironmentBrdfRefit) return real(max(dot32(f.N32, f.V32), R32(0.0)));
  return max(dot3(f.N, f.V), R(0.0));
}

// MobileIntegrateBxDF:
//   Specular = SpecularColor (NoL lobe),  Diffuse = NoL DiffuseColor
// lobe: D_Approx(Roughness, R.L), PhongApprox(Roughness, max(0, R.L)) or CalcSpecular(Roughness, N.H). 1/pi is in the light's
// colour. NoH is a half in the source, and GGX_Mobile's float parameter does not bring back its digits: smooth highlights have
// bands in half. Of refit the specular part is refitLight.
FN MobileDirectLighting mobileIntegrateBxDF(int sun, bool fullyRough, MobileShadingModelContext c, MobileFrame f, real32x3 L) {
  MobileDirectLighting lighting;
  real NoL = cosineOf(f.N, L);
  PRECISE real3 diffuse = real3(NoL * c.DiffuseColor.x, NoL * c.DiffuseColor.y, NoL * c.DiffuseColor.z);
  lighting.Diffuse = diffuse;
  lighting.Specular = real3(R(0.0), R(0.0), R(0.0));
  if (fullyRough) return lighting;
  if (sun == kSunRefit) {
    lighting.Specular = refitLight(c.lobe, NoL, refitHalfVector(f.N32, f.V32, L));
    return lighting;
  }
  if (sun == kSunRefitNonmetal) {
    real grey = refitNonmetalLight(c.lobe, NoL, refitHalfVector(f.N32, f.V32, L));
    lighting.Specular = real3(grey, grey, grey);
    return lighting;
  }
#ifdef PARITY_OWN_presetDirectLobe
  if (sun == kSunOwn) {
    lighting.Specular = presetDirectLobe(c, f, L, NoL);
    return lighting;
  }
#endif
#ifdef PARITY_OWN_presetLocalLobe
  if (sun == kSunOwnLocal) {
    lighting.Specular = presetLocalLobe(c, f, L, NoL);
    return lighting;
  }
#endif
  real lobe;
  if (sun == kSunDApprox) {
    lobe = D_Approx(c.Roughness, real(dot32(widen(f.reflection), L)));
  } else if (sun == kSunPhongApprox) {
    lobe = PhongApprox(c.Roughness, real(max(dot32(widen(f.reflection), L), R32(0.0))));
  } else {
    lobe = CalcSpecular(c.Roughness, real32(max(dot3(f.N, halfVector(f.N, f.V, L)), R(0.0))));
  }
  PRECISE real k = NoL * lobe;
  PRECISE real3 specular = real3(c.SpecularColor.x * k, c.SpecularColor.y * k, c.SpecularColor.z * k);
  lighting.Specular = specular;
  return lighting;
}

FN real32 lightChannel(real32 color, real Diffuse, real Specular, real specularScale) {
  PRECISE real32 lit = color * (real32(Diffuse) + real32(Specular) * real32(specularScale));
  return lit;
}

// Shadow color (Diffuse + Specular specularScale). color: the light's over pi. Summed in at least fp32, as a lobe's peak in
// a scale may be beyond half where its light is dim; the result saturates.
FN real3 lightWith(real32x3 color, MobileDirectLighting lighting, real specularScale) {
  return narrow(real32x3(lightChannel(color.x, lighting.Diffuse.x, lighting.Specular.x, specularScale),
                         lightChannel(color.y, lighting.Diffuse.y, lighting.Specular.y, specularScale),
                         lightChannel(color.z, lighting.Diffuse.z, lighting.Specular.z, specularScale)));
}

// SpecularIBL: what is fetched, in its scale. Saturates, so that a black SpecularColor gives 0.
FN real3 specularIBL(real3 radiance, real scale) {
  PRECISE real3 scaled = real3(radiance.x * scale, radiance.y * scale, radiance.z * scale);
  return narrow(widen(scaled));
}

// a b, component by component, saturating.
FN real3 modulate(real3 a, real3 b) {
  PRECISE real3 product = real3(a.x * b.x, a.y * b.y, a.z * b.z);
  return narrow(widen(product));
}

// A movable light of AccumulateLightingOfDynamicPointLight, as seen from a point.
struct MobileLocalLight {
  real32x3 L;     // unit, towards it
  real32x3 color; // candela, times attenuation, over pi
};

// The fall-off and the cone. falloff: kFalloff... of shading/light.glsl; toLight: metres; range 0: infinite; isSpot: else
// the cone is not read.
FN MobileLocalLight localLightAt(int falloff, real32x3 toLight, real32x3 candela, real32 range, real32 exponent, bool isSpot,
                                 real32x3 direction, real32 cosInner, real32 cosOuter) {
  MobileLocalLight light;
  real32x3 back = real32x3(-direction.x, -direction.y, -direction.z);
  light.L = safeNormalize(toLight, back);
  real32 d2 = dot32(toLight, toLight);
#ifdef PARITY_OWN_presetDistanceFalloff
  real32 attenuation = presetDistanceFalloff(falloff, d2, range, exponent);
#else
  real32 attenuation = distanceFalloff(falloff, d2, range, exponent);
#endif
#ifdef PARITY_OWN_presetSpotCone
  if (isSpot) attenuation = attenuation * real32(presetSpotCone(real(dot32(light.L, back)), real(cosInner), real(cosOuter)));
#else
  if (isSpot) attenuation = attenuation * real32(spotAttenuation(real(dot32(light.L, back)), real(cosInner), real(cosOuter)));
#endif
  PRECISE real32 k = attenuation * R32(0.318309886183790672);
  PRECISE real32x3 color = real32x3(candela.x * k, candela.y * k, candela.z * k);
  light.color = color;
  return light;
}

#endif
