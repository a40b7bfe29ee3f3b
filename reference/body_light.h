// Light through a body of glass: refracted where it enters and leaves, absorbed and reflected within.
#pragma once

#include "reference/bounced_light.h"
#include "reference/environment_integral.h"

namespace parity::reference {

// What is seen of and through a body. Referenced objects must outlive it.
struct BodySurroundings {
  const lighting::Visibility& bodies;              // of Contents::bodies
  const EnvironmentSampler* environment = nullptr; // null: none
  const Surroundings* behind = nullptr;            // null: no opaque surfaces
  int bounces = 1;                                 // of light that comes by way of those, at least 1
};

// The light that the eye sees through the body at a point, integrated until its error is small enough, as the
// integral's specular part. Of an even environment of radiance 1 it is 1 but for absorption: what the surface reflects
// and tints is the layer's weight (reference/layers.h).
//
// Paths go from the eye. One enters at a microfacet of the sample's GGX surface, drawn by the view's visible normals,
// and counts as much as the base's Fresnel reflectance there lets through, over the mean of that. It is refracted by
// the sample's index and goes through the mesh of the sample's instance, whose normals are the vertices', and whose
// roughness and index are the sample's everywhere; thickness is not read, since the mesh is the body. Light keeps
// exp(-absorption distance). At each surface that it meets from within, a microfacet splits it (RefractedLobe): what is
// refracted leaves, the rest is reflected and goes on; after 32 turns it goes on as if the body ended there. Where what
// goes on is a mirror's, it is followed until 1e-6 of the light is left; else a random number decides whether it is.
// Light that leaves is that of the opaque surface behind, or the environment's, sampled by the lobe and by its own
// light with the balance heuristic (Veach and Guibas 1995, eq. 9), that of an even sky by the lobe alone. Opaque
// surfaces within the body are seen, too. A ray that meets no surface of the instance - of an open mesh - leaves at
// once, in its direction. Other bodies are not seen.
//
// With dispersion red, green and blue have an index each (shading/refraction.glsl) and paths of their own, of the same
// random numbers. Analytic lights do not shine through bodies: what refraction makes of them are caustics.
// lobes: of the sample, whose Fresnel reflectance it is. otherLight, options, weight: as for integrateEnvironment.
Integral integrateBody(const SurfaceSample& sample, const Lobes& lobes, const BodySurroundings& around,
                       const glm::dvec3& otherLight, const IntegralOptions& options,
                       const glm::dvec3& weight = glm::dvec3(1.0));

} // namespace parity::reference
