// The environment by a lobe far from round, that of an anisotropic surface or of any at a grazing angle: a sum over
// directions of the lobe, each a read of the prefiltered level that is as wide as the part of the lobe for which it stands
// (Krivanek and Colbert 2008, "Real-Time Shading with Filtered Importance Sampling"), or of the panorama's cells for smaller
// parts. Lamps that neither holds are lights.

// Directions of one sum: of a lobe that is sharp across the tangent, many.
const int kImagePoints = 128, kSharpImagePoints = 512;
const float kSharpAlpha = 0.005;
// Solid angle of a point over alpha^2 of its level, whose lobe has its peak, 1 / (4 pi alpha^2), over 4 pi of it. Sharper levels
// are less blurred, but show gaps between the points where a lamp is small. A stretched lobe, whose points are far apart along
// the tangent, gains more by the former (docs/shading.md 11).
float solidAngleOfLevel(Shader s) { return isAnisotropic(s) ? 18.0 : 4.0 * kPi; }

// Whether this solid angle is read from the panorama's cells, which hold all lamps: no level is as sharp.
bool isReadFromCells(Shader s, float solidAngle) {
  return kPanorama != 0u && (kBaked & kBakedCaptures) == 0u &&
         solidAngle < solidAngleOfLevel(s) * sqr(sqr(roughnessFromMip(kSharpestPrefilteredMip)));
}

// Mean radiance of about this solid angle.
vec3 radianceOfPoint(Shader s, vec3 direction, float solidAngle) {
  if (isReadFromCells(s, solidAngle)) return panoramaMean(direction, sqrt(solidAngle));
  float mip = min(unclampedMip(sqrt(sqrt(solidAngle / solidAngleOfLevel(s)))), float(kPrefilterRoughestMip));
  return imageRadiance(s, direction, mip);
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

// Of the compact lamps, which are the first. Where the points about a lamp are read from cells, these hold it.
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
      bool isHeld = isReadFromCells(s, 1.0 / max(density, 1e-12));
      vec3 scattered = isHeld ? vec3(0.0) : lampInSum(s, place.xyz, place.w);
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
