// Anisotropy and thin films of the mobile path, in the forms of the preset (shading/mobile_microfacets.glsl). Fully rough
// materials have neither.

// Whether some material of the permutation may show the lobe.
bool mayShow(uint feature) {
  return (kMayFeatures & feature) != 0u && (kMustFeatures & kFeatureFullyRough) == 0u && kForceFullyRough == 0u;
}
bool showsAnisotropy() { return kAnisotropy != kAnisotropyNone && mayShow(kFeatureAnisotropy); }
bool showsFilm() { return kIridescence != kIridescenceNone && mayShow(kFeatureIridescence); }

struct Microfacets {
  bool isAnisotropic;
  vec3 T, B;
  float squeeze;
  MobileFrame bent; // about which the environment is read
  real bentNoV;
  real readRoughness;
};

// The material's roughness becomes that of the round lobe, and its specular colour that under the film.
Microfacets makeMicrofacets(Resolved r, inout MobileMaterial m, MobileFrame frame, real NoV, bool fullyRough) {
  Microfacets f;
  f.isAnisotropic = false;
  f.T = f.B = vec3(0.0);
  f.squeeze = 1.0;
  f.bent = frame;
  f.bentNoV = NoV;
  f.readRoughness = m.Roughness;
  if (showsFilm() && !fullyRough && r.iridescence > 0.0) {
    real share = real(r.iridescence);
    m.DielectricSpecular = underFilm(m.DielectricSpecular, filmTint(r.filmIor, r.filmThickness, m.DielectricSpecular, NoV), share);
    PRECISE real ofMetal = share * m.Metallic; // the base colour is diffuse, too, where the material is no metal
    m.BaseColor = underFilm(m.BaseColor, filmTint(r.filmIor, r.filmThickness, m.BaseColor, NoV), ofMetal);
  }
  if (showsAnisotropy() && !fullyRough && r.anisotropy > 0.0) {
    MobileAnisotropy a = mobileAnisotropy(m.Roughness, real(r.anisotropy));
    m.Roughness = a.Roughness;
    f.isAnisotropic = true;
    f.T = r.tangent;
    f.B = cross(frame.N32, r.tangent);
    f.squeeze = a.squeeze;
    f.readRoughness = a.readRoughness;
    f.bent = mobileFrame(bentNormal(frame.N32, f.B, frame.V32, float(a.share)), frame.V32);
    f.bentNoV = viewCosine(kEnvironmentBrdf, f.bent);
  }
  return f;
}

// A light's specular part by the elongated lobe. Lobes about the reflection vector lie about that of the bent normal.
void squeezeLight(inout MobileDirectLighting lighting, Microfacets m, int sun, MobileShadingModelContext c, MobileFrame f, vec3 L) {
  if (!showsAnisotropy() || !m.isAnisotropic) return;
  real NoL = cosineOf(f.N, L);
  RefitHalfVector cosines = refitHalfVector(f.N32, f.V32, L);
  vec3 h = safeNormalize(f.V32 + L, f.N32);
  float sin2 = squeezedSin2(dot(m.T, h), dot(m.B, h), m.squeeze);
  if (sun == kSunRefit || sun == kSunRefitNonmetal) {
    lighting.Specular = squeezedRefitLight(c.lobe, NoL, cosines, sin2);
    return;
  }
#ifdef PARITY_OWN_presetDirectLobe
  if (sun == kSunOwn) {
    lighting.Specular = presetDirectLobe(c, m.bent, L, NoL);
    return;
  }
#endif
#ifdef PARITY_OWN_presetLocalLobe
  if (sun == kSunOwnLocal) {
    lighting.Specular = presetLocalLobe(c, m.bent, L, NoL);
    return;
  }
#endif
  real lobe = R(0.0);
  float RoL = dot(widen(m.bent.reflection), L);
  if (sun == kSunDApprox) lobe = D_Approx(c.Roughness, real(RoL));
  if (sun == kSunPhongApprox) lobe = PhongApprox(c.Roughness, real(max(RoL, 0.0)));
  if (sun == kSunCalcSpecular) lobe = squeezedCalcSpecular(c.Roughness, max(cosines.NoH, 0.0), sin2);
  PRECISE real k = NoL * lobe;
  lighting.Specular = product(c.SpecularColor, k);
}
