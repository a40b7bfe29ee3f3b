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

// Directions of the lobe by visible normals: a view of the stretched surface reflects into the cap of the sphere above -v.z
// evenly (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"). They lie on a Fibonacci lattice.
struct LobeSampling {
  vec3 v, stretched; // the view, and of the stretched surface: local, unit
  vec2 alpha;
  float count;
  float G1; // masking of the view
};

struct LobePoint {
  vec3 direction; // local, unit
  float weight;   // G2 / G1 over the count; 0 below the surface
  float VoH;
  float density;  // of the lobe there, per steradian, times the count: 1 / the solid angle that the point stands for
};

LobeSampling lobeSampling(Shader s, vec2 alpha, int count) {
  LobeSampling q;
  q.v = localView(s);
  float stretch = anisotropicLength(alpha.x, alpha.y, q.v.x, q.v.y, q.v.z);
  q.stretched = vec3(alpha * q.v.xy, q.v.z) / stretch;
  q.alpha = alpha;
  q.count = float(count);
  q.G1 = 2.0 * q.v.z / (q.v.z + stretch);
  return q;
}

// Of the points about the direction whose half vector is h, per steradian.
float densityOf(LobeSampling q, vec3 h) {
  return q.count * q.G1 / (4.0 * q.v.z) * D_GGXAnisotropic(q.alpha.x, q.alpha.y, h.x, h.y, h.z);
}

LobePoint lobePoint(LobeSampling q, int i) {
  float z = (1.0 - (float(i) + 0.5) / q.count) * (1.0 + q.stretched.z) - q.stretched.z;
  float radius = sqrt(max(1.0 - z * z, 0.0)), turn = 2.0 * kPi * fract(float(i) * 0.618033989);
  vec3 sum = vec3(radius * cos(turn), radius * sin(turn), z) + q.stretched;
  vec3 h = normalize(vec3(q.alpha * sum.xy, max(sum.z, 1e-6)));
  LobePoint p;
  p.VoH = dot(q.v, h);
  p.direction = 2.0 * p.VoH * h - q.v;
  p.VoH = saturate(p.VoH);
  float perPoint = q.G1 / (4.0 * q.v.z), V = anisotropicVisibility(q.alpha, q.v, p.direction);
  p.density = densityOf(q, h);
  p.weight = p.direction.z <= 0.0 ? 0.0 : p.direction.z * V / (q.count * perPoint);
  return p;
}

// What of even light the lobe reflects once.
struct LobeAlbedo {
  float E, B; // at F = 1, and of Fresnel's weight: of an anisotropic lobe
  vec3 F;     // mean of fresnelOf over the lobe, where there is a film
};

const int kAlbedoPoints = 233, kFilmPoints = 55;

LobeAlbedo lobeAlbedo(Shader s) {
  LobeAlbedo a = LobeAlbedo(0.0, 0.0, vec3(0.0));
  vec2 alpha = alphasOf(s, kLeastAlpha);
  if (isAnisotropic(s)) {
    LobeSampling q = lobeSampling(s, alpha, kAlbedoPoints);
    for (int i = 0; i < kAlbedoPoints; ++i) {
      LobePoint p = lobePoint(q, i);
      a.E += p.weight;
      a.B += p.weight * fresnelWeight(p.VoH);
    }
  }
  if (hasFilm(s)) {
    LobeSampling q = lobeSampling(s, alpha, kFilmPoints);
    float E = 0.0;
    for (int i = 0; i < kFilmPoints; ++i) {
      LobePoint p = lobePoint(q, i);
      E += p.weight;
      a.F += p.weight * fresnelOf(s, p.VoH);
    }
    a.F /= max(E, 1e-6);
  }
  return a;
}
