#include "compare/images/mask_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/image/image_io.h"

namespace parity::compare {

namespace {

using Ids = base::BasicImage<std::uint32_t>;

constexpr std::size_t kMaxRegions = 65536;

void requireSize(const std::string& file, int maskWidth, int maskHeight, int width, int height) {
  if (maskWidth != width || maskHeight != height)
    throw base::Error(base::ExitCode::notComparable, file, fmt::format("{}x{}", maskWidth, maskHeight),
                      fmt::format("the pictures are {}x{}", width, height));
}

std::string placeOf(std::size_t pixel, int width) {
  return fmt::format("x {}, y {}", pixel % static_cast<std::size_t>(width), pixel / static_cast<std::size_t>(width));
}

// The first channel as ids.
Ids idsOf(const std::string& file, const base::ImageFile& stored) {
  const base::Image& image = stored.pixels;
  Ids ids(image.width, image.height, 1);
  if (stored.info.integer) {
    const Ids all = base::readIntegers(file);
    for (std::size_t p = 0; p < ids.pixels.size(); ++p) ids.pixels[p] = all.pixels[p * all.channels];
    return ids;
  }
  for (std::size_t p = 0; p < ids.pixels.size(); ++p) {
    const float v = image.pixels[p * image.channels];
    // 4294967296 is the first float beyond 32 bits; NaN fails every comparison.
    if (!(v >= 0 && v < 4294967296.0f && v == std::floor(v)))
      throw base::fileError(file, placeOf(p, image.width),
                            fmt::format("{} is not an id: ids are whole numbers from 0", v));
    ids.pixels[p] = static_cast<std::uint32_t>(v);
  }
  return ids;
}

std::vector<base::PixelList> regionsOfIds(const MaskRequest& request, const Ids& ids, const Rect& area) {
  const std::string file = request.file.string();
  for (const std::uint32_t id : request.ignoredIds)
    if (std::find(ids.pixels.begin(), ids.pixels.end(), id) == ids.pixels.end())
      throw base::fileError(file, fmt::format("id {}", id), "no pixel has it, so --ignore-id has no effect");
  std::map<std::uint32_t, std::size_t> places;
  std::vector<base::PixelList> regions;
  // Neighbours mostly share an id: the last one is tried first.
  std::uint32_t lastId = 0;
  std::size_t lastPlace = std::numeric_limits<std::size_t>::max();
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) {
      const std::uint32_t id = *ids.at(x, y);
      if (lastPlace == std::numeric_limits<std::size_t>::max() || id != lastId) {
        const auto [place, isNew] = places.try_emplace(id, regions.size());
        if (isNew && regions.size() == kMaxRegions)
          throw base::fileError(file, "",
                                fmt::format("holds more than {} ids, so it is probably not a mask", kMaxRegions));
        if (isNew) regions.push_back({fmt::format("id {}", id), {}, {}});
        lastId = id;
        lastPlace = place->second;
      }
      regions[lastPlace].pixels.push_back(static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(ids.width) +
                                          static_cast<std::uint32_t>(x));
    }
  std::vector<base::PixelList> sorted;
  for (const auto& [id, place] : places)
    if (std::find(request.ignoredIds.begin(), request.ignoredIds.end(), id) == request.ignoredIds.end())
      sorted.push_back(std::move(regions[place]));
  if (sorted.empty()) throw base::fileError(file, "", "no pixel is left, because every id is ignored");
  return sorted;
}

// The ids that lie outside the area, in words; empty: none.
std::string describeAbsent(const MaskRequest& request, const Ids& ids, const std::vector<base::PixelList>& regions) {
  constexpr std::size_t kMostNamed = 16;
  if (!request.area) return {};
  std::set<std::uint32_t> absent;
  for (std::size_t p = 0; p < ids.pixels.size(); ++p)
    if (p == 0 || ids.pixels[p] != ids.pixels[p - 1]) absent.insert(ids.pixels[p]);
  for (const std::uint32_t id : request.ignoredIds) absent.erase(id);
  std::set<std::string> present;
  for (const base::PixelList& region : regions) present.insert(region.name);
  std::string names;
  std::size_t count = 0;
  for (const std::uint32_t id : absent)
    if (const std::string name = fmt::format("id {}", id); !present.contains(name) && ++count <= kMostNamed)
      names += (names.empty() ? "" : ", ") + name;
  if (count > kMostNamed) names += fmt::format(" and {} more", count - kMostNamed);
  return count == 0 ? "" : "not compared, because they have no pixel in the area: " + names;
}

// One weight a pixel, from grey of one or three equal channels.
base::PixelList regionOfWeights(const std::string& file, const base::ImageFile& stored, const Rect& area) {
  const base::Image& image = stored.pixels;
  const int alpha = stored.info.alphaChannel;
  base::PixelList region{"mask", {}, {}};
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) {
      const float* values = image.at(x, y);
      const auto pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
      const float weight = values[alpha == 0 && image.channels > 1 ? 1 : 0];
      for (int c = 0; c < image.channels; ++c)
        if (c == alpha && image.channels > 1 ? values[c] != 1 : values[c] != weight)
          throw base::fileError(file, placeOf(pixel, image.width),
                                c == alpha ? "is not opaque; white must mean inside, black outside"
                                           : "is not grey; white must mean inside, black outside");
      if (!(weight >= 0 && weight <= 1))
        throw base::fileError(file, placeOf(pixel, image.width), fmt::format("{} is not a weight from 0 to 1", weight));
      if (weight == 0) continue;
      region.pixels.push_back(static_cast<std::uint32_t>(pixel));
      region.weights.push_back(weight);
    }
  if (region.pixels.empty()) throw base::fileError(file, "", "the mask is empty: no pixel is inside");
  if (std::all_of(region.weights.begin(), region.weights.end(), [](float w) { return w == 1; })) region.weights.clear();
  return region;
}

base::PixelList regionOfArea(const Rect& area, int width, int height) {
  const bool whole = area == Rect{0, 0, width, height};
  base::PixelList region{whole ? "image" : "area", {}, {}};
  region.pixels.reserve(static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height));
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x)
      region.pixels.push_back(static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width) +
                              static_cast<std::uint32_t>(x));
  return region;
}

} // namespace

MaskRegions findRegions(const MaskRequest& request, int width, int height) {
  const Rect area = request.area.value_or(Rect{0, 0, width, height});
  // Compared without sums, which could overflow.
  if (area.empty() || area.x < 0 || area.y < 0 || area.width > width - area.x || area.height > height - area.y)
    throw base::Error(base::ExitCode::notComparable, "--region",
                      fmt::format("{},{},{},{}", area.x, area.y, area.width, area.height),
                      fmt::format("is partly outside the pictures, which are {}x{}", width, height));
  MaskRegions result;
  if (area != Rect{0, 0, width, height})
    result.where = fmt::format("area {},{},{},{}", area.x, area.y, area.width, area.height);
  if (request.file.empty()) {
    result.lists = {regionOfArea(area, width, height)};
    return result;
  }
  const std::string file = request.file.string();
  result.where += (result.where.empty() ? "mask " : " of mask ") + file;
  const base::ImageFile stored = base::readImageFile(request.file, request.limits);
  requireSize(file, stored.pixels.width, stored.pixels.height, width, height);
  const bool ids = request.kind == MaskKind::ids ||
                   (request.kind == MaskKind::automatic && (!stored.info.integer || stored.info.bits > 16));
  if (ids) {
    const Ids values = idsOf(file, stored);
    result.lists = regionsOfIds(request, values, area);
    if (std::string absent = describeAbsent(request, values, result.lists); !absent.empty())
      result.notes.push_back(std::move(absent));
    return result;
  }
  if (!request.ignoredIds.empty())
    throw base::Error(base::ExitCode::usage, "--ignore-id", file,
                      "is read as a mask of weights; --mask-kind ids reads it as ids");
  result.lists = {regionOfWeights(file, stored, area)};
  return result;
}

} // namespace parity::compare
