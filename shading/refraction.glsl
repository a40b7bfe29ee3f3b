// Light through bodies: refraction where it enters and leaves, absorption on the way, dispersion (docs/shading.md 13).
#ifndef PARITY_SHADING_REFRACTION
#define PARITY_SHADING_REFRACTION

#ifndef __cplusplus
#include "shading/real.glsl"
#endif

// The way of the eye's ray through a body, backwards along the light.
struct Refraction {
  real32x3 inside;  // unit: direction of the ray in the body
  real32 path;      // of it in the body, in the unit of the thickness
  real32x3 exit;    // unit: the normal where the ray leaves
  real32x3 outside; // unit: direction in which the ray leaves
  real32x3 again;   // unit: that of the ray that was reflected once within
  real32 cosine;    // at which the ray meets the surface from within
  real32 bending;   // cosine outside over ior times that within, where the ray enters a rough surface
};

// The mean of a rough surface's normals that the eye sees, unit, for GGX's alpha: the middle of the cap of visible normals
// (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"),
//   h = (1 + c / l) / 2 N + alpha^2 / l t,  t = V - c N,  l = sqrt(c^2 + alpha^2 |t|^2),  c = N.V
FN real32x3 meanVisibleNormal(real32x3 N, real32x3 V, real32 alpha) {
  PRECISE real32 NoV = dot32(N, V);
  PRECISE real32x3 t = real32x3(V.x - NoV * N.x, V.y - NoV * N.y, V.z - NoV * N.z);
  PRECISE real32 c = max(NoV, R32(0.0));
  PRECISE real32 a2 = alpha * alpha;
  PRECISE real32 l = sqrt(max(c * c + a2 * dot32(t, t), R32(1e-12)));
  PRECISE real32 along = R32(0.5) + R32(0.5) * c / l;
  PRECISE real32 across = a2 / l;
  PRECISE real32x3 h = real32x3(along * N.x + across * t.x, along * N.y + across * t.y, along * N.z + across * t.z);
  return safeNormalize(h, N);
}

// Snell's law: the direction, unit, of the ray of an eye in direction V on the other side of a surface of normal N on the eye's
// side; index: that side's over this one's. Beyond the critical angle along the surface, as for a normal that turns away.
FN real32x3 refracted(real32x3 N, real32x3 V, real32 index) {
  PRECISE real32 c = dot32(N, V);
  PRECISE real32x3 t = real32x3(V.x - c * N.x, V.y - c * N.y, V.z - c * N.z);
  PRECISE real32 cosT = sqrt(max(R32(1.0) - dot32(t, t) / (index * index), R32(0.0)));
  PRECISE real32x3 d = real32x3(-t.x / index - cosT * N.x, -t.y / index - cosT * N.y, -t.z / index - cosT * N.z);
  return safeNormalize(d, V);
}

// The direction in which a ray within a body leaves it; exit: the normal there, outwards.
FN real32x3 leavingBody(real32x3 inside, real32x3 exit, real32 ior, real32 alpha) {
  real32x3 N = real32x3(-exit.x, -exit.y, -exit.z);
  real32x3 V = real32x3(-inside.x, -inside.y, -inside.z);
  return refracted(meanVisibleNormal(N, V, alpha), V, R32(1.0) / ior);
}

// Through a sphere of this diameter, which is what a body is taken for (Guy and Agopian 2018, "Physically Based Rendering in
// Filament", section "Refraction"; the same sphere as there), by the mean of the normals that the ray sees where it enters and
// leaves: a rough rim turns towards the eye, and so does its refraction. With c = -N.inside the path is thickness c, and the normal
// where it ends N + 2 c inside; what is reflected there goes as far again. N, V unit; ior at least 1.
FN Refraction throughSphere(real32x3 N, real32x3 V, real32 ior, real32 thickness, real32 alpha) {
  Refraction r;
  real32x3 seen = meanVisibleNormal(N, V, alpha);
  r.inside = refracted(seen, V, ior);
  r.bending = max(dot32(seen, V), R32(0.02)) / (ior * max(-dot32(seen, r.inside), R32(0.02)));
  PRECISE real32 c = max(-dot32(N, r.inside), R32(0.0));
  PRECISE real32 twice = R32(2.0) * c;
  r.path = thickness * c;
  r.cosine = c;
  PRECISE real32x3 exit = real32x3(N.x + twice * r.inside.x, N.y + twice * r.inside.y, N.z + twice * r.inside.z);
  r.exit = safeNormalize(exit, r.inside);
  r.outside = leavingBody(r.inside, r.exit, ior, alpha);
  PRECISE real32x3 back = real32x3(r.inside.x - twice * r.exit.x, r.inside.y - twice * r.exit.y, r.inside.z - twice * r.exit.z);
  PRECISE real32x3 last = real32x3(r.exit.x + twice * back.x, r.exit.y + twice * back.y, r.exit.z + twice * back.z);
  r.again = leavingBody(back, safeNormalize(last, back), ior, alpha);
  return r;
}

// What a surface of GGX with this alpha reflects of light that meets it from within, by the dielectric's reflectance over its
// visible normals, [0, 1]:
//   F + (1 - 1 / ior^2 - F) (1 - exp(-a alpha - b alpha^2)),  a = 12.8 (1 - o)^2,  b = 2.7 max(2 o - 1, 0)
// F: of a smooth surface; 1 - 1 / ior^2: the share of even light beyond the critical angle; o: the cosine outside, 0 beyond it.
// The exponent is fitted at index 1.5 (tests/shading/refraction_test.cpp). c: the cosine within, [0, 1].
FN real32 reflectedWithin(real32 alpha, real32 ior, real32 c) {
  PRECISE real32 outside2 = R32(1.0) - ior * ior * (R32(1.0) - c * c);
  real32 o = sqrt(max(outside2, R32(0.0)));
  PRECISE real32 s = (ior * c - o) / max(ior * c + o, R32(1e-12));
  PRECISE real32 p = (c - ior * o) / max(c + ior * o, R32(1e-12));
  PRECISE real32 F = o > R32(0.0) ? R32(0.5) * (s * s + p * p) : R32(1.0);
  PRECISE real32 rough = R32(1.0) - R32(1.0) / (ior * ior);
  PRECISE real32 a = R32(12.8) * (R32(1.0) - o) * (R32(1.0) - o);
  PRECISE real32 b = R32(2.7) * max(R32(2.0) * o - R32(1.0), R32(0.0));
  PRECISE real32 exponent = alpha * (a + b * alpha);
  PRECISE real32 share = F + (rough - F) * (R32(1.0) - exp(-exponent));
  return min(max(share, R32(0.0)), R32(1.0));
}

// The share of light that leaves a body after a reflection within it at the earliest, `reflected` of it by the first, `left`
// of it after each way: a geometric series. Rough surfaces turn light into directions beyond the critical angle, of which
// they reflect 1 - 1 / ior^2; they are rough from roughness .2 on, the project's own fit against the truth. left in [0, 1].
FN real32 leavingLater(real32 reflected, real32 left, real32 roughness, real32 ior) {
  PRECISE real32 rough = max(R32(1.0) - R32(1.0) / (ior * ior), reflected);
  PRECISE real32 trapped = reflected + (rough - reflected) * min(R32(5.0) * roughness, R32(1.0));
  PRECISE real32 share = reflected * left * (R32(1.0) - trapped) / max(R32(1.0) - trapped * left, R32(1e-6));
  return share;
}

// What is left of light after a path in a body: exp(-absorption path) (Beer and Lambert). absorption in 1 / the path's unit.
FN real32x3 transmittance(real32x3 absorption, real32 path) {
  PRECISE real32x3 left = real32x3(exp(-absorption.x * path), exp(-absorption.y * path), exp(-absorption.z * path));
  return left;
}

// Indices of refraction of red, green and blue light, by KHR_materials_dispersion:
//   ior + (-1, 0, 1) (ior - 1) 0.025 dispersion,  dispersion = 20 / Abbe number
// At least 1.
FN real32x3 dispersedIors(real32 ior, real32 dispersion) {
  PRECISE real32 spread = (ior - R32(1.0)) * R32(0.025) * dispersion;
  return real32x3(max(ior - spread, R32(1.0)), ior, ior + spread);
}

// Square of how much a ray that leaves a sphere turns in the plane of incidence by small tilts of the microfacets where it
// enters, which also move the place where it leaves, and where it leaves: (1 - q) (2 - 1 / q) and 1 / q - 1 of the tilt.
// q = cosine outside / (ior cosine within), above 0; 1 / ior on the axis.
FN real32 turnOfRefraction2(real32 q) {
  PRECISE real32 enters = (R32(1.0) - q) * (R32(2.0) - R32(1.0) / q);
  PRECISE real32 leaves = R32(1.0) / q - R32(1.0);
  PRECISE real32 sum = enters * enters + leaves * leaves;
  return sum;
}

// Alpha of the GGX reflection whose directions spread as much as those of the light that passes a sphere of this alpha:
// reflected light turns by twice a tilt. Across the plane of incidence a ray turns about as on the axis; the weights of both are
// the project's own, fitted against the truth. q: of the ray.
FN real32 alphaOfRefraction(real32 alpha, real32 ior, real32 q) {
  PRECISE real32 turn2 = R32(0.3) * turnOfRefraction2(R32(1.0) / ior) + R32(0.7) * turnOfRefraction2(q);
  PRECISE real32 a = R32(0.5) * alpha * sqrt(turn2);
  return min(a, R32(1.0));
}

#endif
