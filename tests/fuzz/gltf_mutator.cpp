// Mutations of glTF files that keep the container whole, so that they reach what lies behind it.
#include "fuzz/gltf_mutator.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <random>

#include "fuzz/gltf_parts.h"
#include "fuzz/words.h"

namespace parity::tests {
namespace {

using Json = nlohmann::json;

constexpr double kNumbers[] = {-1,         0,
                               1,          2,
                               3,          4,
                               5,          7,
                               16,         64,
                               255,        256,
                               65535,      65536,
                               5120,       5121,
                               5122,       5123,
                               5125,       5126,
                               2147483647, 4294967295.0,
                               1e-45,      1e-20,
                               0.5,        1.5,
                               3.4e38,     -3.4e38,
                               1e300,      9007199254740993.0};
constexpr std::size_t kMaxListed = 20000; // values of a document among which one is chosen

class Mutator {
public:
  Mutator(unsigned seed, MutateBytes mutateBytes) : m_random(seed), m_mutateBytes(mutateBytes) {}

  bool chance(unsigned oneIn) { return m_random() % oneIn == 0; }

  void editJson(Json& json) {
    for (unsigned edits = 1 + pick(3); edits > 0; --edits) {
      std::vector<Json*> values;
      list(json, values);
      edit(*values[pick(values.size())], values);
      if (!json.is_object()) json = Json::object();
    }
  }

  // Bytes of one buffer view, or of the whole binary chunk.
  void editBinary(GltfParts& parts) {
    std::size_t begin = 0, length = parts.binary.size();
    if (const auto views = parts.json.find("bufferViews");
        views != parts.json.end() && views->is_array() && !views->empty() && !chance(8)) {
      const Json& view = (*views)[pick(views->size())];
      const std::size_t offset = readCount(view, "byteOffset"), bytes = readCount(view, "byteLength");
      if (offset < length) {
        begin = offset;
        length = std::min(length - offset, bytes);
      }
    }
    std::vector<std::uint8_t> range(parts.binary.begin() + static_cast<std::ptrdiff_t>(begin),
                                    parts.binary.begin() + static_cast<std::ptrdiff_t>(begin + length));
    editBytes(range, false);
    std::copy(range.begin(), range.end(), parts.binary.begin() + static_cast<std::ptrdiff_t>(begin));
  }

  // The bytes of one data uri; false where there is none.
  bool editDataUri(Json& json) {
    std::vector<Json*> values;
    list(json, values);
    std::erase_if(values, [](const Json* value) {
      return !value->is_string() || value->get_ref<const std::string&>().find(";base64,") == std::string::npos;
    });
    if (values.empty()) return false;
    auto& text = values[pick(values.size())]->get_ref<std::string&>();
    const std::size_t data = text.find(";base64,") + 8;
    std::vector<std::uint8_t> bytes = fromBase64(std::string_view(text).substr(data));
    editBytes(bytes, chance(4));
    text = text.substr(0, data) + toBase64(bytes);
    return true;
  }

private:
  std::size_t pick(std::size_t count) { return m_random() % count; }

  static std::size_t readCount(const Json& object, const char* key) {
    if (!object.is_object()) return 0;
    const auto value = object.find(key);
    return value != object.end() && value->is_number_unsigned() ? value->get<std::size_t>() : 0;
  }

  static void list(Json& value, std::vector<Json*>& values) {
    if (values.size() >= kMaxListed) return;
    values.push_back(&value);
    if (value.is_structured())
      for (Json& entry : value) list(entry, values);
  }

  void editBytes(std::vector<std::uint8_t>& bytes, bool mayGrow) {
    if (bytes.empty()) return;
    const std::size_t size = bytes.size();
    bytes.resize(mayGrow ? size + 64 : size);
    bytes.resize(m_mutateBytes(bytes.data(), size, bytes.size()));
    if (!chance(4)) repairPng(bytes);
  }

  void edit(Json& value, const std::vector<Json*>& values) {
    if (chance(12)) return other(value, values);
    if (value.is_number()) return editNumber(value, values);
    if (value.is_string()) return void(value = kGltfValues[pick(std::size(kGltfValues))]);
    if (value.is_boolean()) return void(value = !value.get<bool>());
    if (value.is_object()) return editObject(value, values);
    if (value.is_array()) return editArray(value, values);
    value = 0;
  }

  // Something that stands elsewhere, or of another type.
  void other(Json& value, const std::vector<Json*>& values) {
    const Json copy =
        chance(2) ? *values[pick(values.size())]
                  : std::array<Json, 6>{Json(), Json(0), Json("x"), Json::array(), Json::object(), Json(true)}[pick(6)];
    if (copy.dump().size() < 4096) value = copy; // `value` may be an ancestor of the original: a copy, then
  }

  void editNumber(Json& value, const std::vector<Json*>& values) {
    const double old = value.get<double>();
    double result = kNumbers[pick(std::size(kNumbers))];
    switch (pick(6)) {
    case 0:
      result = old + 1;
      break;
    case 1:
      result = old - 1;
      break;
    case 2:
      result = old * 2;
      break;
    case 3: // another number of the document: an index of something else, a count, an offset
      for (int tries = 0; tries < 8; ++tries)
        if (const Json& from = *values[pick(values.size())]; from.is_number()) result = from.get<double>();
      break;
    default:
      break;
    }
    if (result >= 0 && result < 9e15 && result == static_cast<double>(static_cast<std::uint64_t>(result)))
      value = static_cast<std::uint64_t>(result);
    else
      value = result;
  }

  void editObject(Json& value, const std::vector<Json*>& values) {
    const auto at = [&] {
      auto entry = value.begin();
      std::advance(entry, static_cast<std::ptrdiff_t>(pick(value.size())));
      return entry;
    };
    const char* key = kGltfKeys[pick(std::size(kGltfKeys))];
    const unsigned choice = static_cast<unsigned>(pick(4));
    if (choice == 0 || value.empty()) {
      const Json copy = *values[pick(values.size())];
      if (copy.dump().size() < 4096) value[key] = copy;
    } else if (choice == 1) {
      value.erase(at());
    } else if (choice == 2) {
      Json moved = std::move(*at());
      value[key] = std::move(moved);
    } else {
      const auto first = at(), second = at();
      std::swap(*first, *second);
    }
  }

  void editArray(Json& value, const std::vector<Json*>& values) {
    const auto at = [&] { return value.begin() + static_cast<std::ptrdiff_t>(pick(value.size())); };
    const unsigned choice = static_cast<unsigned>(pick(5));
    if (value.empty() || choice == 0) {
      const Json copy = value.empty() ? *values[pick(values.size())] : *at();
      if (copy.dump().size() < 4096) value.push_back(copy);
    } else if (choice == 1) {
      value.erase(at());
    } else if (choice == 2) {
      std::swap(*at(), *at());
    } else if (choice == 3) {
      value = Json::array();
    } else if (const Json copy = *at(); copy.dump().size() < 256) {
      for (std::size_t i = pick(64); i > 0; --i) value.push_back(copy);
    }
  }

  std::mt19937 m_random;
  MutateBytes m_mutateBytes;
};

} // namespace

std::size_t mutateGltf(std::uint8_t* data, std::size_t size, std::size_t maxSize, unsigned seed,
                       MutateBytes mutateBytes) {
  Mutator mutator(seed, mutateBytes);
  if (mutator.chance(8)) return mutateBytes(data, size, maxSize);
  std::optional<GltfParts> parts = takeApart({data, size});
  if (!parts) return mutateBytes(data, size, maxSize);
  if (mutator.chance(3)) {
    if (!parts->binary.empty())
      mutator.editBinary(*parts);
    else if (!mutator.editDataUri(parts->json))
      mutator.editJson(parts->json);
  } else
    mutator.editJson(parts->json);
  const std::vector<std::uint8_t> bytes = putTogether(*parts);
  if (bytes.size() > maxSize) return mutateBytes(data, size, maxSize);
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

} // namespace parity::tests
