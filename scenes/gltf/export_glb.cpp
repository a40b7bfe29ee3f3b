#include "scenes/gltf/export_glb.h"

#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <tiny_gltf.h>

#include "base/error.h"
#include "base/image/image_io.h"

namespace parity::scenes {

namespace {

using tinygltf::Value;

constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;

std::vector<double> doubles(const float* values, int count) { return {values, values + count}; }
std::vector<double> doubles(const glm::vec3& v) { return doubles(glm::value_ptr(v), 3); }
Value valueOf(const glm::vec3& v) {
  Value::Array array;
  for (int i = 0; i < 3; ++i) array.emplace_back(static_cast<double>(v[i]));
  return Value(array);
}
Value number(double value) { return Value(value); }

class GlbWriter {
public:
  GlbWriter(const Scene& scene, std::vector<std::string>* notes) : m_scene(scene), m_notes(notes) {
    m_model.asset.version = "2.0";
    m_model.asset.generator = "parity";
    m_model.buffers.emplace_back();
    m_model.scenes.emplace_back();
    m_model.scenes[0].name = scene.name;
    m_model.defaultScene = 0;
  }

  std::vector<std::byte> write() {
    for (const Material& material : m_scene.materials) addMaterial(material);
    for (const Mesh& mesh : m_scene.meshes) addMesh(mesh);
    for (const Instance& instance : m_scene.instances) addInstance(instance);
    for (const Light& light : m_scene.lights) addLight(light);
    for (const Camera& camera : m_scene.cameras) addCamera(camera);
    if (m_scene.environment) note("its environment is not part of glTF");
    if (m_scene.fog) note("its fog is not part of glTF");
    m_model.extensionsUsed.assign(m_used.begin(), m_used.end());
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&m_model, out, false, true))
      throw base::Error(base::ExitCode::failed, m_scene.name, "", "cannot be written as glTF");
    const std::string text = out.str();
    std::vector<std::byte> bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
  }

private:
  void note(const std::string& text) {
    if (m_notes) m_notes->push_back(text);
  }
  void use(const char* extension) { m_used.insert(extension); }

  int addView(const void* data, std::size_t bytes, int target) {
    std::vector<unsigned char>& buffer = m_model.buffers[0].data;
    buffer.resize((buffer.size() + 3) / 4 * 4); // aligned
    tinygltf::BufferView view;
    view.buffer = 0, view.byteOffset = buffer.size(), view.byteLength = bytes, view.target = target;
    const auto* from = static_cast<const unsigned char*>(data);
    buffer.insert(buffer.end(), from, from + bytes);
    m_model.bufferViews.push_back(view);
    return static_cast<int>(m_model.bufferViews.size() - 1);
  }

  template <typename T> int addAccessor(const std::vector<T>& values, int componentType, int type, int target) {
    tinygltf::Accessor accessor;
    accessor.bufferView = addView(values.data(), values.size() * sizeof(T), target);
    accessor.componentType = componentType, accessor.type = type, accessor.count = values.size();
    m_model.accessors.push_back(accessor);
    return static_cast<int>(m_model.accessors.size() - 1);
  }

  void addMesh(const Mesh& mesh) {
    tinygltf::Primitive primitive;
    const auto add = [&](const char* name, const auto& values, int type) {
      if (!values.empty()) primitive.attributes[name] = addAccessor(values, kFloat, type, TINYGLTF_TARGET_ARRAY_BUFFER);
    };
    add("POSITION", mesh.positions, TINYGLTF_TYPE_VEC3);
    tinygltf::Accessor& positions = m_model.accessors.back();
    glm::vec3 least = mesh.positions.at(0), most = least;
    for (const glm::vec3& p : mesh.positions) least = glm::min(least, p), most = glm::max(most, p);
    positions.minValues = doubles(least), positions.maxValues = doubles(most);
    add("NORMAL", mesh.normals, TINYGLTF_TYPE_VEC3);
    add("TANGENT", mesh.tangents, TINYGLTF_TYPE_VEC4);
    add("TEXCOORD_0", mesh.uv0, TINYGLTF_TYPE_VEC2);
    if (mesh.uv0.empty() && !mesh.uv1.empty()) // glTF has no second set without a first one
      add("TEXCOORD_0", std::vector<glm::vec2>(mesh.uv1.size()), TINYGLTF_TYPE_VEC2);
    add("TEXCOORD_1", mesh.uv1, TINYGLTF_TYPE_VEC2);
    add("COLOR_0", mesh.colors, TINYGLTF_TYPE_VEC4);
    primitive.indices = addAccessor(mesh.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                    TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.material = static_cast<int>(mesh.material);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    tinygltf::Mesh out;
    out.name = mesh.name;
    out.primitives.push_back(std::move(primitive));
    m_model.meshes.push_back(std::move(out));
  }

  tinygltf::Node& addNode(const std::string& name, const glm::mat4& toWorld) {
    tinygltf::Node node;
    node.name = name;
    if (toWorld != glm::mat4(1.f)) node.matrix = doubles(glm::value_ptr(toWorld), 16);
    m_model.scenes[0].nodes.push_back(static_cast<int>(m_model.nodes.size()));
    return m_model.nodes.emplace_back(std::move(node));
  }

  void addInstance(const Instance& instance) {
    addNode(instance.node, instance.toWorld).mesh = static_cast<int>(instance.mesh);
  }

  int addImage(int image) {
    const auto [found, isNew] = m_images.emplace(image, static_cast<int>(m_model.images.size()));
    if (!isNew) return found->second;
    const TextureImage& from = m_scene.images.at(static_cast<std::size_t>(image));
    const std::vector<std::byte> png = base::encodeImage8(from.name + ".png", from.pixels);
    tinygltf::Image out;
    out.name = from.name, out.mimeType = "image/png";
    out.bufferView = addView(png.data(), png.size(), 0);
    m_model.images.push_back(std::move(out));
    return found->second;
  }

  int addSampler(const Sampler& sampler) {
    static constexpr int kWraps[] = {TINYGLTF_TEXTURE_WRAP_REPEAT, TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT,
                                     TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE};
    tinygltf::Sampler out;
    out.wrapS = kWraps[static_cast<int>(sampler.wrapU)], out.wrapT = kWraps[static_cast<int>(sampler.wrapV)];
    const bool isLinear = sampler.minFilter == Filter::linear;
    out.magFilter =
        sampler.magFilter == Filter::linear ? TINYGLTF_TEXTURE_FILTER_LINEAR : TINYGLTF_TEXTURE_FILTER_NEAREST;
    if (!sampler.useMips)
      out.minFilter = isLinear ? TINYGLTF_TEXTURE_FILTER_LINEAR : TINYGLTF_TEXTURE_FILTER_NEAREST;
    else if (sampler.mipFilter == Filter::linear)
      out.minFilter =
          isLinear ? TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR : TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
    else
      out.minFilter =
          isLinear ? TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST : TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST;
    m_model.samplers.push_back(out);
    return static_cast<int>(m_model.samplers.size() - 1);
  }

  // KHR_texture_transform: offset, then rotation, then scale; the matrix has no more than these where its columns are
  // at a right angle.
  Value transformOf(const TextureSlot& slot) const {
    const auto& [a, b, x, c, d, y] = slot.uvTransform; // rows (a b x), (c d y)
    const double scaleX = std::hypot(a, c), rotation = std::atan2(-c, a);
    const double scaleY = b * std::sin(rotation) + d * std::cos(rotation);
    constexpr double kSkew = 1e-5;
    if (std::abs(a * b + c * d) > kSkew * std::max(1.0, scaleX * std::abs(scaleY)))
      throw base::Error(base::ExitCode::failed, m_scene.name, "", "a texture is skewed, which glTF cannot say");
    return Value(Value::Object{{"offset", Value(Value::Array{number(x), number(y)})},
                               {"rotation", number(rotation)},
                               {"scale", Value(Value::Array{number(scaleX), number(scaleY)})}});
  }

  template <typename Info> void setTexture(Info& info, const TextureSlot& slot) {
    if (!slot.present()) return;
    tinygltf::Texture texture;
    texture.source = addImage(slot.image), texture.sampler = addSampler(slot.sampler);
    info.index = static_cast<int>(m_model.textures.size()), info.texCoord = slot.texCoord;
    m_model.textures.push_back(texture);
    if (slot.uvTransform == TextureSlot().uvTransform) return;
    use("KHR_texture_transform");
    info.extensions["KHR_texture_transform"] = transformOf(slot);
  }

  Value textureValue(const TextureSlot& slot) {
    tinygltf::TextureInfo info;
    setTexture(info, slot);
    Value::Object object{{"index", Value(info.index)}, {"texCoord", Value(info.texCoord)}};
    if (!info.extensions.empty()) object["extensions"] = Value(Value::Object{*info.extensions.begin()});
    return Value(object);
  }

  void addMaterial(const Material& material) {
    static constexpr const char* kModes[] = {"OPAQUE", "MASK", "BLEND"};
    tinygltf::Material out;
    out.name = material.name;
    out.pbrMetallicRoughness.baseColorFactor = doubles(glm::value_ptr(material.baseColor), 4);
    out.pbrMetallicRoughness.metallicFactor = material.metallic;
    out.pbrMetallicRoughness.roughnessFactor = material.roughness;
    setTexture(out.pbrMetallicRoughness.baseColorTexture, material.baseColorTexture);
    setTexture(out.pbrMetallicRoughness.metallicRoughnessTexture, material.metallicRoughnessTexture);
    setTexture(out.normalTexture, material.normalTexture);
    out.normalTexture.scale = material.normalScale;
    setTexture(out.occlusionTexture, material.occlusionTexture);
    out.occlusionTexture.strength = material.occlusionStrength;
    setTexture(out.emissiveTexture, material.emissiveTexture);
    const float strength = std::max({material.emissive.x, material.emissive.y, material.emissive.z, 1.f});
    out.emissiveFactor = doubles(material.emissive / strength);
    out.alphaMode = kModes[static_cast<int>(material.alphaMode)];
    out.alphaCutoff = material.alphaCutoff;
    out.doubleSided = material.doubleSided;
    const auto extend = [&](const char* name, Value::Object object) {
      use(name);
      out.extensions[name] = Value(std::move(object));
    };
    if (strength > 1) extend("KHR_materials_emissive_strength", {{"emissiveStrength", number(strength)}});
    if (material.unlit) extend("KHR_materials_unlit", {});
    if (material.ior != Material().ior) extend("KHR_materials_ior", {{"ior", number(material.ior)}});
    if (material.specular != 1 || material.specularColor != glm::vec3(1) || material.specularTexture.present() ||
        material.specularColorTexture.present()) {
      Value::Object specular{{"specularFactor", number(material.specular)},
                             {"specularColorFactor", valueOf(material.specularColor)}};
      if (material.specularTexture.present()) specular["specularTexture"] = textureValue(material.specularTexture);
      if (material.specularColorTexture.present())
        specular["specularColorTexture"] = textureValue(material.specularColorTexture);
      extend("KHR_materials_specular", std::move(specular));
    }
    if (material.fullyRough) out.extras = Value(Value::Object{{"fullyRough", Value(true)}});
    m_model.materials.push_back(std::move(out));
  }

  void addLight(const Light& light) {
    if (light.falloff == Falloff::exponent)
      return note(
          fmt::format("the light '{}' fades by an exponent, which glTF cannot say: it is left out", light.name));
    if (light.specularScale != 1)
      note(fmt::format("the light '{}' scales its specular light, which glTF cannot say", light.name));
    static constexpr const char* kKinds[] = {"directional", "point", "spot"};
    use("KHR_lights_punctual");
    const float intensity = std::max({light.color.x, light.color.y, light.color.z});
    tinygltf::Light out;
    out.name = light.name, out.type = kKinds[static_cast<int>(light.kind)];
    out.color = doubles(intensity > 0 ? light.color / intensity : glm::vec3(1));
    out.intensity = intensity;
    out.range = light.range;
    if (light.kind == LightKind::spot)
      out.spot.innerConeAngle = light.innerConeAngle, out.spot.outerConeAngle = light.outerConeAngle;
    const int index = static_cast<int>(m_model.lights.size());
    m_model.lights.push_back(std::move(out));
    glm::mat4 toWorld(1.f);
    toWorld[3] = glm::vec4(light.position, 1);
    if (light.kind != LightKind::point) { // it shines along -Z of its node
      const glm::vec3 z = -light.direction, up = std::abs(z.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
      const glm::vec3 x = glm::normalize(glm::cross(up, z));
      toWorld[0] = glm::vec4(x, 0), toWorld[1] = glm::vec4(glm::cross(z, x), 0), toWorld[2] = glm::vec4(z, 0);
    }
    addNode(light.name, toWorld).extensions["KHR_lights_punctual"] = Value(Value::Object{{"light", Value(index)}});
  }

  void addCamera(const Camera& camera) {
    tinygltf::Camera out;
    out.name = camera.name;
    if (camera.orthographic) {
      out.type = "orthographic";
      out.orthographic.xmag = out.orthographic.ymag = camera.halfHeight;
      out.orthographic.znear = camera.zNear, out.orthographic.zfar = camera.zFar;
    } else {
      out.type = "perspective";
      out.perspective.yfov = static_cast<double>(camera.fovYDeg) * 3.14159265358979323846 / 180;
      out.perspective.znear = camera.zNear, out.perspective.zfar = camera.zFar;
    }
    m_model.cameras.push_back(out);
    addNode(camera.name, camera.toWorld).camera = static_cast<int>(m_model.cameras.size() - 1);
  }

  const Scene& m_scene;
  std::vector<std::string>* m_notes;
  tinygltf::Model m_model;
  std::map<int, int> m_images;
  std::set<std::string> m_used;
};

} // namespace

std::vector<std::byte> toGlb(const Scene& scene, std::vector<std::string>* notes) {
  return GlbWriter(scene, notes).write();
}

} // namespace parity::scenes
