// Two entries a result, as ccache has it: the names of the files under the key of the options, the result itself under
// that key and the content of those files.
#include "job/result_cache.h"

#include "bake/baked_folder.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/member_count.h"
#include "base/version.h"
#include "report/record/archive.h"

namespace parity::job {

namespace {

// Where a link leads is part of what a scene is: links out of its folder are refused.
std::string placeOf(const std::filesystem::path& file, const SceneRequest& request) {
  const std::filesystem::path folder = std::filesystem::path(request.scene).parent_path();
  return std::filesystem::canonical(file)
      .lexically_relative(std::filesystem::canonical(folder.empty() ? "." : folder))
      .string();
}

std::string contentKey(const std::string& key, const SceneRequest& request,
                       const std::vector<scenes::SourceFile>& sources) {
  base::Hasher hasher;
  hasher.add(key);
  for (const scenes::SourceFile& source : sources)
    hasher.add(source.file.string()).add(placeOf(source.file, request)).add(source.hash);
  return "scene-" + hasher.hex();
}

} // namespace

static_assert(base::memberCount<ResultWish>() == 5 && base::memberCount<gpu::PermutationBudget>() == 2,
              "a new member goes into the key, or is named here with the reason why not");

bool keepsResults(const Context& context) { return context.cache().enabled() && !context.settings().device.validation; }

std::optional<std::string> resultKey(Context& context, const Conditions& conditions, const ResultWish& wish) {
  if (!keepsResults(context)) return std::nullopt;
  const gpu::DeviceReport& device = context.deviceReport();
  base::Hasher hasher;
  hasher.add(base::kVersion).add(context.buildId());
  for (const std::string& text : {device.name, device.driver, device.build}) hasher.add(text);
  hasher.add(context.numerics());
  hasher.add(hashOf(conditions));
  hasher.addValue(wish.statistics.size());
  for (const std::string& statistic : wish.statistics) hasher.add(statistic);
  hasher.addValue(wish.pictures).addValue(wish.pixelData);
  hasher.addValue(static_cast<std::uint64_t>(wish.permutations.own)).addValue(wish.permutations.shares);
  hasher.addValue(static_cast<std::uint64_t>(wish.views));
  return hasher.hex();
}

std::string attributedKey(const std::string& key, const std::vector<std::vector<std::size_t>>& materials) {
  base::Hasher hasher;
  hasher.add(key).add("attributed");
  for (std::size_t view = 0; view < materials.size(); ++view)
    for (const std::size_t material : materials[view]) hasher.add(std::to_string(view)).add(std::to_string(material));
  return hasher.hex();
}

std::optional<SceneRecord> findResult(const base::Cache& cache, const std::string& key, const SceneRequest& request,
                                      std::vector<scenes::SourceFile>* filesRead) {
  const auto manifest = cache.find("files-" + key);
  if (!manifest) return std::nullopt;
  // The key holds what the bake's manifest says; its files may be others by now, or gone.
  if (!request.settings.scene.baked.empty() && !bake::isWhole(request.settings.scene.baked)) return std::nullopt;
  std::vector<scenes::SourceFile> sources;
  std::string wanted;
  try {
    report::Reader read(*manifest);
    std::vector<std::string> files;
    read(files);
    for (const std::string& file : files) sources.push_back({file, base::hashOfFile(file)});
    wanted = contentKey(key, request, sources);
  } catch (const std::exception&) { // a file is gone: loading the scene will say so, if it still needs it
    return std::nullopt;
  }
  const auto bytes = cache.find(wanted);
  if (filesRead) *filesRead = std::move(sources);
  return bytes ? recordFromBytes(*bytes) : std::nullopt;
}

void storeResult(const base::Cache& cache, const std::string& key, const SceneRequest& request,
                 const std::vector<scenes::SourceFile>& sources, const SceneRecord& record) {
  std::vector<std::string> files;
  for (const scenes::SourceFile& source : sources) files.push_back(source.file.string());
  std::string wanted;
  try {
    wanted = contentKey(key, request, sources);
  } catch (const std::filesystem::filesystem_error&) { // a file is gone since
    return;
  }
  report::Writer write;
  write(files);
  if (cache.store(wanted, toBytes(record))) cache.store("files-" + key, write.bytes());
}

} // namespace parity::job
