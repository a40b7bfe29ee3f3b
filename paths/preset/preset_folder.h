// The user's own formulas: a folder of preset.toml and preset.glsl (docs/presets.md).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/knob/table.h"
#include "gpu/device/pipeline.h"
#include "gpu/glsl/glsl_compiler.h"
#include "paths/preset/preset_function.h"

namespace parity::paths {

// Macros that tell the programs of a path apart: "PARITY_FP16", "PARITY_LOBES".
using ProgramMacros = std::vector<std::string>;

// A path's program without a folder.
struct BuiltInProgram {
  gpu::Spirv spirv, written; // for the driver; before its functions were inlined, as a folder's program is
};

// What a path offers to preset folders.
struct PresetHost {
  std::string path;                      // its name: "mobile"
  std::vector<std::string> bases;        // presets that a folder may start from; empty: it has none
  std::vector<base::Knob> knobs;         // that a folder may set
  std::vector<PresetFunction> functions; // that it may define
  std::vector<gpu::ShaderText>
      texts;        // of its shaders, and of folders to start from ("mobile/presets/NAME/preset.glsl")
  std::string root; // the one with main(): "mobile/shaders/mobile.glsl"
  std::vector<ProgramMacros> checked; // the programs that are compiled as soon as a folder is read
  std::vector<std::uint32_t> counted; // specialization constants by which every function is called
  ProgramMacros unfolded; // of the program whose knobs are data, so that none hides a loop; empty: there is none
  std::function<BuiltInProgram(const ProgramMacros&)> builtIn;
};

// Limits, so that a folder costs neither the machine nor its driver.
inline constexpr std::size_t kMaxPresetFileBytes = 256 << 10, kMaxPresetFiles = 64;
inline constexpr std::size_t kMaxPresetWords = 512 << 10;      // of a program's SPIR-V
inline constexpr std::size_t kMaxPresetArrayElements = 4096;   // of all arrays of the shader's own
inline constexpr std::uint64_t kMaxPresetOperations = 100'000; // of a pixel, loops counted as often as they turn

class PresetFolder {
public:
  struct File {
    std::string name, text; // in the folder
  };

  // "mypreset@0123456789ab": the folder's name and the hash of what it holds. It names the preset wherever settings are
  // written, so that its content is part of every key, and its place is not.
  const std::string& text() const { return m_text; }
  // "./mypreset@0123456789ab": by which it is read again, with this content or not at all.
  const std::string& reference() const { return m_reference; }
  const std::string& folder() const { return m_folder; }
  const std::string& path() const { return m_host.path; }
  const std::string& base() const { return m_base; }                        // the preset that it starts from
  const base::GivenKnobs& knobs() const { return m_knobs; }                 // that it sets
  const std::vector<std::string>& functions() const { return m_functions; } // that it defines
  bool defines(std::string_view function) const;

  // The path's shader with the folder's functions, compiled at the first call; it stays for the rest of the process.
  // Throws Error (failed) with file and line.
  gpu::Spirv program(const ProgramMacros& macros) const;

private:
  friend std::shared_ptr<const PresetFolder> readPresetFolder(const std::string&, const PresetHost&);
  PresetFolder(std::string folder, std::vector<File> files, const PresetHost& host);
  void readSettings(const std::string& text);
  void findFunctions();
  std::vector<File> compiledFiles() const; // preset.glsl, and what it includes
  void requireWithinLimits(const std::vector<std::uint32_t>& words, const ProgramMacros& macros) const;
  friend std::vector<std::uint32_t> compileProgram(const PresetHost&, const PresetFolder*, const ProgramMacros&,
                                                   const std::string&);

  std::string m_reference, m_text, m_folder, m_base;
  std::vector<File> m_files;
  const PresetHost& m_host;
  base::GivenKnobs m_knobs;
  std::vector<std::string> m_functions;
  mutable std::mutex m_mutex;
  mutable std::map<ProgramMacros, std::vector<std::uint32_t>> m_programs;
};

// The path's shader with those macros and the functions of a folder (null: none), then the text `last` of the path
// (empty: none); no limit is checked. Throws Error (failed).
std::vector<std::uint32_t> compileProgram(const PresetHost& host, const PresetFolder* folder,
                                          const ProgramMacros& macros, const std::string& last = {});

// The folder's program, or the path's own where there is no folder (null) or it only sets knobs.
gpu::Spirv programOf(const PresetHost& host, const PresetFolder* folder, const ProgramMacros& macros);

// Sets the folder's knobs. Throws Error (failed) with the line of preset.toml.
template <typename T> void applyKnobs(const base::KnobTable<T>& table, T& options, const PresetFolder& folder) {
  try {
    table.apply(options, folder.knobs());
  } catch (const base::Error& error) {
    throw base::fileError(error.subject(), error.place(), error.reason());
  }
}

// Whether a value names a folder, not a built-in preset: it holds a '/'.
bool namesPresetFolder(const std::string& text);
// The path that the folder's preset.toml is for. Throws Error (failed).
std::string pathOfPresetFolder(const std::string& text);

// Reads the folder and compiles host.checked. text: a folder, or a reference(): then its content must be the same.
// A folder is read once in a process: what changes later does not change a run. host must outlive the process's use of
// it. Throws Error (failed) with file, line and reason.
std::shared_ptr<const PresetFolder> readPresetFolder(const std::string& text, const PresetHost& host);
// The folders of a path that this process has read.
std::vector<std::shared_ptr<const PresetFolder>> readPresetFolders(const std::string& path);
// The next readPresetFolder reads all again.
void forgetPresetFolders();

} // namespace parity::paths
