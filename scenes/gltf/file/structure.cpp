// What binds the parts of a glTF document together: ranges of buffers, the forest of nodes.
#include "scenes/gltf/file/structure.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

namespace parity::scenes {
namespace {

using Json = nlohmann::json;

const Json& listOf(const Json& object, const char* key) {
  static const Json kNone = Json::array();
  const auto found = object.find(key);
  return found == object.end() ? kNone : *found;
}

std::size_t countOf(const Json& object, const char* key, std::size_t otherwise = 0) {
  return object.value(key, otherwise);
}

const Json* extensionOf(const Json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() ? nullptr : &*found;
}

class StructureChecker {
public:
  StructureChecker(const Json& document, Problems& problems) : m_document(document), m_problems(problems) {}

  void check() {
    forEach("bufferViews", [&](const Json& view, const std::string& place) { checkView(view, place); });
    forEach("accessors", [&](const Json& accessor, const std::string& place) { checkAccessor(accessor, place); });
    forEach("images", [&](const Json& image, const std::string& place) {
      if (image.contains("uri") == image.contains("bufferView"))
        m_problems.add(place, "needs either a uri or a bufferView");
    });
    forEach("meshes", [&](const Json& mesh, const std::string& place) {
      if (mesh["primitives"].empty()) m_problems.add(place + "/primitives", "is empty, expected at least one");
    });
    forEach("cameras", [&](const Json& camera, const std::string& place) {
      const std::string& type = camera["type"].get_ref<const std::string&>();
      if (!camera.contains(type)) m_problems.add(fmt::format("{}/{}", place, type), "is missing");
    });
    if (const Json* lights = extensionOf(m_document, "KHR_lights_punctual"))
      for (std::size_t i = 0; i < (*lights)["lights"].size(); ++i) {
        const Json& light = (*lights)["lights"][i];
        const std::string place = fmt::format("/extensions/KHR_lights_punctual/lights/{}", i);
        if (light["type"] == "spot" && !light.contains("spot")) m_problems.add(place + "/spot", "is missing");
        if (const auto range = light.find("range"); range != light.end() && !(range->get<double>() > 0))
          m_problems.add(place + "/range", "is not above 0; omit it for a light without a range");
      }
    forEach("animations", [&](const Json& animation, const std::string& place) { checkAnimation(animation, place); });
    checkNodes();
  }

private:
  void forEach(const char* key, const auto& body) {
    const Json& list = listOf(m_document, key);
    for (std::size_t i = 0; i < list.size(); ++i) body(list[i], fmt::format("/{}/{}", key, i));
  }

  std::size_t bytesOfBuffer(const Json& holder) const {
    return m_document["buffers"][holder["buffer"].get<std::size_t>()]["byteLength"].get<std::size_t>();
  }

  void checkRange(const Json& range, const std::string& place) {
    const std::size_t offset = countOf(range, "byteOffset"), length = countOf(range, "byteLength");
    if (length == 0)
      m_problems.add(place + "/byteLength", "is 0, expected at least 1");
    else if (const std::size_t size = bytesOfBuffer(range); offset > size || length > size - offset)
      m_problems.add(place, fmt::format("ends at byte {}, expected at most {}, the byteLength of /buffers/{}",
                                        offset + length, size, countOf(range, "buffer")));
  }

  void checkView(const Json& view, const std::string& place) {
    checkRange(view, place);
    if (const auto stride = view.find("byteStride"); stride != view.end())
      if (const std::size_t value = stride->get<std::size_t>(); value < 4 || value > 252 || value % 4)
        m_problems.add(place + "/byteStride", fmt::format("is {}, expected a multiple of 4 from 4 to 252", value));
    const Json* packed = extensionOf(view, "EXT_meshopt_compression");
    if (!packed) return;
    const std::string at = place + "/extensions/EXT_meshopt_compression";
    checkRange(*packed, at);
    // Counts are below 2^31: no overflow.
    if (const std::size_t bytes = countOf(*packed, "count") * countOf(*packed, "byteStride");
        bytes != countOf(view, "byteLength"))
      m_problems.add(at, fmt::format("decodes to {} bytes, expected {}, the byteLength of the view", bytes,
                                     countOf(view, "byteLength")));
    if (const std::size_t own = countOf(*packed, "byteStride"); countOf(view, "byteStride", own) != own)
      m_problems.add(at + "/byteStride",
                     fmt::format("is {}, expected {} as in the view", own, countOf(view, "byteStride")));
    try {
      checkMeshoptLayout(meshoptLayoutOf(*packed), countOf(*packed, "byteLength"));
    } catch (const std::invalid_argument& reason) {
      m_problems.add(at, reason.what());
    }
  }

  // `count` elements of `bytes` each, `stride` apart, in a buffer view.
  void checkFit(std::size_t viewIndex, std::size_t offset, std::size_t count, std::size_t bytes, std::size_t stride,
                std::size_t alignment, const std::string& place) {
    const Json& view = m_document["bufferViews"][viewIndex];
    if ((offset + countOf(view, "byteOffset")) % alignment)
      m_problems.add(place + "/byteOffset",
                     fmt::format("is {} in a view at {}, expected their sum to be a multiple of {}", offset,
                                 countOf(view, "byteOffset"), alignment));
    const std::size_t length = countOf(view, "byteLength");
    if (count == 0) return;
    if (stride == 0 || count - 1 > length / stride || offset + stride * (count - 1) + bytes > length)
      m_problems.add(place, fmt::format("{} elements of {} bytes, {} apart, start at byte {}, and must end within the "
                                        "{} bytes of /bufferViews/{}",
                                        count, bytes, stride, offset, length, viewIndex));
  }

  void checkAccessor(const Json& accessor, const std::string& place) {
    const std::size_t count = countOf(accessor, "count"), component = bytesOfComponent(accessor["componentType"]);
    const std::string& type = accessor["type"].get_ref<const std::string&>();
    const auto components = static_cast<std::size_t>(componentsOf(type));
    std::size_t bytes = component * components;
    if (type.starts_with("MAT")) { // each column begins at a multiple of 4
      const std::size_t columns = type == "MAT2" ? 2 : type == "MAT3" ? 3 : 4;
      bytes = (columns * component + 3) / 4 * 4 * columns;
    }
    if (count == 0) m_problems.add(place + "/count", "is 0, expected at least 1");
    if (const auto found = accessor.find("bufferView"); found != accessor.end()) {
      const std::size_t view = found->get<std::size_t>();
      const std::size_t stride = countOf(m_document["bufferViews"][view], "byteStride", bytes);
      if (stride < bytes || stride % component)
        m_problems.add(place,
                       fmt::format("has elements of {} bytes, expected at most the byteStride {} of /bufferViews/{}",
                                   bytes, stride, view));
      else
        checkFit(view, countOf(accessor, "byteOffset"), count, bytes, stride, component, place);
    }
    if (const auto sparse = accessor.find("sparse"); sparse != accessor.end())
      checkSparse(*sparse, count, bytes, component, place + "/sparse");
    checkLimits(accessor, components, place);
  }

  void checkSparse(const Json& sparse, std::size_t count, std::size_t bytes, std::size_t component,
                   const std::string& place) {
    const std::size_t changed = countOf(sparse, "count");
    if (changed == 0 || changed > count)
      m_problems.add(place + "/count", fmt::format("is {}, expected 1 to {}, the number of elements", changed, count));
    const Json &indices = sparse["indices"], &values = sparse["values"];
    const std::size_t indexBytes = bytesOfComponent(indices["componentType"]);
    checkFit(indices["bufferView"], countOf(indices, "byteOffset"), changed, indexBytes, indexBytes, indexBytes,
             place + "/indices");
    checkFit(values["bufferView"], countOf(values, "byteOffset"), changed, bytes, bytes, component, place + "/values");
  }

  void checkLimits(const Json& accessor, std::size_t components, const std::string& place) {
    const auto lower = accessor.find("min"), upper = accessor.find("max");
    for (const auto& limit : {lower, upper})
      if (limit != accessor.end() && limit->size() != components) {
        m_problems.add(place + (limit == lower ? "/min" : "/max"),
                       fmt::format("holds {} numbers, expected {}", limit->size(), components));
        return;
      }
    if (lower == accessor.end() || upper == accessor.end()) return;
    for (std::size_t i = 0; i < components; ++i)
      if ((*lower)[i].get<double>() > (*upper)[i].get<double>()) {
        m_problems.add(fmt::format("{}/min/{}", place, i),
                       fmt::format("is {}, expected at most the max of {}", (*lower)[i].dump(), (*upper)[i].dump()));
        return;
      }
  }

  void checkAnimation(const Json& animation, const std::string& place) {
    const std::size_t samplers = animation["samplers"].size();
    const Json& channels = animation["channels"];
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (const std::size_t sampler = countOf(channels[c], "sampler"); sampler >= samplers)
        m_problems.add(fmt::format("{}/channels/{}/sampler", place, c),
                       fmt::format("is {}, expected an index of the animation's {} samplers", sampler, samplers));
  }

  void checkNodes() {
    const Json& nodes = listOf(m_document, "nodes");
    constexpr std::size_t kNone = ~std::size_t{0};
    std::vector<std::size_t> parents(nodes.size(), kNone);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      for (const char* key : {"translation", "rotation", "scale"})
        if (nodes[n].contains("matrix") && nodes[n].contains(key))
          m_problems.add(fmt::format("/nodes/{}/{}", n, key),
                         "is given together with a matrix, expected only one of them");
      for (const Json& entry : listOf(nodes[n], "children")) {
        const auto child = entry.get<std::size_t>();
        if (parents[child] != kNone)
          m_problems.add(fmt::format("/nodes/{}", child),
                         parents[child] == n ? fmt::format("is a child of /nodes/{} twice", n)
                                             : fmt::format("has two parents, /nodes/{} and /nodes/{}, expected one",
                                                           parents[child], n));
        parents[child] = n;
      }
    }
    checkCycles(parents, kNone);
    std::vector<std::size_t> listedBy(nodes.size(), 0); // number of a scene, from 1
    std::size_t number = 0;
    forEach("scenes", [&](const Json& scene, const std::string& place) {
      ++number;
      for (const Json& entry : listOf(scene, "nodes")) {
        const auto root = entry.get<std::size_t>();
        const bool isListed = listedBy[root] == number;
        if (parents[root] != kNone || isListed)
          m_problems.add(place + "/nodes", fmt::format("/nodes/{} is {}, expected each root once", root,
                                                       isListed ? "listed twice" : "a child of another node"));
        listedBy[root] = number;
      }
    });
  }

  // With one parent each, a cycle is a chain of parents that never ends. Also those that no scene shows are refused.
  void checkCycles(const std::vector<std::size_t>& parents, std::size_t none) {
    std::vector<std::size_t> visitedBy(parents.size(), 0); // walk number, from 1
    for (std::size_t start = 0; start < parents.size(); ++start)
      for (std::size_t n = start; n != none; n = parents[n]) {
        if (visitedBy[n] == start + 1) {
          m_problems.add(fmt::format("/nodes/{}", n), "is its own ancestor: the hierarchy has a cycle");
          break;
        }
        if (visitedBy[n]) break; // an earlier walk came through and ended
        visitedBy[n] = start + 1;
      }
  }

  const Json& m_document;
  Problems& m_problems;
};

} // namespace

MeshoptLayout meshoptLayoutOf(const nlohmann::json& extension) {
  return {extension["count"].get<std::size_t>(), extension["byteStride"].get<std::size_t>(),
          meshoptModeOf(extension["mode"].get<std::string>()),
          meshoptFilterOf(extension.value("filter", std::string("NONE")))};
}

int componentsOf(std::string_view accessorType) {
  constexpr std::array<std::pair<std::string_view, int>, 7> kTypes = {
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
  const auto found = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == accessorType; });
  return found == kTypes.end() ? 0 : found->second;
}

std::size_t bytesOfComponent(int componentType) {
  switch (componentType) {
  case 5120: // BYTE
  case 5121: // UNSIGNED_BYTE
    return 1;
  case 5122: // SHORT
  case 5123: // UNSIGNED_SHORT
    return 2;
  default: // UNSIGNED_INT, FLOAT
    return 4;
  }
}

void checkGltfStructure(const nlohmann::json& document, Problems& problems) {
  StructureChecker(document, problems).check();
}

} // namespace parity::scenes
