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
  real32x3 again;   // unit: that of the ray that was reflected once within; the mobile path's
  real32 cosine;    // at which the ray meets the surface from within; the mobile path's
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

// Fresnel's reflectance of a dielectric for light from within, [0, 1]: 1 beyond the critical angle. c: the cosine within, o: that
// outside, 0 beyond the critical angle; ior at least 1.
FN real32 reflectanceFromWithin(real32 ior, real32 c, real32 o) {
  PRECISE real32 s = (ior * c - o) / max(ior * c + o, R32(1e-12));
  PRECISE real32 p = (c - ior * o) / max(c + ior * o, R32(1e-12));
  PRECISE real32 mean = R32(0.5) * (s * s + p * p);
  return o > R32(0.0) ? mean : R32(1.0);
}

// Snell's law: the cosine outside of that within, 0 beyond the critical angle.
FN real32 cosineOutside(real32 ior, real32 c) {
  PRECISE real32 outside2 = R32(1.0) - ior * ior * (R32(1.0) - c * c);
  return sqrt(max(outside2, R32(0.0)));
}

// What a surface of GGX with this alpha reflects of light that meets it from within, by the dielectric's reflectance over its
// visible normals, [0, 1]; the mobile path's:
//   F + (1 - 1 / ior^2 - F) (1 - exp(-a alpha - b alpha^2)),  a = 12.8 (1 - o)^2,  b = 2.7 max(2 o - 1, 0)
// F: of a smooth surface; 1 - 1 / ior^2: the share of even light beyond the critical angle; o: the cosine outside, 0 beyond it.
// The exponent is fitted at index 1.5 (tests/shading/refraction_test.cpp). c: the cosine within, [0, 1].
FN real32 reflectedWithin(real32 alpha, real32 ior, real32 c) {
  real32 o = cosineOutside(ior, c);
  real32 F = reflectanceFromWithin(ior, c, o);
  PRECISE real32 rough = R32(1.0) - R32(1.0) / (ior * ior);
  PRECISE real32 a = R32(12.8) * (R32(1.0) - o) * (R32(1.0) - o);
  PRECISE real32 b = R32(2.7) * max(R32(2.0) * o - R32(1.0), R32(0.0));
  PRECISE real32 exponent = alpha * (a + b * alpha);
  PRECISE real32 share = F + (rough - F) * (R32(1.0) - exp(-exponent));
  return min(max(share, R32(0.0)), R32(1.0));
}

// What becomes of a ray that meets a rough surface from within: means over the visible normals.
struct Crossing {
  real32 reflected;    // share, [0, 1]
  real32x3 outside;    // unit: mean direction of what leaves, by how much it is
  real32x3 reflection; // unit: that of what is reflected within
};

// Sums over microfacets, in the plane of incidence: x along it, z along the normal.
struct FacetSums {
  real32 reflected, outsideX, outsideZ, reflectionX, reflectionZ;
};

// Adds the microfacet of a point of the cap of visible normals (meanVisibleNormal's source). height: of the point above the cap's
// edge, [0, 1] of the cap's; around: the cosine of its angle about the normal, from the plane of incidence. (x, z): the ray against
// its direction, in that plane. Light that a facet sends to the wrong side is mirrored at the surface, as in the truth.
FN void addFacet(INOUT(FacetSums) sums, real32 x, real32 z, real32 ior, real32 alpha, real32 height, real32 around,
                 real32 weight) {
  PRECISE real32 stretched = sqrt(max(alpha * alpha * x * x + z * z, R32(1e-12)));
  PRECISE real32 vx = alpha * x / stretched;
  PRECISE real32 vz = z / stretched;
  PRECISE real32 cz = R32(1.0) - (R32(1.0) - height) * (R32(1.0) + vz);
  PRECISE real32 r2 = max(R32(1.0) - cz * cz, R32(0.0));
  PRECISE real32 tx = alpha * (sqrt(r2) * around + vx);
  PRECISE real32 tz = max(cz + vz, R32(1e-6));
  PRECISE real32 ty2 = alpha * alpha * r2 * (R32(1.0) - around * around);
  PRECISE real32 l = sqrt(tx * tx + ty2 + tz * tz);
  PRECISE real32 hx = tx / l;
  PRECISE real32 hz = tz / l;
  PRECISE real32 c = min(max(x * hx + z * hz, R32(0.0)), R32(1.0));
  real32 o = cosineOutside(ior, c);
  PRECISE real32 F = weight * reflectanceFromWithin(ior, c, o);
  PRECISE real32 leaves = weight - F;
  PRECISE real32 k = ior * c - o;
  PRECISE real32 outX = k * hx - ior * x;
  PRECISE real32 outZ = k * hz - ior * z;
  PRECISE real32 backX = R32(2.0) * c * hx - x;
  PRECISE real32 backZ = R32(2.0) * c * hz - z;
  PRECISE real32 reflected = sums.reflected + F;
  PRECISE real32 outsideX = sums.outsideX + leaves * outX;
  PRECISE real32 outsideZ = sums.outsideZ - leaves * abs(outZ);
  PRECISE real32 reflectionX = sums.reflectionX + F * backX;
  PRECISE real32 reflectionZ = sums.reflectionZ + F * abs(backZ);
  sums.reflected = reflected;
  sums.outsideX = outsideX;
  sums.outsideZ = outsideZ;
  sums.reflectionX = reflectionX;
  sums.reflectionZ = reflectionZ;
}

// For the ray's direction `inside` and the normal `exit` where it meets the surface, outwards: Gauss' rule of two heights and
// eight points around each, of which the plane of incidence mirrors one half. Some facets of a rough surface always let light out,
// though none of the rule's may: the share is at most 1 - alpha^2 / (2 ior^2), where even light has 1 - 1 / ior^2.
// Unit vectors; alpha in [0, 1], ior at least 1.
FN Crossing crossingFromWithin(real32x3 inside, real32x3 exit, real32 ior, real32 alpha) {
  PRECISE real32 z = max(dot32(inside, exit), R32(1e-4));
  PRECISE real32x3 t = real32x3(z * exit.x - inside.x, z * exit.y - inside.y, z * exit.z - inside.z);
  real32x3 T = safeNormalize(t, exit); // along the normal nothing points to either side
  PRECISE real32 x = sqrt(max(R32(1.0) - z * z, R32(0.0)));
  FacetSums sums;
  sums.reflected = sums.outsideX = sums.outsideZ = sums.reflectionX = sums.reflectionZ = R32(0.0);
  real32 low = R32(0.211324865), high = R32(0.788675135);
  addFacet(sums, x, z, ior, alpha, high, R32(1.0), R32(0.0625));
  addFacet(sums, x, z, ior, alpha, high, R32(0.707106781), R32(0.125));
  addFacet(sums, x, z, ior, alpha, high, R32(0.0), R32(0.125));
  addFacet(sums, x, z, ior, alpha, high, R32(-0.707106781), R32(0.125));
  addFacet(sums, x, z, ior, alpha, high, R32(-1.0), R32(0.0625));
  addFacet(sums, x, z, ior, alpha, low, R32(0.923879533), R32(0.125));
  addFacet(sums, x, z, ior, alpha, low, R32(0.382683432), R32(0.125));
  addFacet(sums, x, z, ior, alpha, low, R32(-0.382683432), R32(0.125));
  addFacet(sums, x, z, ior, alpha, low, R32(-0.923879533), R32(0.125));
  PRECISE real32x3 outside = real32x3(sums.outsideX * T.x - sums.outsideZ * exit.x, sums.outsideX * T.y - sums.outsideZ * exit.y,
                                      sums.outsideX * T.z - sums.outsideZ * exit.z);
  PRECISE real32x3 reflection =
      real32x3(sums.reflectionX * T.x - sums.reflectionZ * exit.x, sums.reflectionX * T.y - sums.reflectionZ * exit.y,
               sums.reflectionX * T.z - sums.reflectionZ * exit.z);
  Crossing means;
  PRECISE real32 most = R32(1.0) - R32(0.5) * alpha * alpha / (ior * ior);
  means.reflected = min(sums.reflected, most);
  means.outside = safeNormalize(outside, exit);
  means.reflection = safeNormalize(reflection, real32x3(-exit.x, -exit.y, -exit.z));
  return means;
}

// The share of light that leaves a body after a reflection within it at the earliest, `reflected` of it by the first, `left`
// of it after each way: a geometric series; the mobile path's. Rough surfaces turn light into directions beyond the critical
// angle, of which they reflect 1 - 1 / ior^2; they are rough from roughness .2 on, the project's own fit against the truth.
// left in [0, 1].
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

// Alpha of the GGX reflection whose directions spread as much as those of rays that turn by the root of turn2 times a tilt:
// reflected light turns by twice a tilt. turn2: from turnOfRefraction2.
FN real32 alphaOfTurn(real32 alpha, real32 turn2) {
  PRECISE real32 a = R32(0.5) * alpha * sqrt(turn2);
  return min(a, R32(1.0));
}

// The same of the light that passes a sphere of this alpha, in one number. Across the plane of incidence a ray turns about as on
// the axis; the weights of both are the project's own, fitted against the truth. q: of the ray.
FN real32 alphaOfRefraction(real32 alpha, real32 ior, real32 q) {
  PRECISE real32 turn2 = R32(0.3) * turnOfRefraction2(R32(1.0) / ior) + R32(0.7) * turnOfRefraction2(q);
  return alphaOfTurn(alpha, turn2);
}

#endif
