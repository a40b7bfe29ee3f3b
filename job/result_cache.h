// Whole results kept between runs: a scene that would come out as before is not rendered again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/surface/permutations.h"
#include "job/conditions.h"
#include "job/context.h"
#include "job/scene/scene_record.h"

namespace parity::job {

// What of a run decides a scene's result, besides its conditions.
struct ResultWish {
  std::vector<std::string> statistics; // that are measured for budgets
  bool pictures = false;
  bool pixelData = false;              // beside the pictures
  gpu::PermutationBudget permutations; // specialised shaders need not round alike
  std::size_t views = 1;               // by how many they are chosen
};

// Not without a cache, nor under the validation layer.
bool keepsResults(const Context& context);

// The key of all that decides the result but the content of the files that the scene is read from: build, device and
// driver, how they round (job/numerics.h), every condition. Budgets are not in it: they judge afterwards. Nothing where
// results are not kept.
std::optional<std::string> resultKey(Context& context, const Conditions& conditions, const ResultWish& wish);

// The key of the same result with these materials attributed by their terms, as materialsToAttribute lists them view
// by view: what the budgets lead to.
std::string attributedKey(const std::string& key, const std::vector<std::vector<std::size_t>>& materials);

// The result of that key, if the scene's files are what they were: all that its first run has read, by content; those
// of baked light by the checksums of its manifest. filesRead: not null: becomes those files.
std::optional<SceneRecord> findResult(const base::Cache& cache, const std::string& key, const SceneRequest& request,
                                      std::vector<scenes::SourceFile>* filesRead = nullptr);

// sources: the files that the scene was read from. Without effect where one of them is out of reach by now.
void storeResult(const base::Cache& cache, const std::string& key, const SceneRequest& request,
                 const std::vector<scenes::SourceFile>& sources, const SceneRecord& record);

} // namespace parity::job
