#include "job/scene/scene_content.h"

#include "gpu/surface/material_class.h"

namespace parity::job {

std::set<std::string> contentOf(const PreparedScene& prepared) {
  std::set<std::string> all = {""};
  if (prepared.scene.fog) all.insert("fog");
  if (prepared.baked && !prepared.baked->halfPages.empty()) all.insert("lightmap");
  for (const auto& [path, light] : prepared.lightOfPath) {
    const bool hasCaptures = prepared.baked && !prepared.baked->captures.empty();
    if (light.environment || hasCaptures) all.insert("environment");
    if (hasCaptures) all.insert("environment capture");
    for (const scenes::Light& each : light.lights)
      all.insert(each.kind == scenes::LightKind::directional ? "directional light" : "local light");
  }
  for (const scenes::Instance& instance : prepared.scene.instances) {
    const scenes::Material& material = prepared.scene.materials[prepared.scene.meshes[instance.mesh].material];
    if (gpu::classify(material).textures != 0) all.insert("texture");
    if (material.hasCoat()) all.insert("clear coat");
    if (material.hasSheen()) all.insert("sheen");
    if (material.hasAnisotropy()) all.insert("anisotropy");
    if (material.hasIridescence()) all.insert("iridescence");
    if (material.hasTransmission()) all.insert("transmission");
    if (material.hasDiffuseTransmission()) all.insert("diffuse transmission");
  }
  return all;
}

} // namespace parity::job
