// A plain OpenEXR header, and in which order the image library has its channels.
#include "base/image/exr_header.h"

#include <strings.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>
#include <utility>

namespace parity::base {

namespace {

constexpr int kMostChannels = 1024; // kMaxImageChannels, which the image library's module tells

struct ChannelName {
  std::string_view layer, last; // "diffuse" and "R" of diffuse.R
  int rank = 0;
};

bool isSame(std::string_view a, std::string_view b) {
  return a.size() == b.size() && strncasecmp(a.data(), b.data(), a.size()) == 0;
}

ChannelName splitName(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return {{}, name};
  return {name.substr(0, dot), name.substr(dot + 1)};
}

// Well-known names come first, in this order. In a layer of positions, X, Y and Z belong together.
template <std::size_t N> int rankOf(std::string_view name, const std::array<std::string_view, N>& known) {
  const auto at = std::find_if(known.begin(), known.end(), [&](std::string_view each) { return isSame(name, each); });
  return at == known.end() ? 10000 : static_cast<int>(at - known.begin());
}

void rankLayer(std::span<ChannelName> layer) {
  constexpr std::array<std::string_view, 20> kColors{"R",    "Red",  "G",  "Green", "B",     "Blue", "Y",
                                                     "real", "imag", "A",  "Alpha", "AR",    "RA",   "AG",
                                                     "GA",   "AB",   "BA", "Z",     "Depth", "Zback"};
  constexpr std::array<std::string_view, 21> kPlaces{"R",  "Red", "G",    "Green", "B",  "Blue",  "X",
                                                     "Y",  "Z",   "real", "imag",  "A",  "Alpha", "AR",
                                                     "RA", "AG",  "GA",   "AB",    "BA", "Depth", "Zback"};
  const auto has = [&](std::string_view name) {
    return std::any_of(layer.begin(), layer.end(), [&](const ChannelName& each) { return isSame(each.last, name); });
  };
  const bool isPlace = has("X") && (has("Y") || has("Z"));
  for (ChannelName& each : layer) each.rank = isPlace ? rankOf(each.last, kPlaces) : rankOf(each.last, kColors);
}

// The channels of the file, in the library's order.
std::vector<int> orderChannels(std::vector<ChannelName>& names) {
  std::vector<int> order(names.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t begin = 0, end = 0; begin < names.size(); begin = end) {
    while (end < names.size() && names[end].layer == names[begin].layer) ++end;
    rankLayer(std::span(names).subspan(begin, end - begin));
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const ChannelName &x = names[static_cast<std::size_t>(a)], &y = names[static_cast<std::size_t>(b)];
    if (x.layer != y.layer) return x.layer < y.layer;
    return x.rank != y.rank ? x.rank < y.rank : x.last < y.last;
  });
  return order;
}

bool readChannels(const exr_attr_chlist_t& list, ExrHeader& header) {
  if (list.num_channels < 1 || list.num_channels > kMostChannels) return false;
  std::vector<ChannelName> names;
  std::string_view last;
  for (int c = 0; c < list.num_channels; ++c) {
    const exr_attr_chlist_entry_t& entry = list.entries[c];
    const std::string_view name(entry.name.str, static_cast<std::size_t>(entry.name.length));
    const bool isHalf = entry.pixel_type == EXR_PIXEL_HALF;
    if ((!isHalf && entry.pixel_type != EXR_PIXEL_FLOAT) || entry.x_sampling != 1 || entry.y_sampling != 1)
      return false;
    if (name.empty() || (c > 0 && !(last < name))) return false;
    names.push_back(splitName(name));
    // Luminance and differences of colours are made into RGB.
    if (isSame(names.back().last, "BY") || isSame(names.back().last, "RY")) return false;
    // A layer's channels then lie together.
    const bool isNew = c > 0 && names[static_cast<std::size_t>(c) - 1].layer != names.back().layer;
    if (isNew && std::any_of(names.begin(), names.end() - 1,
                             [&](const ChannelName& each) { return each.layer == names.back().layer; }))
      return false;
    header.channels.push_back({0, isHalf});
    last = name;
  }
  const std::vector<int> order = orderChannels(names);
  ImageInfo& info = header.info;
  for (std::size_t place = 0; place < order.size(); ++place) {
    const auto from = static_cast<std::size_t>(order[place]);
    header.channels[from].place = static_cast<int>(place);
    info.channelNames.emplace_back(list.entries[from].name.str,
                                   static_cast<std::size_t>(list.entries[from].name.length));
    if (info.alphaChannel < 0 && (isSame(names[from].last, "A") || isSame(names[from].last, "Alpha")))
      info.alphaChannel = static_cast<int>(place);
  }
  info.alphaAssociated = info.alphaChannel >= 0;
  const bool isHalf =
      std::all_of(header.channels.begin(), header.channels.end(), [](const auto& c) { return c.isHalf; });
  info.bits = isHalf ? 16 : 32;
  return true;
}

// False where the image library reads more from an attribute than we do.
bool readAttributes(exr_const_context_t file, ImageInfo& info) {
  constexpr std::array kForLibrary{
      "Orientation",     "chromaticities",         "textureformat", "envmap",
      "oiio:ColorSpace", "oiio:UnassociatedAlpha", "multiView",     "tiff:PhotometricInterpretation"};
  int32_t count = 0;
  if (exr_get_attribute_count(file, 0, &count) != EXR_ERR_SUCCESS) return false;
  info.declaredLinear = true; // what the format is for
  for (int32_t i = 0; i < count; ++i) {
    const exr_attribute_t* attribute = nullptr;
    if (exr_get_attribute_by_index(file, 0, EXR_ATTR_LIST_FILE_ORDER, i, &attribute) != EXR_ERR_SUCCESS) return false;
    const std::string_view name(attribute->name, attribute->name_length);
    if (name == "Orientation" && attribute->type == EXR_ATTR_INT) {
      info.orientation = attribute->i;
    } else if (name == "chromaticities" && attribute->type == EXR_ATTR_CHROMATICITIES) {
      const exr_attr_chromaticities_t& c = *attribute->chromaticities;
      info.chromaticities = {c.red_x, c.red_y, c.green_x, c.green_y, c.blue_x, c.blue_y, c.white_x, c.white_y};
    } else if (name == "oiio:ColorSpace" && attribute->type == EXR_ATTR_STRING) {
      const std::string_view space(attribute->string->str, static_cast<std::size_t>(attribute->string->length));
      if (!space.empty()) info.declaredLinear = isSame(space, "linear");
    } else if (std::any_of(kForLibrary.begin(), kForLibrary.end(),
                           [&](const char* each) { return isSame(name, each); })) {
      return false;
    }
  }
  return true;
}

// Of PXR24 the core library (3.1) takes damage that the other one refuses, of B44 it reads floats wrong, and DWA it
// lacks.
bool isReadable(exr_compression_t compression) {
  return compression == EXR_COMPRESSION_NONE || compression == EXR_COMPRESSION_RLE ||
         compression == EXR_COMPRESSION_ZIPS || compression == EXR_COMPRESSION_ZIP ||
         compression == EXR_COMPRESSION_PIZ;
}

// Values that are handed on, and of tiles those that the library holds beside them.
bool isWithin(const ExrHeader& header, const ImageLimits& limits) {
  const auto width = static_cast<std::size_t>(header.width), height = static_cast<std::size_t>(header.height);
  const std::size_t channels = header.channels.size(), pixels = width * height;
  const std::size_t held = header.isTiled ? static_cast<std::size_t>(header.info.bits) / 8 : 0;
  return width <= limits.maxSide && height <= limits.maxSide && pixels <= kMaxImagePixels &&
         pixels <= limits.maxPixels && channels <= kMaxImageValues / pixels &&
         pixels * channels * (sizeof(float) + held) <= limits.maxBytes;
}

} // namespace

std::optional<ExrHeader> readExrHeader(exr_const_context_t file, const ImageLimits& limits) {
  int parts = 0;
  exr_storage_t storage{};
  exr_compression_t compression{};
  exr_lineorder_t order{};
  const exr_attr_chlist_t* channels = nullptr;
  exr_attr_box2i_t data{}, display{};
  ExrHeader header;
  if (exr_get_count(file, &parts) != EXR_ERR_SUCCESS || parts != 1 ||
      exr_get_storage(file, 0, &storage) != EXR_ERR_SUCCESS ||
      exr_get_compression(file, 0, &compression) != EXR_ERR_SUCCESS || !isReadable(compression) ||
      exr_get_lineorder(file, 0, &order) != EXR_ERR_SUCCESS || order != EXR_LINEORDER_INCREASING_Y ||
      exr_get_channels(file, 0, &channels) != EXR_ERR_SUCCESS || !readChannels(*channels, header) ||
      exr_get_data_window(file, 0, &data) != EXR_ERR_SUCCESS ||
      exr_get_display_window(file, 0, &display) != EXR_ERR_SUCCESS || !readAttributes(file, header.info))
    return std::nullopt;
  if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED) return std::nullopt;
  header.isTiled = storage == EXR_STORAGE_TILED;
  int32_t across = 0, down = 0;
  if (header.isTiled && (exr_get_tile_levels(file, 0, &across, &down) != EXR_ERR_SUCCESS || across != 1 || down != 1))
    return std::nullopt;
  // checkExr() has bounded the data window, but not where it lies.
  constexpr int kFarthest = 1 << 24;
  for (const int v : {data.min.x, data.min.y, display.min.x, display.min.y, display.max.x, display.max.y})
    if (v < -kFarthest || v > kFarthest) return std::nullopt;
  if (data.max.x < data.min.x || data.max.y < data.min.y || data.max.x > kFarthest || data.max.y > kFarthest)
    return std::nullopt;
  header.width = data.max.x - data.min.x + 1, header.height = data.max.y - data.min.y + 1;
  ImageInfo& info = header.info;
  info.x = data.min.x, info.y = data.min.y;
  info.fullX = display.min.x, info.fullY = display.min.y;
  info.fullWidth = display.max.x - display.min.x + 1, info.fullHeight = display.max.y - display.min.y + 1;
  if (!isWithin(header, limits)) return std::nullopt;
  return header;
}

} // namespace parity::base
