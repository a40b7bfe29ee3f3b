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

// One of two levels that a read blends.
struct ReadLevel {
  float a2, integral; // alpha^2; prefilteredLobeIntegral
  float weight;       // in all that is read
};

struct Read {
  vec3 direction; // unit
  ReadLevel lower, upper;
};

ReadLevel readLevel(int level, float weight) {
  float a2 = sqr(sqr(roughnessFromMip(float(level) / float(kPrefilterLayers))));
  return ReadLevel(a2, prefilteredLobeIntegral(a2), weight);
}

Read makeRead(vec3 direction, LobeTap tap) {
  PrefilterBlend blend = finePrefilterBlend(tap.mip);
  return Read(direction, readLevel(blend.lower, tap.weight * (1.0 - blend.upperShare)),
              readLevel(blend.upper, tap.weight * blend.upperShare));
}

float lobeOfLevel(ReadLevel level, float u, float spread) {
  return level.weight * prefilteredLobe(level.a2, level.integral, u, spread);
}

// A node of the tree stands for all below it where the scale of the lobes is at least this many times its spread.
const float kLampOpening = 80.0;

// What the lamps give beside what the levels hold of them: all of the light of compact ones, which no level holds; of
// the others the difference of the lobes (shading/lamps.glsl). tail: share of the levels in all that is read, and in
// what is read of compact lamps, whose lobe is no sharper than the sharpest level's: the panorama's cells have the rest.
vec3 lampDifference(Shader s, Read reads[kMaxTaps], float tail) {
  vec3 sum = vec3(0.0);
  float alpha = max(sqr(s.roughness), sqr(roughnessFromMip(kSharpestPrefilteredMip)));
  for (uint n = 0u; n < lampHead.x;) {
    vec4 place = lamps[n].directionSpread, content = lamps[n].lightNext;
    vec3 L = place.xyz;
    uint next = uint(content.w);
    bool isCompact = n < lampHead.y;
    float NoL = dot(s.N, L), VoH2 = max(0.5 + 0.5 * dot(s.V, L), 1e-6), NoVL = max(s.NoV + NoL, 0.0);
    float NoH2 = min(NoVL * NoVL / (4.0 * VoH2), 1.0);
    float scale = min(lobeScale(sqr(alpha), NoH2, VoH2), 1.0), levels = 0.0;
    for (int i = 0; i < kTapCount; ++i) {
      vec3 d = reads[i].direction - L;
      float u = 0.25 * dot(d, d);
      scale = isCompact ? scale : min(scale, 4.0 * (u + reads[i].lower.a2));
      levels += lobeOfLevel(reads[i].lower, u, place.w) + lobeOfLevel(reads[i].upper, u, place.w);
    }
    if (next != n + 1u && scale < kLampOpening * place.w) {
      ++n;
      continue;
    }
    vec3 difference = isCompact ? vec3(0.0) : -levels * s.single;
    if (NoL > 0.0) difference += scatteredOnce(s, alpha, NoL, sqrt(NoH2), sqrt(VoH2)) * meanOfGgx(sqr(alpha), NoH2, VoH2, place.w);
    if (NoL > 0.0 && kCompensation == kCompensationKullaConty) { // from the irradiance to its own lobe
      vec2 AB = environmentBrdf(NoL, s.roughness).xy;
      difference += s.multiple * (NoL * (kullaContyLobe(AB.x + AB.y, s.Eavg) - Fd_Lambert()));
    }
    sum += content.xyz * difference * (isCompact ? 1.0 : lampShare(scale, place.w));
    n = next;
  }
  return sum * tail;
}

// Radiance of what the lobe scatters once. What is sharper than any level is a core, read once in the mirror direction,
// and the tail that the levels have.
vec3 reflectedLight(Shader s) {
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
  return max(radiance * s.single + lampDifference(s, reads, tail), 0.0);
}
