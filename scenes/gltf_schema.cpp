// What glTF 2.0 says about the types of the properties that we read, as a table, and the walk that checks it.
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "scenes/gltf_json.h"

namespace parity::scenes {
namespace {

using Json = nlohmann::json;

enum class Kind { text, boolean, count, number, numbers, index, indices, indexMap, object, objects };

// One property. `target`: the array that an index points into; `size`: of an array of numbers, 0 for any.
struct Rule {
  std::string_view key;
  Kind kind;
  bool required = false;
  std::size_t size = 0;
  std::string_view target = {};
  std::span<const Rule> rules = {};
};

constexpr Rule number(std::string_view key) { return {key, Kind::number}; }
constexpr Rule numbers(std::string_view key, std::size_t size) { return {key, Kind::numbers, false, size}; }
constexpr Rule text(std::string_view key) { return {key, Kind::text}; }
constexpr Rule count(std::string_view key) { return {key, Kind::count}; }
constexpr Rule boolean(std::string_view key) { return {key, Kind::boolean}; }
constexpr Rule index(std::string_view key, std::string_view target) { return {key, Kind::index, false, 0, target}; }
constexpr Rule indices(std::string_view key, std::string_view target) { return {key, Kind::indices, false, 0, target}; }
constexpr Rule object(std::string_view key, std::span<const Rule> rules) {
  return {key, Kind::object, false, 0, {}, rules};
}
constexpr Rule objects(std::string_view key, std::span<const Rule> rules) {
  return {key, Kind::objects, false, 0, {}, rules};
}
constexpr Rule required(Rule rule) {
  rule.required = true;
  return rule;
}

constexpr std::string_view kLights = "KHR_lights_punctual.lights";

constexpr Rule kTransform[] = {numbers("offset", 2), number("rotation"), numbers("scale", 2), count("texCoord")};
constexpr Rule kTextureExtensions[] = {object("KHR_texture_transform", kTransform)};
constexpr Rule kTexture[] = {required(index("index", "textures")), count("texCoord"), number("scale"),
                             number("strength"), object("extensions", kTextureExtensions)};
constexpr Rule kPbr[] = {numbers("baseColorFactor", 4), object("baseColorTexture", kTexture), number("metallicFactor"),
                         number("roughnessFactor"), object("metallicRoughnessTexture", kTexture)};
constexpr Rule kSpecular[] = {number("specularFactor"), object("specularTexture", kTexture),
                              numbers("specularColorFactor", 3), object("specularColorTexture", kTexture)};
constexpr Rule kIor[] = {number("ior")};
constexpr Rule kEmissiveStrength[] = {number("emissiveStrength")};
constexpr Rule kMaterialExtensions[] = {object("KHR_materials_specular", kSpecular), object("KHR_materials_ior", kIor),
                                        object("KHR_materials_emissive_strength", kEmissiveStrength),
                                        object("KHR_materials_unlit", {})};
constexpr Rule kMaterial[] = {text("name"),
                              object("pbrMetallicRoughness", kPbr),
                              object("normalTexture", kTexture),
                              object("occlusionTexture", kTexture),
                              object("emissiveTexture", kTexture),
                              numbers("emissiveFactor", 3),
                              text("alphaMode"),
                              number("alphaCutoff"),
                              boolean("doubleSided"),
                              object("extensions", kMaterialExtensions)};

constexpr Rule kAsset[] = {required(text("version")), text("minVersion")};
constexpr Rule kBuffer[] = {required(count("byteLength")), text("uri"), text("name")};
constexpr Rule kBufferView[] = {required(index("buffer", "buffers")), count("byteOffset"),
                                required(count("byteLength")), count("byteStride"), text("name")};
constexpr Rule kAccessor[] = {index("bufferView", "bufferViews"),
                              count("byteOffset"),
                              required(count("componentType")),
                              boolean("normalized"),
                              required(count("count")),
                              required(text("type")),
                              text("name"),
                              numbers("min", 0),
                              numbers("max", 0),
                              object("sparse", {})};
constexpr Rule kTargets[] = {index("POSITION", "accessors")};
constexpr Rule kPrimitive[] = {required({"attributes", Kind::indexMap, false, 0, "accessors"}),
                               index("indices", "accessors"), index("material", "materials"), count("mode"),
                               objects("targets", kTargets)};
constexpr Rule kMesh[] = {text("name"), required(objects("primitives", kPrimitive)), numbers("weights", 0)};
constexpr Rule kNodeLight[] = {required(index("light", kLights))};
constexpr Rule kNodeExtensions[] = {object("KHR_lights_punctual", kNodeLight)};
constexpr Rule kNode[] = {text("name"),
                          index("mesh", "meshes"),
                          index("camera", "cameras"),
                          index("skin", "skins"),
                          indices("children", "nodes"),
                          numbers("matrix", 16),
                          numbers("translation", 3),
                          numbers("rotation", 4),
                          numbers("scale", 3),
                          numbers("weights", 0),
                          object("extensions", kNodeExtensions)};
constexpr Rule kScene[] = {text("name"), indices("nodes", "nodes")};
constexpr Rule kImage[] = {text("uri"), text("mimeType"), index("bufferView", "bufferViews"), text("name")};
constexpr Rule kTextureObject[] = {index("source", "images"), index("sampler", "samplers"), text("name")};
constexpr Rule kSampler[] = {count("magFilter"), count("minFilter"), count("wrapS"), count("wrapT"), text("name")};
constexpr Rule kPerspective[] = {required(number("yfov")), required(number("znear")), number("zfar"),
                                 number("aspectRatio")};
constexpr Rule kOrthographic[] = {required(number("xmag")), required(number("ymag")), required(number("znear")),
                                  required(number("zfar"))};
constexpr Rule kCamera[] = {required(text("type")), text("name"), object("perspective", kPerspective),
                            object("orthographic", kOrthographic)};
constexpr Rule kSpot[] = {number("innerConeAngle"), number("outerConeAngle")};
constexpr Rule kLight[] = {required(text("type")), text("name"),    numbers("color", 3),
                           number("intensity"),    number("range"), object("spot", kSpot)};
constexpr Rule kLightsExtension[] = {required(objects("lights", kLight))};
constexpr Rule kExtensions[] = {object("KHR_lights_punctual", kLightsExtension)};
constexpr Rule kDocument[] = {required(object("asset", kAsset)),
                              index("scene", "scenes"),
                              objects("scenes", kScene),
                              objects("nodes", kNode),
                              objects("meshes", kMesh),
                              objects("accessors", kAccessor),
                              objects("bufferViews", kBufferView),
                              objects("buffers", kBuffer),
                              objects("materials", kMaterial),
                              objects("textures", kTextureObject),
                              objects("images", kImage),
                              objects("samplers", kSampler),
                              objects("cameras", kCamera),
                              objects("skins", {}),
                              objects("animations", {}),
                              object("extensions", kExtensions)};

class Checker {
public:
  Checker(const Json& document, const std::string& label) : m_document(document), m_label(label) {}

  void checkObject(Json& value, std::span<const Rule> rules, const std::string& place) const {
    if (!value.is_object()) fail(place, "not an object");
    for (const Rule& rule : rules) {
      const auto found = value.find(rule.key);
      const std::string at = place.empty() ? std::string(rule.key) : fmt::format("{}.{}", place, rule.key);
      if (found != value.end())
        checkValue(*found, rule, at);
      else if (rule.required)
        fail(at, "is missing");
    }
  }

private:
  [[noreturn]] void fail(const std::string& place, const std::string& reason) const {
    throw base::fileError(m_label, place, reason);
  }

  void checkValue(Json& value, const Rule& rule, const std::string& place) const {
    switch (rule.kind) {
    case Kind::text:
      if (!value.is_string()) fail(place, "not a string");
      break;
    case Kind::boolean:
      if (!value.is_boolean()) fail(place, "neither true nor false");
      break;
    case Kind::count:
      checkCount(value, place);
      break;
    case Kind::number:
      checkNumber(value, place);
      break;
    case Kind::index:
      checkIndex(value, rule.target, place);
      break;
    case Kind::object:
      checkObject(value, rule.rules, place);
      break;
    case Kind::indexMap:
      if (!value.is_object()) fail(place, "not an object");
      for (auto& [key, entry] : value.items()) checkIndex(entry, rule.target, fmt::format("{}.{}", place, key));
      break;
    case Kind::numbers:
    case Kind::indices:
    case Kind::objects:
      checkArray(value, rule, place);
      break;
    }
  }

  void checkArray(Json& value, const Rule& rule, const std::string& place) const {
    if (!value.is_array()) fail(place, "not an array");
    if (rule.size && value.size() != rule.size)
      fail(place, fmt::format("holds {} numbers where {} are needed", value.size(), rule.size));
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string at = fmt::format("{}[{}]", place, i);
      if (rule.kind == Kind::numbers)
        checkNumber(value[i], at);
      else if (rule.kind == Kind::indices)
        checkIndex(value[i], rule.target, at);
      else
        checkObject(value[i], rule.rules, at);
    }
  }

  void checkNumber(Json& value, const std::string& place) const {
    if (!value.is_number()) fail(place, "not a number");
    const double number = value.get<double>();
    if (!(std::abs(number) <= std::numeric_limits<float>::max())) fail(place, "not a finite 32-bit number");
    value = number; // the library behind us cuts whole numbers to 32 bits
  }

  void checkCount(Json& value, const std::string& place) const {
    if (!value.is_number()) fail(place, "not a whole number");
    const double number = value.get<double>();
    if (number != std::floor(number) || number < 0) fail(place, "not a whole number of at least 0");
    if (number > std::numeric_limits<std::int32_t>::max()) fail(place, "larger than 2^31 - 1");
    value = static_cast<std::int64_t>(number);
  }

  void checkIndex(Json& value, std::string_view target, const std::string& place) const {
    checkCount(value, place);
    const std::size_t size = sizeOf(target);
    if (value.get<std::size_t>() >= size)
      fail(place, fmt::format("index {} is out of range: there are {} {}", value.get<std::size_t>(), size, target));
  }

  std::size_t sizeOf(std::string_view target) const {
    const Json* holder = &m_document;
    std::string_view key = target;
    if (target == kLights) {
      const auto extensions = m_document.find("extensions");
      if (extensions == m_document.end() || !extensions->is_object()) return 0;
      const auto lights = extensions->find("KHR_lights_punctual");
      if (lights == extensions->end() || !lights->is_object()) return 0;
      holder = &*lights;
      key = "lights";
    }
    const auto found = holder->find(key);
    return found != holder->end() && found->is_array() ? found->size() : 0;
  }

  const Json& m_document;
  const std::string& m_label;
};

} // namespace

void checkGltfSchema(nlohmann::json& document, const std::string& label) {
  if (!document.is_object()) throw base::fileError(label, "JSON", "the root is not an object");
  Checker(document, label).checkObject(document, kDocument, {});
  const std::string version = document["asset"]["version"].get<std::string>();
  if (!version.starts_with("2."))
    throw base::fileError(label, "asset.version", fmt::format("'{}' is not glTF 2", version.substr(0, 20)));
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    const auto list = document.find(key);
    if (list == document.end()) continue;
    if (!list->is_array()) throw base::fileError(label, key, "not an array");
    for (const Json& name : *list)
      if (!name.is_string()) throw base::fileError(label, key, "does not hold strings only");
  }
}

} // namespace parity::scenes
