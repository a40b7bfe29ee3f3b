// Writes what a path's shader would begin with: the point and its resolved material, in the buffers that else hold colour
// and terms. Read back by gpu/surface/material_pass.cpp.
#include "gpu/shaders/path.glsl"

void main() {
  uint i = surfaceEntry();
  if (!mayWrite()) return;
  Point p = makePoint(i);
  Resolved m = resolveMaterial(p, i);
  outColor[i] = vec4(m.baseColor, m.opacity);
  outTermsA[kPlanePosition * planeSize + i] = vec4(p.position, hasFeature(kFeatureUnlit, p.material) ? 1.0 : 0.0);
  outTermsA[kPlaneNormal * planeSize + i] = vec4(m.normal, m.metallic);
  outTermsA[kPlaneView * planeSize + i] = vec4(p.V, m.roughness);
  outTermsA[kPlaneF0 * planeSize + i] = vec4(m.F0, m.F90);
  outTermsA[kPlaneEmissive * planeSize + i] = vec4(m.emissive, m.occlusion);
  outTermsB[(kPlaneGeometricNormal - kTermsInA) * planeSize + i] = vec4(p.geometric, 0.0);
#ifdef PARITY_LOBES
  outTermsB[(kPlaneGeometricNormal - kTermsInA) * planeSize + i].w = m.coatRoughness;
  outTermsB[(kPlaneCoatNormal - kTermsInA) * planeSize + i] = vec4(m.coatNormal, m.coat);
  outTermsB[(kPlaneSheen - kTermsInA) * planeSize + i] = vec4(m.sheenColor, m.sheenRoughness);
  outTermsB[(kPlaneTangent - kTermsInA) * planeSize + i] = vec4(m.tangent, m.anisotropy);
  outTermsB[(kPlaneFilm - kTermsInA) * planeSize + i] = vec4(m.iridescence, m.filmIor, m.filmThickness, m.dispersion);
  outTermsB[(kPlaneThrough - kTermsInA) * planeSize + i] = vec4(m.transmission, m.ior, m.thickness, m.diffuseTransmission);
  outTermsB[(kPlaneAbsorption - kTermsInA) * planeSize + i] = vec4(m.absorption, 0.0);
  outTermsB[(kPlaneDiffuseThrough - kTermsInA) * planeSize + i] = vec4(m.diffuseTransmissionColor, 0.0);
#endif
}
