// The functions of the mobile path that a preset folder may define (docs/presets.md, which is made from this file). Each has
// a macro that is defined where the folder has the function. Types are those of shading/real.glsl: real is half
// (float16_t) with precision fp16, else float.
#ifndef PARITY_SHADING_MOBILE_PRESET
#define PARITY_SHADING_MOBILE_PRESET

// A and B of the environment BRDF: a surface reflects SpecularColor A + B of the environment that surrounds it evenly.
// SpecularColor: F0, linear, 0 to 1. Roughness: 0 to 1. NoV: cosine of the view's angle, at least 0, in half up to 1.002.
// A and B: about 0 to 1; F0 A + B is at least 0.
// Fully rough materials do not call it.
#ifdef PARITY_OWN_presetEnvironmentBrdf
real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV);
#endif

// The same for a nonmetal whose F0 is 0.04: the whole of 0.04 A + B, 0 to 1. Without it nonmetals take
// presetEnvironmentBrdf, too. Read only beside presetEnvironmentBrdf.
// Roughness: 0 to 1. NoV: at least 0, in half up to 1.002.
#ifdef PARITY_OWN_presetEnvironmentBrdfNonmetal
real presetEnvironmentBrdfNonmetal(real Roughness, real NoV);
#endif

// Specular light of one directional, point or spot light: pi f(V, L) N.L, at least 0, where f is the specular BRDF in 1/sr.
// The light's colour, which it is multiplied with, holds 1/pi.
// c.SpecPreEnvBrdf: F0. c.SpecularColor: the environment BRDF's result. c.Roughness: 0 to 1, not below the preset's floor.
// f.N, f.V, f.reflection: unit, from the surface; f.N32, f.V32: the same in fp32. L: unit, towards the light.
// NoL: at least 0, in half up to 1.002. For brushed metal, f lies about the bent normal.
#ifdef PARITY_OWN_presetDirectLobe
real3 presetDirectLobe(MobileShadingModelContext c, MobileFrame f, real32x3 L, real NoL);
#endif

// The same for point and spot lights alone. Without it they take presetDirectLobe, too. Read only beside presetDirectLobe.
#ifdef PARITY_OWN_presetLocalLobe
real3 presetLocalLobe(MobileShadingModelContext c, MobileFrame f, real32x3 L, real NoL);
#endif

// Attenuation of a point or spot light by the distance, in 1/m^2: candela times it are lux.
// falloff: kFalloffKhr, kFalloffUE4 or kFalloffExponent, as the scene or --falloff says. d2: the distance squared, in m^2,
// at least 0. range: in m; 0 or infinite: none. exponent: above 0, of kFalloffExponent alone, whose result is 0 to 1.
// The choice of an object's four lights and baked light keep the path's own attenuation and cone.
#ifdef PARITY_OWN_presetDistanceFalloff
real32 presetDistanceFalloff(int falloff, real32 d2, real32 range, real32 exponent);
#endif

// Attenuation of a spot light across its cone, 0 to 1.
// cosAngle: between the cone's axis and the way to the point, -1 to 1, in half up to 1.002. cosInner: at least cosOuter.
#ifdef PARITY_OWN_presetSpotCone
real presetSpotCone(real cosAngle, real cosInner, real cosOuter);
#endif

// The mip of the reflected environment: 0 (roughness 0.056 and below) to kPrefilterRoughestMip (5, roughness 1); mip m
// holds a GGX lobe of the roughness roughnessFromMip(m).
// Roughness: 0 to 1. Not with refit's environment BRDF, which has a mip of its own.
#ifdef PARITY_OWN_presetCaptureMip
real presetCaptureMip(real Roughness);
#endif

// Diffuse light of the sky: irradiance over pi, linear, at least 0.
// sky: coefficients packed as GetSkySHDiffuse (sky-sh = "9") and GetSkySHDiffuseSimple ("4") read them. N: unit.
#ifdef PARITY_OWN_presetSkyDiffuse
real3 presetSkyDiffuse(SkySh sky, real3 N);
#endif

// What the render target keeps of a colour: the encoding and its inverse together, so linear in and linear out. It comes
// after fog and before the opacity.
// Color: linear radiance, at least 0, not above kLargest.
#ifdef PARITY_OWN_presetEncode
real3 presetEncode(real3 Color);
#endif

#endif
