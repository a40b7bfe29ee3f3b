// What the specular lobe reflects of the environment: the prefiltered levels, the panorama's own cells for what is
// sharper, and the lamps one by one where the levels' lobes are not the true one.

// Of the environment, or of the captures in its place. direction: unit.
vec3 imageRadiance(Shader s, vec3 direction, float mip) {
  if ((kBaked & kBakedCaptures) != 0u) return capturedRadiance(s.captures, direction, mip);
  return kPanorama == 0u ? skyRadianceAtMip(direction, mip, 0) : fineSkyRadianceAtMip(direction, mip);
}

// The reads that stand for the lobe.
const int kTapCount = kOffSpecular == kOffSpecularThreeTaps ? 3
                      : kOffSpecular == kOffSpecularTwoTaps || kOffSpecular == kOffSpecularStretched ? 2 : 1;

const int kMaxTaps = 3;

LobeTap tapOf(Shader s, int i) {
  if (kOffSpecular == kOffSpecularThreeTaps) return threeTap(i, s.NoV, s.roughness);
  if (kOffSpecular == kOffSpecularTwoTaps) return twoTap(i, s.NoV, s.roughness);
  if (kOffSpecular == kOffSpecularStretched) return stretchedTap(i, s.NoV, s.roughness);
  float blend = kOffSpecular == kOffSpecularDominant ? dominantBlend(sqr(s.roughness)) : 1.0;
  return LobeTap(blend, unclampedMip(s.roughness), 1.0);
}

// A read of two levels: alpha^2 of each, and its weight in all that is read over prefilteredLobeIntegral.
struct Read {
  vec3 direction; // unit
  vec2 a2, weight;
};

Read makeRead(vec3 direction, LobeTap tap) {
  PrefilterBlend blend = finePrefilterBlend(tap.mip);
  float lower = sqr(sqr(roughnessFromMip(float(blend.lower) / float(kPrefilterLayers))));
  float upper = sqr(sqr(roughnessFromMip(float(blend.upper) / float(kPrefilterLayers))));
  vec2 integrals = vec2(prefilteredLobeIntegral(lower), prefilteredLobeIntegral(upper));
  return Read(direction, vec2(lower, upper), tap.weight * vec2(1.0 - blend.upperShare, blend.upperShare) / integrals);
}

// A quarter of the squared chord between unit directions: (1 - cos) / 2 without its cancellation.
float quarterChord2(vec3 a, vec3 b) {
  vec3 d = a - b;
  return 0.25 * dot(d, d);
}

// 1 - E(NoL) at this roughness as a cubic of (NoL - .1) / .9, through four values of the table; below .1, where it rises
// steeply for smooth surfaces and light is faint, its value there.
vec4 lostAt(Shader s) {
  vec2 at[4] = vec2[](environmentBrdf(0.1, s.roughness).xy, environmentBrdf(0.4, s.roughness).xy,
                      environmentBrdf(0.7, s.roughness).xy, environmentBrdf(1.0, s.roughness).xy);
  vec4 y = 1.0 - vec4(at[0].x + at[0].y, at[1].x + at[1].y, at[2].x + at[2].y, at[3].x + at[3].y);
  return vec4(y.x, -5.5 * y.x + 9.0 * y.y - 4.5 * y.z + y.w, 9.0 * y.x - 22.5 * y.y + 18.0 * y.z - 4.5 * y.w,
              4.5 * (-y.x + 3.0 * y.y - 3.0 * y.z + y.w)); // its coefficients from the constant on
}

float lostOf(vec4 c, float NoL) {
  float x = max(NoL - 0.1, 0.0) / 0.9;
  return c.x + x * (c.y + x * (c.z + x * c.w));
}

// A node of the tree stands for all below it where the scale of the lobes is at least this many times its spread; or less,
// in proportion, where its light is less than this share of what is reflected (Walter et al. 2005).
const float kLampOpening = 50.0;
const float kLampNoticed = 0.05;

// Where a light of direction L lies for the lobe.
struct LampPlace {
  float NoL, NoH2, VoH2;
  float scale;    // lobeScale, and that of a level's lobe about the mirror direction
  float radiance; // at most about that of a light of 1 in the mean over the lobe, anywhere within 2 sqrt(spread)
};

LampPlace placeOf(Shader s, vec3 R, float a2, vec3 L, float spread) {
  LampPlace p;
  p.NoL = dot(s.N, L);
  p.VoH2 = max(0.5 + 0.5 * dot(s.V, L), 1e-6);
  float NoVL = max(s.NoV + p.NoL, 0.0);
  p.NoH2 = min(NoVL * NoVL / (4.0 * p.VoH2), 1.0);
  float u = quarterChord2(R, L), radius = sqrt(spread);
  float nearest = max(min(sqrt(1.0 - p.NoH2) - radius / sqrt(p.VoH2), sqrt(u) - radius), 0.0), t = a2 + sqr(nearest);
  p.scale = min(min(lobeScale(a2, p.NoH2, p.VoH2), 4.0 * (u + a2)), 1.0);
  p.radiance = a2 * (0.25 * kInvPi) / (t * t);
  return p;
}

// Whether all below a node is under the horizon of the surface and behind what is read of the levels.
bool givesNothing(LampPlace p, Read reads[kMaxTaps], vec3 L, float spread) {
  float highest = p.NoL;
  for (int i = 0; i < kTapCount; ++i) highest = max(highest, dot(reads[i].direction, L));
  return highest + 2.0 * sqrt(spread) + 0.5 * spread <= 0.0;
}

// What the lamps give beside what the levels hold of them: all of the light of compact ones, which no level holds; of
// the others the difference of the lobes (shading/lamps.glsl). tail: share of the levels in all that is read. Compact
// lamps are scaled by it, too: the panorama's cells hold the rest of them.
vec3 lampDifference(Shader s, vec3 R, Read reads[kMaxTaps], float tail, vec3 radiance) {
  vec3 sum = vec3(0.0);
  float alpha = max(sqr(s.roughness), sqr(roughnessFromMip(kSharpestPrefilteredMip))), a2 = sqr(alpha);
  float noticed = 1.0 / max(kLampNoticed * luminance(radiance), 1e-30);
  vec4 lost = kCompensation == kCompensationKullaConty ? lostAt(s) : vec4(0.0);
  uint n = 0u;
  do {
    vec4 place = lamps[n].directionSpread, content = lamps[n].lightNext;
    uint next = uint(content.w);
    LampPlace p = placeOf(s, R, a2, place.xyz, place.w);
    if (givesNothing(p, reads, place.xyz, place.w)) {
      n = next >> 2u;
      continue;
    }
    float opening = kLampOpening * min(luminance(content.xyz) * p.radiance * noticed, 1.0);
    if ((next & kLampIsLeaf) == 0u && p.scale < opening * place.w) {
      ++n;
      continue;
    }
    float NoL = max(p.NoL, 0.0);
    bool isCompact = (next & kLampIsCompact) != 0u;
    // The lobe's mean over the light. In a difference both lobes would have it, and it nearly cancels.
    float mean = isCompact ? meanOfGgx(a2, p.NoH2, p.VoH2, place.w) : 1.0;
    vec3 scattered = scatteredOnce(s, alpha, NoL, sqrt(p.NoH2), sqrt(p.VoH2)) * mean;
    if (kCompensation == kCompensationKullaConty) // from the irradiance to its own lobe
      scattered += s.multiple * (NoL * (kullaContyLobe(1.0 - lostOf(lost, NoL), s.Eavg) - Fd_Lambert()));
    float levels = 0.0, scale = p.scale;
    for (int i = 0; i < kTapCount; ++i) {
      float u = quarterChord2(reads[i].direction, place.xyz);
      vec2 t = u + reads[i].a2 * (1.0 - u);
      scale = min(scale, 4.0 * t.x);
      levels += max(1.0 - 2.0 * u, 0.0) * dot(reads[i].weight, 1.0 / (t * t));
    }
    sum += content.xyz * (isCompact ? scattered : (scattered - levels * s.single) * lampShare(scale, place.w));
    n = next >> 2u;
  } while (n != 0u);
  return sum * tail;
}

// By reads about the lobe. What is sharper than any level is a core, read once in the mirror direction, and the tail
// that the levels have.
vec3 readReflection(Shader s) {
  vec3 R = 2.0 * dot(s.N, s.V) * s.N - s.V;
  float mip = unclampedMip(s.roughness), tail = 1.0;
  vec3 radiance = vec3(0.0);
  Read reads[kMaxTaps];
  for (int i = 0; i < kTapCount; ++i) {
    LobeTap tap = tapOf(s, i);
    vec3 direction = safeNormalize(mix(s.N, R, tap.blend), s.N);
    if (kLamps != 0u) reads[i] = makeRead(direction, tap);
    radiance += imageRadiance(s, direction, tap.mip) * tap.weight;
  }
  if (kPanorama != 0u && mip < kSharpestPrefilteredMip) {
    SharpLobe lobe = sharpLobe(mip);
    tail = lobe.tail;
    radiance = mix(panoramaMean(R, lobe.width), radiance, tail);
  }
  if (kLamps == 0u) return radiance * s.single;
  return max(radiance * s.single + lampDifference(s, R, reads, tail, radiance), 0.0);
}

#ifdef PARITY_LOBES
#include "highend/shaders/summed_reflection.glsl"

// A lobe with a sum at the rim is a sum up to the first N.V, and read from the second one on. Up to the first roughness it
// is read everywhere, since reads of a mirror are exact.
const vec2 kSumToRead = vec2(0.3, 0.4), kMirrorToSum = vec2(0.02, 0.04);

float shareOfSum(Shader s) {
  if (isAnisotropic(s)) return 1.0;
  if (s.sumAtRim <= 0.0 || kOffSpecular != kOffSpecularThreeTaps) return 0.0;
  return s.sumAtRim * (1.0 - smoothstep(kSumToRead.x, kSumToRead.y, s.NoV)) *
         smoothstep(kMirrorToSum.x, kMirrorToSum.y, s.roughness);
}
#endif

// Radiance of what the lobe scatters once.
vec3 reflectedLight(Shader s) {
#ifdef PARITY_LOBES
  float share = shareOfSum(s);
  vec3 read = vec3(0.0), sum = vec3(0.0);
  if (share < 1.0) read = readReflection(s);
  if (share > 0.0) sum = summedReflection(s);
  return mix(read, sum, share);
#else
  return readReflection(s);
#endif
}
