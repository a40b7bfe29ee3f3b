#include "base/module_file.h"

#include <algorithm>

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/error.h"

namespace parity::base {

namespace fs = std::filesystem;

std::vector<fs::path> moduleCandidates(const std::string& file) {
  std::error_code error;
  std::vector<fs::path> folders;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", error); !error) {
    folders.push_back(program.parent_path());
    folders.push_back(program.parent_path().parent_path() / "lib" / "parity");
  }
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&moduleCandidates), &info) && info.dli_fname)
    folders.insert(folders.begin() + (folders.empty() ? 0 : 1), fs::absolute(info.dli_fname, error).parent_path());
  std::vector<fs::path> files;
  for (const fs::path& folder : folders)
    if (const fs::path candidate = folder / file; std::find(files.begin(), files.end(), candidate) == files.end())
      files.push_back(candidate);
  return files;
}

void* moduleFunction(const std::string& file, const char* function, const std::string& needs, const std::string& use) {
  std::error_code error;
  std::string searched;
  for (const fs::path& candidate : moduleCandidates(file)) {
    searched += (searched.empty() ? "" : ", ") + candidate.string();
    if (!fs::exists(candidate, error)) continue;
    // Lazy: most of the functions of its many libraries are never called.
    void* handle = dlopen(candidate.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
    if (!handle)
      throw Error(ExitCode::failed, candidate.string(), "cannot be loaded", fmt::format("{} ({})", dlerror(), needs));
    if (void* found = dlsym(handle, function)) return found;
    throw Error(ExitCode::failed, candidate.string(), "",
                "belongs to another build of this program; build or install both together");
  }
  const std::string target = file.substr(0, file.find('.'));
  throw Error(
      ExitCode::failed, file, "not found",
      fmt::format("{}; build the target {}, or install it next to the program (searched: {})", use, target, searched));
}

} // namespace parity::base
