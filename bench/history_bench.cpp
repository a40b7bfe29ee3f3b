// A history of 400 nights of 5,000 rows, in which 1 % of the rows change each night: time of adding a night and of
// blame, bytes of the index and of the run files. Not asserted:
//   build/bench_history FOLDER [NIGHTS]
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "history/blame.h"
#include "history/nights.h"
#include "history/run_file.h"
#include "history/store.h"
#include "history/synthetic_nights.h"

namespace {

namespace fs = std::filesystem;
using namespace parity;

class Watch {
public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count(); }

private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

void printTimes(const char* what, std::vector<double> seconds) {
  std::ranges::sort(seconds);
  fmt::print("{}: median {:.0f} ms, 95 % {:.0f} ms, most {:.0f} ms ({} times)\n", what,
             1e3 * seconds[seconds.size() / 2], 1e3 * seconds[seconds.size() * 95 / 100], 1e3 * seconds.back(),
             seconds.size());
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "bench_history FOLDER [NIGHTS]: the folder must not be there\n");
    return 64;
  }
  const fs::path folder = argv[1];
  if (fs::exists(folder)) {
    fmt::print(stderr, "{} is there already\n", folder.string());
    return 64;
  }
  const int nightCount = argc > 2 ? std::atoi(argv[2]) : 400;
  tests::Nights nights({.scenes = 250, .views = 4, .materials = 4}); // 250 x 4 x (4 and the whole image) = 5,000 rows
  const std::vector<std::string> causes = {"asset", "environment", "request", "bake"};
  std::mt19937 random(3);
  std::vector<tests::Planted> planted;
  std::vector<std::string> ids;
  std::vector<double> adding, blaming;
  for (int night = 0; night < nightCount; ++night) {
    if (night > 0)
      for (int i = 0; i < 5; ++i) // 50 rows: 1 %
        for (const tests::Planted& each : nights.plant(causes[random() % causes.size()], random() % 250, 10))
          planted.push_back(each);
    const history::RunRecord record = nights.next();
    const Watch watch;
    history::Store store(folder, history::Store::For::writing); // as a command does
    ids.push_back(store.add(record).id);
    adding.push_back(watch.seconds());
  }
  printTimes("adding a night", adding);
  std::size_t checked = 0, wrong = 0;
  std::unordered_map<std::string, const tests::Planted*> last;
  for (const tests::Planted& each : planted) last[each.subject] = &each; // what blame must find
  for (const auto& [subject, step] : last) {
    if (++checked > 1000) break;
    const Watch watch;
    const history::Store store(folder, history::Store::For::reading);
    const history::Blame blame = history::blame(store.index(), subject, "flip.mean", {});
    blaming.push_back(watch.seconds());
    const bool isFound = blame.isChanged && blame.now.name == ids[step->night] && blame.figures[0].now == step->now &&
                         std::ranges::count(blame.inputs, step->cause, &history::InputStep::what) == 1 &&
                         !blame.isNondeterministic;
    wrong += isFound ? 0 : 1;
  }
  printTimes("blame", blaming);
  fmt::print("blamed on another run or cause: {} of {}\n", wrong, blaming.size());
  std::uintmax_t runBytes = 0;
  for (const std::string& id : history::listRuns(folder)) runBytes += fs::file_size(history::runFile(folder, id));
  fmt::print("index {:.1f} MB, run files {:.1f} MB\n",
             static_cast<double>(fs::file_size(folder / history::kIndexFile)) / 1e6,
             static_cast<double>(runBytes) / 1e6);
  const Watch watch;
  history::Store(folder, history::Store::For::rebuilding).rebuild();
  fmt::print("rebuild: {:.1f} s\n", watch.seconds());
  return wrong == 0 ? 0 : 1;
}
