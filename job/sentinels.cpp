#include "job/sentinels.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"

namespace parity::job {

namespace {

std::map<std::string, const std::vector<std::byte>*> byName(const std::vector<EncodedPicture>& pictures) {
  std::map<std::string, const std::vector<std::byte>*> files;
  for (const EncodedPicture& picture : pictures) files.emplace(picture.file, &picture.bytes);
  return files;
}

// Empty: nothing differs.
std::string describeDifference(const SceneRecord& cached, const SceneRecord& now) {
  if (toBytes({cached.result, cached.prefixes, {}}) != toBytes({now.result, now.prefixes, {}})) return "its figures";
  const auto before = byName(cached.pictures), here = byName(now.pictures);
  if (before.size() != here.size()) return "the number of its pictures";
  for (const auto& [file, bytes] : here)
    if (const auto found = before.find(file); found == before.end() || *found->second != *bytes) return file;
  return {};
}

} // namespace

std::vector<std::size_t> chooseSentinels(const std::vector<SceneRequest>& scenes, const std::string& date) {
  constexpr std::size_t kLeast = 8, kShare = 100;
  std::vector<std::pair<std::string, std::size_t>> ranks;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    ranks.emplace_back(base::Hasher().add(date).add(scenes[i].name).hex(), i);
  std::ranges::sort(ranks);
  ranks.resize(std::min(scenes.size(), std::max(kLeast, (scenes.size() + kShare - 1) / kShare)));
  std::vector<std::size_t> chosen;
  for (const auto& [rank, place] : ranks) chosen.push_back(place);
  std::ranges::sort(chosen);
  return chosen;
}

void requireSame(const SceneRecord& cached, const SceneRecord& now) {
  if (const std::string what = describeDifference(cached, now); !what.empty())
    throw base::fileError("sentinel", "",
                          fmt::format("the scene came out otherwise than the result that the cache holds of the same "
                                      "inputs (nondeterminism): {} differ{}",
                                      what, what == "its figures" ? "" : "s"));
}

} // namespace parity::job
