// The functions of the high-end path that a preset folder may define (docs/presets.md, which is made from this file). Each
// has a macro that is defined where the folder has the function. All numbers are fp32.

// A, B and the mean of the environment BRDF, in place of its table: a surface reflects F0 A + F90 B of the environment that
// surrounds it evenly. The mean is that of A + B over all cosines, weighted by the cosine; kulla-conty alone reads it.
// Light through glass, coats and the compensation take it, too.
// NoV: 0 to 1. roughness: 0 to 1. A and B: 0 to 1.
#ifdef PARITY_OWN_presetEnvironmentBrdf
vec3 presetEnvironmentBrdf(float NoV, float roughness);
#endif

// Specular light of one light: f(V, L) N.L, at least 0, where f is the specular BRDF in 1/sr. Coats, brushed metal and the
// lamps of the environment keep the path's own lobe.
// s.F0, s.F90: linear, 0 to 1. s.alpha: roughness squared, above 2e-4. s.NoV: above 0. s.N, s.V, L: unit. NoL: above 0.
// NoH, VoH: 0 to 1.
#ifdef PARITY_OWN_presetDirectLobe
vec3 presetDirectLobe(Shader s, vec3 L, float NoL, float NoH, float VoH);
#endif

// Diffuse light of one light: pi f(V, L), at least 0, where f is the diffuse BRDF in 1/sr.
// s.diffuseColor: linear, 0 to 1; with diffuse = "balanced" times what the specular lobe leaves of the environment.
// NoL: above 0. VoH: 0 to 1.
#ifdef PARITY_OWN_presetDiffuseLobe
vec3 presetDiffuseLobe(Shader s, float NoL, float VoH);
#endif

// Attenuation of a point or spot light by the distance, in 1/m^2: candela times it are lux.
// falloff: kFalloffKhr, kFalloffUE4 or kFalloffExponent, as the scene or --falloff says. d2: the distance squared, in m^2,
// at least 0. range: in m; 0 or infinite: none. exponent: above 0, of kFalloffExponent alone, whose result is 0 to 1.
// Lights are culled by their range and cone: 0 is expected outside.
#ifdef PARITY_OWN_presetDistanceFalloff
float presetDistanceFalloff(int falloff, float d2, float range, float exponent);
#endif

// Attenuation of a spot light across its cone, 0 to 1.
// cosAngle: between the cone's axis and the way to the point, -1 to 1. cosInner: at least cosOuter.
#ifdef PARITY_OWN_presetSpotCone
float presetSpotCone(float cosAngle, float cosInner, float cosOuter);
#endif
