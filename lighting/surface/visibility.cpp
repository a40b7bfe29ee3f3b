#include "lighting/surface/visibility.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"
#include "base/member_count.h"
#include "lighting/surface/alpha_mask.h"

namespace parity::lighting {

namespace {

constexpr double kOffset = 0x1p-18;

bool casts(const scenes::Scene& scene, const scenes::Instance& instance) {
  return scene.materials[scene.meshes[instance.mesh].material].castsShadow();
}

bool isIn(Visibility::Contents contents, const scenes::Scene& scene, const scenes::Instance& instance) {
  const scenes::Material& material = scene.materials[scene.meshes[instance.mesh].material];
  if (contents == Visibility::Contents::bodies) return material.hasVolume();
  return material.castsShadow() && !(contents == Visibility::Contents::behind && material.hasTransmission());
}

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename Handle, typename Release> using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

// The first error that Embree tells: its functions return none.
struct FirstError {
  std::mutex mutex;
  std::string text;
  static void take(void* self, RTCError code, const char* message) {
    auto& error = *static_cast<FirstError*>(self);
    const std::scoped_lock lock(error.mutex);
    if (error.text.empty())
      error.text = fmt::format("error {}{}{}", static_cast<int>(code), message ? ": " : "", message ? message : "");
  }
};

struct MaskedMesh {
  const scenes::Scene* scene;
  const scenes::Mesh* mesh;
};

void passHoles(const RTCFilterFunctionNArguments* args) {
  const auto& masked = *static_cast<const MaskedMesh*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const std::size_t first = std::size_t{3} * RTCHitN_primID(args->hit, args->N, i);
    const double u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
    const std::vector<std::uint32_t>& indices = masked.mesh->indices;
    if (isHole(*masked.scene, *masked.mesh, {indices[first], indices[first + 1], indices[first + 2]},
               {1 - u - v, u, v}))
      args->valid[i] = 0;
  }
}

// A ray's context: of one geometry alone, or of all but one.
struct ChosenGeometry {
  RTCIntersectContext context; // first: Embree hands out a pointer to it
  unsigned geometry;
  bool stopsThere;
  static void passOthers(const RTCFilterFunctionNArguments* args) {
    const auto& chosen = *reinterpret_cast<const ChosenGeometry*>(args->context);
    for (unsigned i = 0; i < args->N; ++i)
      if ((RTCHitN_geomID(args->hit, args->N, i) == chosen.geometry) != chosen.stopsThere) args->valid[i] = 0;
  }
};

RTCRay makeRay(const glm::dvec3& origin, const glm::dvec3& direction, double maxDistance) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x);
  ray.org_y = static_cast<float>(origin.y);
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tfar = static_cast<float>(maxDistance);
  ray.mask = ~0u;
  return ray;
}

} // namespace

struct Visibility::Impl {
  const scenes::Scene* whole = nullptr;
  FirstError error; // outlives the device
  std::deque<MaskedMesh> masked;
  Owned<RTCDevice, ReleaseDevice> device;
  Owned<RTCScene, ReleaseScene> scene;
  double extent = 0; // the largest coordinate
  struct Source {
    std::uint32_t instance = 0;
    bool mirrored = false; // its transform turns fronts into backs
  };
  std::vector<Source> sources; // of each Embree geometry, by instance
  bool choosesGeometry = false;

  std::optional<Hit> firstHit(RTCIntersectContext& context, const glm::dvec3& origin, const glm::dvec3& direction,
                              double maxDistance) const;
  // Of one instance alone, or of all but it.
  std::optional<Hit> firstHit(std::uint32_t instance, bool stopsThere, const glm::dvec3& origin,
                              const glm::dvec3& direction, double maxDistance) const;

  void check(const scenes::Scene& content) const {
    if (!error.text.empty()) throw base::fileError(content.name, "shadows", "Embree: " + error.text);
  }

  void add(const scenes::Scene& content, std::uint32_t index) {
    const scenes::Instance& instance = content.instances[index];
    const scenes::Mesh& mesh = content.meshes[instance.mesh];
    if (mesh.indices.empty()) return;
    const Owned<RTCGeometry, ReleaseGeometry> geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    auto* indices =
        static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                            3 * sizeof(std::uint32_t), mesh.indices.size() / 3));
    check(content); // no memory
    const glm::dmat4 toWorld(instance.toWorld);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::dvec3 p(toWorld * glm::dvec4(mesh.positions[i], 1));
      vertices[i] = glm::vec3(p);
      for (int c = 0; c < 3; ++c)
        if (std::isfinite(p[c])) extent = std::max(extent, std::abs(p[c]));
    }
    std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
    if (content.materials[mesh.material].alphaMode == scenes::AlphaMode::mask) {
      masked.push_back({&content, &mesh});
      rtcSetGeometryUserData(geometry.get(), &masked.back());
      rtcSetGeometryOccludedFilterFunction(geometry.get(), passHoles);
      rtcSetGeometryIntersectFilterFunction(geometry.get(), passHoles);
    }
    rtcCommitGeometry(geometry.get());
    const unsigned id = rtcAttachGeometry(scene.get(), geometry.get());
    sources.resize(std::max<std::size_t>(sources.size(), id + 1));
    sources[id] = {index, glm::determinant(glm::mat3(instance.toWorld)) < 0};
  }
};

Visibility::Visibility(const scenes::Scene& scene, Contents contents) : m_impl(std::make_unique<Impl>()) {
  std::size_t triangles = 0; // or what a third of the vertices could make, where most are unused
  for (const scenes::Instance& instance : scene.instances)
    if (const scenes::Mesh& mesh = scene.meshes[instance.mesh]; isIn(contents, scene, instance))
      triangles += std::max(mesh.indices.size(), mesh.positions.size()) / 3;
  if (triangles > kMaxTriangles)
    throw base::fileError(scene.name, "shadows",
                          fmt::format("{} triangles in all instances, expected at most {}", triangles, kMaxTriangles));

  Impl& impl = *m_impl;
  impl.whole = &scene;
  impl.device.reset(rtcNewDevice(nullptr));
  if (!impl.device)
    throw base::fileError(scene.name, "shadows",
                          fmt::format("Embree: error {}", static_cast<int>(rtcGetDeviceError(nullptr))));
  rtcSetDeviceErrorFunction(impl.device.get(), FirstError::take, &impl.error);
  impl.scene.reset(rtcNewScene(impl.device.get()));
  impl.check(scene);
  impl.choosesGeometry = std::ranges::any_of(scene.materials, &scenes::Material::hasVolume);
  const int filter = impl.choosesGeometry ? RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION : 0; // others do without its cost
  rtcSetSceneFlags(impl.scene.get(),
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT | filter));
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    if (isIn(contents, scene, scene.instances[i])) impl.add(scene, i);
  rtcCommitScene(impl.scene.get());
  impl.check(scene);
}

Visibility::~Visibility() = default;

const scenes::Scene& Visibility::scene() const { return *m_impl->whole; }

double Visibility::surfaceOffset(const glm::dvec3& position) const {
  return kOffset * std::max({m_impl->extent, std::abs(position.x), std::abs(position.y), std::abs(position.z)});
}

bool Visibility::isOccluded(const glm::dvec3& origin, const glm::dvec3& direction, double maxDistance) const {
  if (!(maxDistance > 0)) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = makeRay(origin, direction, maxDistance);
  rtcOccluded1(m_impl->scene.get(), &context, &ray);
  return ray.tfar < 0; // Embree's sign for a hit
}

std::optional<Visibility::Hit> Visibility::Impl::firstHit(RTCIntersectContext& context, const glm::dvec3& origin,
                                                          const glm::dvec3& direction, double maxDistance) const {
  if (!(maxDistance > 0)) return std::nullopt;
  RTCRayHit query{};
  query.ray = makeRay(origin, direction, maxDistance);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Source& source = sources[query.hit.geomID];
  const glm::vec3 counterClockwise = glm::normalize(glm::vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
  const glm::vec3 geometric = source.mirrored ? -counterClockwise : counterClockwise;
  return Hit{.instance = source.instance,
             .triangle = query.hit.primID,
             .barycentric = {query.hit.u, query.hit.v},
             .distance = query.ray.tfar,
             .geometric = geometric,
             .front = glm::dot(geometric, glm::vec3(direction)) < 0};
}

std::optional<Visibility::Hit> Visibility::Impl::firstHit(std::uint32_t instance, bool stopsThere,
                                                          const glm::dvec3& origin, const glm::dvec3& direction,
                                                          double maxDistance) const {
  const auto found = std::ranges::lower_bound(sources, instance, {}, &Source::instance);
  const bool isThere = found != sources.end() && found->instance == instance;
  ChosenGeometry chosen{.context = {},
                        .geometry = isThere ? static_cast<unsigned>(found - sources.begin()) : RTC_INVALID_GEOMETRY_ID,
                        .stopsThere = stopsThere};
  rtcInitIntersectContext(&chosen.context);
  if (choosesGeometry) chosen.context.filter = ChosenGeometry::passOthers;
  return firstHit(chosen.context, origin, direction, maxDistance);
}

std::optional<Visibility::Hit> Visibility::firstHit(const glm::dvec3& origin, const glm::dvec3& direction,
                                                    double maxDistance) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  return m_impl->firstHit(context, origin, direction, maxDistance);
}

std::optional<Visibility::Hit> Visibility::firstHitOf(std::uint32_t instance, const glm::dvec3& origin,
                                                      const glm::dvec3& direction, double maxDistance) const {
  return m_impl->firstHit(instance, true, origin, direction, maxDistance);
}

std::optional<Visibility::Hit> Visibility::firstHitBeside(std::uint32_t instance, const glm::dvec3& origin,
                                                          const glm::dvec3& direction, double maxDistance) const {
  return m_impl->firstHit(instance, false, origin, direction, maxDistance);
}

// Not in the key: what decides nothing of where a ray is stopped.
static_assert(base::memberCount<scenes::Mesh>() == 9 && base::memberCount<scenes::Instance>() == 3 &&
                  base::memberCount<scenes::Material>() == 53 && base::memberCount<scenes::TextureSlot>() == 4 &&
                  base::memberCount<scenes::Sampler>() == 6,
              "a new member goes into the key, or is named here with the reason why not");

std::string hashOfOccluders(const scenes::Scene& scene) {
  base::Hasher hasher;
  const auto addAll = [&](const auto& list) { hasher.addValue(list.size()).add(std::as_bytes(std::span{list})); };
  std::vector<bool> meshAdded(scene.meshes.size()), imageAdded(scene.images.size());
  for (const scenes::Instance& instance : scene.instances) {
    if (!casts(scene, instance)) continue;
    hasher.addValue(instance.mesh).addValue(instance.toWorld);
    if (meshAdded[instance.mesh]) continue;
    meshAdded[instance.mesh] = true;
    const scenes::Mesh& mesh = scene.meshes[instance.mesh];
    const scenes::Material& material = scene.materials[mesh.material];
    addAll(mesh.positions);
    addAll(mesh.indices);
    hasher.addValue(material.alphaMode);
    if (material.alphaMode != scenes::AlphaMode::mask) continue;
    const scenes::TextureSlot& slot = material.baseColorTexture;
    hasher.addValue(material.baseColor.a).addValue(material.alphaCutoff);
    addAll(mesh.colors);
    hasher.addValue(slot.image);
    if (!slot.present()) continue;
    addAll(slot.texCoord == 1 ? mesh.uv1 : mesh.uv0);
    hasher.addValue(slot.uvTransform).addValue(slot.sampler.wrapU).addValue(slot.sampler.wrapV);
    hasher.addValue(slot.sampler.magFilter);
    if (imageAdded[slot.image]) continue;
    imageAdded[slot.image] = true;
    const base::Image8& pixels = scene.images[slot.image].pixels;
    hasher.addValue(pixels.width).addValue(pixels.height);
    addAll(pixels.pixels);
  }
  return hasher.hex();
}

} // namespace parity::lighting
