// The environment by a lobe far from round, that of an anisotropic surface or of any at a grazing angle: a sum over
// directions of the lobe, each a read of the prefiltered level that is as wide as the part of the lobe for which it
// stands (Krivanek and Colbert 2008, "Real-Time Shading with Filtered Importance Sampling"). Where no level is as sharp,
// it is a read of the panorama's cells. Lamps that neither holds are lights.

// Directions of one sum: of a lobe of small alpha, many.
const int kImagePoints = 128, kSharpImagePoints = 512;
const float kSharpAlpha = 0.005;
// A level of alpha has its peak 1 / (4 pi alpha^2), so it stands for a solid angle of 4 pi alpha^2. An anisotropic lobe
// takes sharper levels: its points lie far apart along the tangent, and wide levels would blur it across
// (docs/shading.md 11h).
float solidAngleOfLevel(Shader s) { return isAnisotropic(s) ? 18.0 : 4.0 * kPi; }

// Share of the panorama's cells in what is read of this solid angle; levels have the rest. The cells hold all lamps.
float shareOfCells(Shader s, float solidAngle) {
  if (kPanorama == 0u || (kBaked & kBakedCaptures) != 0u) return 0.0;
  float sharpest = solidAngleOfLevel(s) * sqr(sqr(roughnessFromMip(kSharpestPrefilteredMip)));
  return 1.0 - smoothstep(0.7 * sharpest, 1.4 * sharpest, solidAngle);
}

// Mean radiance of about this solid angle.
vec3 radianceOfPoint(Shader s, vec3 direction, float solidAngle) {
  float cells = shareOfCells(s, solidAngle);
  vec3 ofCells = vec3(0.0), ofLevels = vec3(0.0);
  if (cells > 0.0) ofCells = panoramaMean(direction, sqrt(solidAngle));
  if (cells < 1.0) {
    float mip = min(unclampedMip(sqrt(sqrt(solidAngle / solidAngleOfLevel(s)))), float(kPrefilterRoughestMip));
    ofLevels = imageRadiance(s, direction, mip);
  }
  return mix(ofLevels, ofCells, cells);
}

// Mean over a light of this spread: to second order that of a lobe wider by what half vectors turn (meanOfGgx).
vec3 lampInSum(Shader s, vec3 L, float spread) {
  float NoL = dot(s.N, L);
  if (NoL <= 0.0) return vec3(0.0);
  float VoH2 = max(0.5 + 0.5 * dot(s.V, L), 1e-6);
  float turned = spread * (0.25 + 0.25 / VoH2);
  vec2 alpha = alphasOf(s, kLeastAlpha);
  return scatteredAnisotropic(s, sqrt(min(alpha * alpha + turned, vec2(1.0))), L);
}

// Of the compact lamps, which are the first. What the points about a lamp read of cells has it already.
vec3 compactLampsInSum(Shader s, LobeSampling q) {
  vec3 sum = vec3(0.0);
  vec4 lost = kCompensation == kCompensationKullaConty ? lostAt(s) : vec4(0.0);
  uint n = 0u;
  do {
    vec4 place = lamps[n].directionSpread, content = lamps[n].lightNext;
    uint next = uint(content.w);
    if ((next & kLampIsCompact) == 0u) break;
    bool isLeaf = (next & kLampIsLeaf) != 0u;
    if (isLeaf) {
      float density = densityOf(q, safeNormalize(q.v + toLocal(s, place.xyz), q.v));
      vec3 scattered = lampInSum(s, place.xyz, place.w) * (1.0 - shareOfCells(s, 1.0 / max(density, 1e-12)));
      float NoL = max(dot(s.N, place.xyz), 0.0);
      if (kCompensation == kCompensationKullaConty) // from the irradiance to its own lobe
        scattered += s.multiple * (NoL * (kullaContyLobe(1.0 - lostOf(lost, NoL), s.Eavg) - Fd_Lambert()));
      sum += content.xyz * scattered;
    }
    n = isLeaf ? next >> 2u : n + 1u;
  } while (n != 0u);
  return sum;
}

vec3 summedReflection(Shader s) {
  if (!isAnisotropic(s)) { // any tangent does
    s.T = safeNormalize(s.V - dot(s.N, s.V) * s.N, s.T);
    s.B = cross(s.N, s.T);
  }
  vec2 alpha = alphasOf(s, kLeastAlpha);
  int count = alpha.y < kSharpAlpha ? kSharpImagePoints : kImagePoints;
  LobeSampling q = lobeSampling(s, alpha, count);
  vec3 light = vec3(0.0), weight = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    LobePoint p = lobePoint(q, i);
    if (p.weight <= 0.0) continue;
    vec3 direction = s.T * p.direction.x + s.B * p.direction.y + s.N * p.direction.z;
    vec3 F = p.weight * fresnelOf(s, p.VoH);
    weight += F;
    light += F * radianceOfPoint(s, direction, 1.0 / max(p.density, 1e-12));
  }
  // As much as of even light.
  vec3 reflected = light / max(weight, vec3(1e-12)) * s.single;
  if (kLamps != 0u && (kBaked & kBakedCaptures) == 0u) reflected += compactLampsInSum(s, q);
  return reflected;
}
