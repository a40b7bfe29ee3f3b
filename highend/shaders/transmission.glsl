// Light that passes through the base, where the permutation has it: docs/shading.md 13. Through a thin wall a GGX lobe about the
// direction of the eye's ray; through a body a lobe about each direction in which light leaves it; and diffuse light of the
// other side. What lies behind is the backdrop, and the environment where that has nothing.
#include "gpu/shaders/backdrop.glsl"
#include "shading/refraction.glsl"

bool mayTransmit() { return (kMayFeatures & kFeatureTransmission) != 0u; }
bool mayDiffuse() { return (kMayFeatures & kFeatureDiffuseTransmission) != 0u; }
bool mayPassThrough() { return (kMayFeatures & kFeatureThrough) != 0u; }

// Side of the square that a lobe of this alpha lights at unit distance: the lobe has its peak, 1 / (4 pi alpha^2) per
// steradian, over as large a solid angle.
const float kSideOfLobe = 3.5449077;

struct Through {
  vec3 weight;  // of light that keeps its direction
  vec3 diffuse; // of the other side's illuminance, over pi
  Shader wall;  // the mirrored surface, whose reflection is what passes through a thin wall
};

// A surface whose reflection lobe is a transmitted one: F = 1, and as much light as of a lobe that loses none.
Shader makePassing(Shader base, vec3 N, vec3 V, float roughness) {
  Shader s = base;
  s.N = N;
  s.V = V;
  s.NoV = clamp(dot(N, V), kMinNoV, 1.0);
  s.anisotropy = s.film = 0.0;
  s.sumAtRim = 0.0;
  s.roughness = roughness;
  s.alpha = sqr(max(roughness, kMinLightRoughness));
  s.diffuseColor = vec3(0.0);
  s.F0 = vec3(1.0);
  s.F90 = 1.0;
  vec2 AB = environmentBrdf(s.NoV, roughness).xy;
  s.factor = vec3(1.0 / max(AB.x + AB.y, 1e-6));
  s.single = vec3(1.0);
  s.multiple = vec3(0.0);
  s.Eavg = 1.0;
  return s;
}

// What of the light that enters the base passes through, and of what colour. `left` of the shader is what its reflection leaves.
Through makeThrough(Shader s, Resolved m) {
  Through t;
  vec3 enters = s.left * (1.0 - m.metallic);
  t.weight = enters * m.transmission * m.baseColor;
  t.diffuse = enters * ((1.0 - m.transmission) * m.diffuseTransmission) * m.diffuseTransmissionColor *
              transmittance(m.absorption, m.thickness);
  t.wall = s;
  if (mayTransmit()) t.wall = makePassing(s, -s.N, s.V - 2.0 * dot(s.N, s.V) * s.N, m.roughness);
  return t;
}

// illuminance: of a surface that faces the light, as it arrives on the other side. L: unit, towards the light. Through a body
// lights do not shine: what it makes of them are caustics.
void addThroughLight(inout Terms terms, Through t, Resolved m, Shader s, vec3 L, vec3 illuminance, float specularScale) {
  if (mayDiffuse()) terms.t[kTermTransmission] += illuminance * (saturate(-dot(s.N, L)) * Fd_Lambert()) * t.diffuse;
  if (!mayTransmit() || m.thickness > 0.0) return;
  float NoL = saturate(dot(t.wall.N, L));
  if (NoL <= 0.0) return;
  vec3 H = safeNormalize(t.wall.V + L, t.wall.N);
  terms.t[kTermTransmission] += illuminance * (specularScale * t.weight) *
                                scatteredOnce(t.wall, t.wall.alpha, NoL, saturate(dot(t.wall.N, H)), saturate(dot(t.wall.V, H)));
}

// The environment's light behind what the backdrop covers.
vec3 overBackdrop(vec3 environment, vec3 origin, vec3 direction, float alpha) {
  vec4 seen = seenBehind(origin, direction, kSideOfLobe * alpha);
  return environment * (1.0 - seen.w) + seen.xyz;
}

// How much a reflection within widens the lobe of what leaves after it, in alpha of the surface: fitted against the truth.
const float kSpreadWithin = 1.5;
// Surfaces that light is followed to within a body, and the share of it that is worth another one. The last gets what is left.
const int kMostCrossings = 8;
const float kWorthFollowing = 0.01;

vec3 environmentOf(Shader passing) { return hasEnvironment() ? reflectedLight(passing) : vec3(0.0); }

// Where light leaves a body: the lobe about a direction. A lobe that is longer in the plane of incidence is read three
// times: in the middle, and a step to both sides.
struct Leaving {
  vec3 direction; // unit
  vec3 step;      // to the other two reads; 0: there are none
  float alpha;    // of each read
};

// across, along: alpha across the plane of incidence, and in it, where `normal` lies, too. Each read is wider by a share
// of what the lobe is longer. Share and distance are fitted against the truth. There is one read where the lobe is about
// round.
Leaving leavingAlong(vec3 direction, vec3 normal, float across, float along) {
  float longer = sqrt(max(sqr(along) - sqr(across), 0.0));
  if (longer <= 0.2 * across) return Leaving(direction, vec3(0.0), sqrt(across * along));
  vec3 side = safeNormalize(normal - dot(normal, direction) * direction, direction);
  return Leaving(direction, 1.2 * longer * side, sqrt(sqr(across) + sqr(0.6 * longer)));
}

// One place in the shader for all reads of a body: a driver's compiler takes long for each.
vec3 environmentOver(Shader s, Leaving l) {
  vec3 light = vec3(0.0);
  int reads = dot(l.step, l.step) > 0.0 ? 3 : 1;
  for (int k = 0; k < reads; ++k) {
    vec3 direction = safeNormalize(l.direction + float(k - reads / 2) * l.step, l.direction);
    float weight = reads == 1 ? 1.0 : k == 1 ? 0.5 : 0.25;
    light += weight * environmentOf(makePassing(s, direction, direction, sqrt(min(l.alpha, 1.0))));
  }
  return light;
}

// Through a body, of one index of refraction, without the weight. Light that is reflected within leaves at one of the next
// surfaces: at the rim most of it turns several times, and every turn shows another side of the surroundings.
vec3 throughBody(Shader s, Point p, Resolved m, float ior, vec3 sky) {
  float ofSurface = sqr(m.roughness);
  Refraction r = throughSphere(s.N, s.V, ior, m.thickness, ofSurface);
  float alpha = alphaOfRefraction(ofSurface, ior, r.bending);
  vec3 inside = r.inside, exit = r.exit, kept = transmittance(m.absorption, r.path), light = vec3(0.0);
  Leaving leaving = leavingAlong(r.outside, exit, alphaOfTurn(ofSurface, turnOfRefraction2(1.0 / ior)),
                                 alphaOfTurn(ofSurface, turnOfRefraction2(r.bending)));
  for (int i = 0; i < kMostCrossings; ++i) {
    Crossing crossing = crossingFromWithin(inside, exit, ior, ofSurface);
    float reflected = crossing.reflected, c = max(-dot(crossing.reflection, exit), 0.0); // c: of the chord to the next surface
    vec3 left = transmittance(m.absorption, m.thickness * c);
    float worth = max(max(kept.x, kept.y), kept.z) * reflected;
    bool isLast = i == kMostCrossings - 1 || worth < kWorthFollowing;
    if (i > 0) leaving = Leaving(crossing.outside, vec3(0.0), alpha);
    vec3 seen = environmentOver(s, leaving) * sky;
    if (i == 0) seen = overBackdrop(seen, p.position + r.path * inside, r.outside, alpha);
    // The last: as if all that follow were like it, a geometric series.
    vec3 lost = isLast ? (1.0 - left) / max(1.0 - reflected * left, 1e-6) : vec3(1.0);
    light += kept * (1.0 - reflected * lost) * seen;
    if (isLast) break;
    inside = crossing.reflection;
    exit = safeNormalize(2.0 * c * inside + exit, inside);
    kept *= reflected * left;
    alpha = sqrt(sqr(alpha) + sqr(kSpreadWithin * ofSurface));
  }
  return light;
}

// From everywhere but lights. sky: scale of the environment's light; irradianceOverPi: of the other side, in that scale.
void addThroughEnvironment(inout Terms terms, Through t, Resolved m, Shader s, Point p, vec3 sky, vec3 irradianceOverPi) {
  if (mayDiffuse()) terms.t[kTermTransmission] += irradianceOverPi * t.diffuse * m.occlusion;
  if (!mayTransmit() || m.transmission <= 0.0) return;
  vec3 light = vec3(0.0);
  if (m.thickness > 0.0) {
    vec3 iors = dispersedIors(m.ior, m.dispersion);
    // One turn for all channels where they share an index.
    int turns = m.dispersion > 0.0 ? 3 : 1;
    for (int c = 0; c < turns; ++c) {
      vec3 ofIndex = throughBody(s, p, m, turns == 1 ? m.ior : iors[c], sky);
      if (turns == 1)
        light = ofIndex;
      else
        light[c] = ofIndex[c];
    }
  } else {
    t.wall.captures = s.captures;
    light = overBackdrop(environmentOf(t.wall) * sky, p.position, -s.V, t.wall.roughness * t.wall.roughness);
  }
  terms.t[kTermTransmission] += light * t.weight * m.occlusion;
}
