// Light that passes through the base, in the forms of the preset (shading/mobile_transmission.glsl). Fully rough materials let
// none through.
#include "gpu/shaders/backdrop.glsl"

// Whether some material of the permutation has it, and the preset shows it.
bool showsTransmission() { return kTransmission != kTransmissionNone && mayShow(kFeatureTransmission); }
bool showsDiffuseTransmission() { return kDiffuseTransmission != kDiffuseTransmissionNone && mayShow(kFeatureDiffuseTransmission); }

struct Through {
  real3 weight;  // of light that keeps its direction
  real3 diffuse; // of the other side's illuminance over pi
};

// Takes from the base's diffuse light what passes through.
Through makeThrough(Resolved r, inout MobileShadingModelContext context, MobileMaterial m, bool fullyRough) {
  Through t;
  t.weight = t.diffuse = real3(R(0.0));
  if (fullyRough) return t;
  real passes = showsTransmission() ? real(r.transmission) : R(0.0);
  real spreads = showsDiffuseTransmission() ? real(r.diffuseTransmission) : R(0.0);
  PRECISE real stays = R(1.0) - passes;
  PRECISE real reflects = stays * (R(1.0) - spreads);
  if (showsTransmission()) {
    PRECISE real share = passes * (R(1.0) - m.Metallic);
    t.weight = kTransmission == kTransmissionAlpha ? grey(share) : product(context.DiffuseColor, passes);
  }
  if (showsDiffuseTransmission()) {
    PRECISE real share = stays * spreads * (R(1.0) - m.Metallic);
    t.diffuse = product(real3(r.diffuseTransmissionColor), share);
  }
  context.DiffuseColor = product(context.DiffuseColor, reflects);
  return t;
}

void addThroughTerm(inout BasePass pass, real3 light) {
  pass.Color = add(pass.Color, light);
  addTerm(pass, kTermTransmission, light);
}

// A light on the other side, whose colour has 1/pi in it.
void addThroughLight(inout BasePass pass, Through t, MobileFrame frame, vec3 color, vec3 L) {
  if (!showsDiffuseTransmission()) return;
  MobileDirectLighting behind;
  behind.Diffuse = product(t.diffuse, cosineOf(frame.N, -L));
  behind.Specular = real3(R(0.0));
  addThroughTerm(pass, clampContribution65000(lightWith(color, behind, R(0.0))));
}

// alpha: the picture behind the pixel as it is, and where it is empty the environment. refracted: one fetch of the
// environment in the direction in which the eye's ray leaves; of a thin wall as the reflection's, mirrored at the surface.
// mixed: of thin walls both, the picture fading out with roughness.
void addThroughEnvironment(inout BasePass pass, Through t, Resolved r, Point p, MobileFrame frame, real Roughness,
                           vec3 reflection, real reflectionMip, uint capture, real MaterialAO) {
  real3 sky = product(real3(view.skyLightColor.xyz), MaterialAO);
  if (showsDiffuseTransmission() && hasEnvironment()) {
    real3 behind = skyDiffuse(real3(-frame.N.x, -frame.N.y, -frame.N.z));
    addThroughTerm(pass, modulate(modulate(behind, sky), t.diffuse));
  }
  if (!showsTransmission()) return;
  vec3 direction = -frame.V32;
  real mip = R(0.0);
  real3 left = t.weight, later = real3(R(0.0));
  real sceneShare = kTransmission == kTransmissionAlpha ? R(1.0) : R(0.0);
  if (kTransmission != kTransmissionAlpha) {
    if (r.thickness > 0.0) {
      float alpha = float(Roughness) * float(Roughness);
      Refraction body = throughSphere(frame.N32, frame.V32, r.ior, r.thickness, alpha);
      direction = body.outside;
      real spread = real(sqrt(alphaOfRefraction(alpha, r.ior, body.bending)));
      mip = kEnvironmentBrdf == kEnvironmentBrdfRefit ? refitTap(spread, R(1.0)).mip : captureMip(spread);
      // What is reflected within leaves at one of the next surfaces: of a rough body as diffuse light from there, of a smooth
      // one, where that would lose the lamps, with the fetch.
      float reflected = reflectedWithin(alpha, r.ior, body.cosine);
      vec3 kept = transmittance(r.absorption, body.path);
      vec3 share = kept * vec3(leavingLater(reflected, kept.x, float(Roughness), r.ior),
                               leavingLater(reflected, kept.y, float(Roughness), r.ior),
                               leavingLater(reflected, kept.z, float(Roughness), r.ior));
      float spreads = min(2.5 * float(Roughness), 1.0);
      if (hasEnvironment())
        later = modulate(modulate(modulate(skyDiffuse(real3(body.again)), sky), left), real3(spreads * share));
      left = product(left, real3((1.0 - reflected) * kept + (1.0 - spreads) * share));
    } else {
      direction = reflection - 2.0 * dot(frame.N32, reflection) * frame.N32;
      mip = reflectionMip;
      if (kTransmission == kTransmissionMixed) sceneShare = mobileSceneShare(Roughness);
    }
  }
  real3 light = real3(R(0.0));
  if (hasEnvironment()) light = modulate(fetchCapture(direction, mip, capture), sky);
  if (kTransmission != kTransmissionRefracted) {
    vec4 seen = float(sceneShare) * backdropTexel(p.position, 1.0, 0.0);
    light = add(product(light, real(1.0 - seen.w)), product(narrow(seen.xyz), MaterialAO));
  }
  addThroughTerm(pass, add(modulate(light, left), later));
}
