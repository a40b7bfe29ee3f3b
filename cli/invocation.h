// The command line as plain data: what each subcommand is asked to do.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "job/settings.h"
#include "scenes/suite.h"

namespace parity::cli {

struct CommonOptions {
  job::Settings settings;
  std::string environment;
  float environmentRotationDeg = 0;
  std::optional<scenes::SunRequest> sun;
  scenes::ViewRequest view;
  int threads = 0;
  std::string json; // file, "-" for stdout, "" for none
  bool timings = false, quiet = false;
};

struct ReportCommand {
  CommonOptions common;
  std::vector<std::string> scenes;
  std::string suite, folder;
  bool warnExit = false;
};

struct DiffCommand {
  CommonOptions common;
  std::string scene;
  bool warnExit = false;
};

struct RenderCommand {
  CommonOptions common;
  std::string scene, path, output;
};

struct FlipCommand {
  std::string reference, test, output, json;
  float ppd = 0; // 0: the default
};

struct DevicesCommand {
  gpu::DeviceOptions device;
  std::string json;
};

using Invocation = std::variant<ReportCommand, DiffCommand, RenderCommand, FlipCommand, DevicesCommand>;

// What parsing led to: a command to run, or text that was asked for or is due (help, version, a usage error) with its
// exit code.
struct Parsed {
  std::optional<Invocation> command;
  std::string text;
  int exitCode = 0;
};

// Never throws for user input: a usage error is text and exit code 64.
Parsed parseCommandLine(int argc, const char* const* argv);

// The subcommands. Each returns its exit code and throws base::Error for what it could not do.
int runReportCommand(const ReportCommand& command, const std::string& commandLine);
int runDiffCommand(const DiffCommand& command, const std::string& commandLine);
int runRenderCommand(const RenderCommand& command);
int runFlipCommand(const FlipCommand& command);
int runDevicesCommand(const DevicesCommand& command);

} // namespace parity::cli
