// Of scenes with lobes beside the base's own: anisotropy and thin films of the base's specular lobe (docs/shading.md 11 and
// 12). Sums over a few directions of the lobe take the place of the tables.
#include "shading/anisotropic_brdf.glsl"
#include "shading/thin_film.glsl"

// The least alpha of image light. A level of the environment is never sharper.
const float kLeastAlpha = 2.44140625e-4;

bool isAnisotropic(Shader s) { return (kMayFeatures & kFeatureAnisotropy) != 0u && s.anisotropy > 0.0; }
bool hasFilm(Shader s) { return (kMayFeatures & kFeatureIridescence) != 0u && s.film > 0.0; }

// alpha along the tangent and across it, with a floor for alpha.
vec2 alphasOf(Shader s, float floorOfAlpha) {
  float alpha = max(sqr(s.perceptual), floorOfAlpha);
  return vec2(anisotropicAlpha(alpha, s.anisotropy), alpha);
}

vec3 toLocal(Shader s, vec3 d) { return vec3(dot(s.T, d), dot(s.B, d), dot(s.N, d)); }

vec3 localView(Shader s) {
  vec3 v = toLocal(s, s.V);
  return v.z >= kMinNoV ? v : vec3(normalize(v.xy + vec2(1e-9, 0.0)) * sqrt(1.0 - kMinNoV * kMinNoV), kMinNoV);
}

vec3 fresnelOf(Shader s, float VoH) {
  vec3 F = mixFresnel(s.F0, s.F90, fresnelWeight(VoH));
  return hasFilm(s) ? iridescentFresnel(F, thinFilmFresnel(s.filmIor, s.filmThickness, s.F0, VoH), s.film) : F;
}

// Cosine-weighted mean of fresnelOf, by four directions of equal weight.
vec3 meanFresnelOf(Shader s) {
  vec3 sum = vec3(0.0);
  for (int k = 0; k < 4; ++k) sum += fresnelOf(s, sqrt((float(k) + 0.5) * 0.25));
  return 0.25 * sum;
}

// V of the geometry term.
float anisotropicVisibility(vec2 alpha, vec3 v, vec3 l) {
  if (kGeometryTerm == kGeometryHeightCorrelated)
    return V_SmithGGXAnisotropic(alpha.x, alpha.y, v.x, v.y, v.z, l.x, l.y, l.z);
  return V_SchlickSmithAnisotropic(projectedAlpha(alpha.x, alpha.y, v.x, v.y), projectedAlpha(alpha.x, alpha.y, l.x, l.y),
                                   v.z, l.z);
}

// As scatteredOnce. L: unit, above the surface.
vec3 scatteredAnisotropic(Shader s, vec2 alpha, vec3 L) {
  vec3 v = localView(s), l = toLocal(s, L), h = safeNormalize(v + l, vec3(0.0, 0.0, 1.0));
  float D = D_GGXAnisotropic(alpha.x, alpha.y, h.x, h.y, max(h.z, 0.0));
  return (l.z * D * anisotropicVisibility(alpha, v, l)) * fresnelOf(s, saturate(dot(v, h))) * s.factor;
}

// Directions of the lobe, on strips of the sphere across the tangent. By visible normals: a view of the stretched surface
// reflects into the cap of the sphere above -v.z evenly (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with
// Spherical Caps"). Of a sphere equal strips have equal areas (Archimedes); of the cap a strip has the share that its arc
// has.
struct LobeSampling {
  vec3 v, stretched; // the view, and of the stretched surface: local, unit
  vec2 alpha;
  int strips, perStrip;
  float G1;          // masking of the view
};

struct LobePoint {
  vec3 direction; // local, unit
  float weight;   // G2 / G1 times its share; 0 below the surface
  float VoH;
  float density;  // of the lobe there, per steradian, over its share: 1 / the solid angle that the point stands for
};

LobeSampling lobeSampling(Shader s, vec2 alpha, int strips, int perStrip) {
  LobeSampling q;
  q.v = localView(s);
  q.stretched = normalize(vec3(alpha * q.v.xy, q.v.z));
  q.alpha = alpha;
  q.strips = strips;
  q.perStrip = perStrip;
  q.G1 = 2.0 * q.v.z / (q.v.z + length(vec3(alpha * q.v.xy, q.v.z)));
  return q;
}

float arcOf(LobeSampling q, float x) {
  float radius = sqrt(max(1.0 - x * x, 0.0));
  return q.stretched.z >= radius ? kPi : acos(clamp(-q.stretched.z / max(radius, 1e-6), -1.0, 1.0));
}

float stripAt(LobeSampling q, int strip) { return (2.0 * float(strip) + 1.0) / float(q.strips) - 1.0; }

float sumOfArcs(LobeSampling q) {
  float sum = 0.0;
  for (int k = 0; k < q.strips; ++k) sum += arcOf(q, stripAt(q, k));
  return sum * float(q.perStrip);
}

LobePoint lobePoint(LobeSampling q, int strip, int place, float arcs) {
  float x = stripAt(q, strip), arc = arcOf(q, x), radius = sqrt(1.0 - x * x), share = arc / arcs;
  float shift = q.perStrip > 1 ? ((strip & 1) == 0 ? 0.25 : 0.75) : 0.5;
  float angle = arc * (2.0 * (float(place) + shift) / float(q.perStrip) - 1.0);
  vec3 sum = vec3(x, radius * sin(angle), radius * cos(angle)) + q.stretched;
  vec3 h = normalize(vec3(q.alpha * sum.xy, max(sum.z, 1e-6)));
  LobePoint p;
  p.VoH = dot(q.v, h);
  p.direction = 2.0 * p.VoH * h - q.v;
  p.VoH = saturate(p.VoH);
  float D = D_GGXAnisotropic(q.alpha.x, q.alpha.y, h.x, h.y, h.z);
  p.density = q.G1 * D / (4.0 * q.v.z * share);
  p.weight = p.direction.z <= 0.0 ? 0.0 : share * 4.0 * q.v.z * p.direction.z * anisotropicVisibility(q.alpha, q.v, p.direction) / q.G1;
  return p;
}

// What of even light the lobe reflects once.
struct LobeAlbedo {
  float E;  // at F = 1
  float B;  // of Fresnel's weight
  vec3 F;   // of fresnelOf
};

const int kAlbedoStrips = 6;

LobeAlbedo lobeAlbedo(Shader s) {
  LobeSampling q = lobeSampling(s, alphasOf(s, kLeastAlpha), kAlbedoStrips, kAlbedoStrips);
  float arcs = sumOfArcs(q);
  LobeAlbedo a = LobeAlbedo(0.0, 0.0, vec3(0.0));
  for (int k = 0; k < kAlbedoStrips * kAlbedoStrips; ++k) {
    LobePoint p = lobePoint(q, k / kAlbedoStrips, k % kAlbedoStrips, arcs);
    a.E += p.weight;
    a.B += p.weight * fresnelWeight(p.VoH);
    a.F += p.weight * fresnelOf(s, p.VoH);
  }
  return a;
}

