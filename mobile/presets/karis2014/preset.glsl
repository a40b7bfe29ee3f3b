// The formulas of karis2014, as Brian Karis prints them in "Physically Based Shading on Mobile" (2014).

// EnvBRDFApprox, after Lazarov 2013.
real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV) {
  const real4 c0 = real4(R(-1.0), R(-0.0275), R(-0.572), R(0.022));
  const real4 c1 = real4(R(1.0), R(0.0425), R(1.04), R(-0.04));
  PRECISE real4 r = Roughness * c0 + c1;
  PRECISE real e = R(-9.28) * NoV;
  PRECISE real a004 = min(r.x * r.x, exp2(e)) * r.x + r.y;
  PRECISE real2 AB = real2(R(-1.04) * a004 + r.z, R(1.04) * a004 + r.w);
  return AB;
}

// The same for F0 = 0.04.
real presetEnvironmentBrdfNonmetal(real Roughness, real NoV) {
  const real2 c0 = real2(R(-1.0), R(-0.0275));
  const real2 c1 = real2(R(1.0), R(0.0425));
  PRECISE real2 r = Roughness * c0 + c1;
  PRECISE real e = R(-9.28) * NoV;
  PRECISE real E = min(r.x * r.x, exp2(e)) * r.x + r.y;
  return E;
}

// D_Approx: a spherical Gaussian about the reflection vector.
real3 presetDirectLobe(MobileShadingModelContext c, MobileFrame f, real32x3 L, real NoL) {
  real RoL = real(dot32(widen(f.reflection), L));
  PRECISE real a = c.Roughness * c.Roughness;
  PRECISE real a2 = a * a;
  PRECISE real32 rcp_a2 = R32(1.0) / real32(a2);
  PRECISE real32 c32 = R32(0.72134752) * rcp_a2 + R32(0.39674113);
  real k = real(c32);
  PRECISE real x = k * RoL - k;
  PRECISE real32 d = rcp_a2 * real32(exp2(x));
  PRECISE real scale = NoL * real(d);
  PRECISE real3 specular = scale * c.SpecularColor;
  return specular;
}

// KHR_lights_punctual or Unreal Engine 4, as the scene says.
real32 presetDistanceFalloff(int falloff, real32 d2, real32 range, real32 exponent) {
  return distanceFalloff(falloff, d2, range, exponent);
}

// KHR_lights_punctual, "Inner and Outer Cone Angles".
real presetSpotCone(real cosAngle, real cosInner, real cosOuter) {
  PRECISE real x = (cosAngle - cosOuter) / max(R(0.001), cosInner - cosOuter);
  real s = saturate(x);
  return s * s;
}

// The mips of Unreal Engine 4's reflection captures.
real presetCaptureMip(real Roughness) {
  PRECISE real mip = R(5.0) + R(1.2) * log2(max(Roughness, R(0.001)));
  return max(mip, R(0.0));
}
