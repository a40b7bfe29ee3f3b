// The formulas of ue4-2020: Unreal Engine 4's mobile base pass (BRDF.ush, MobileGGX.ush and MobileShadingModels.ush,
// 2020).

// EnvBRDFApprox; B fades out below F0 = 2 %, which means shadowing.
real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV) {
  const real4 c0 = real4(R(-1.0), R(-0.0275), R(-0.572), R(0.022));
  const real4 c1 = real4(R(1.0), R(0.0425), R(1.04), R(-0.04));
  PRECISE real4 r = Roughness * c0 + c1;
  PRECISE real e = R(-9.28) * NoV;
  PRECISE real a004 = min(r.x * r.x, exp2(e)) * r.x + r.y;
  PRECISE real2 AB = real2(R(-1.04) * a004 + r.z, R(1.04) * a004 + r.w);
  PRECISE real B = AB.y * saturate(R(50.0) * SpecularColor.y);
  return real2(AB.x, B);
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

// CalcSpecular: GGX about the half vector; Fresnel and visibility are 1/4 + Roughness/4.
real3 presetDirectLobe(MobileShadingModelContext c, MobileFrame f, real32x3 L, real NoL) {
  real32 NoH = real32(max(dot3(f.N, halfVector(f.N, f.V, L)), R(0.0)));
  PRECISE real32 OneMinusNoHSqr = R32(1.0) - NoH * NoH;
  PRECISE real a = c.Roughness * c.Roughness;
  PRECISE real n = real(NoH * real32(a));
  PRECISE real nn = n * n;
  PRECISE real32 p32 = real32(a) / (OneMinusNoHSqr + real32(nn));
  real p = real(p32);
  PRECISE real d = p * p;
  PRECISE real v = c.Roughness * R(0.25) + R(0.25);
  PRECISE real scale = NoL * (v * min(d, R(2048.0)));
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
