// What subcommands print: progress, timings, JSON to a file or stdout.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compare/report.h"
#include "job/settings.h"

namespace parity::cli {

// A bar on stderr where that is a terminal and nobody asked for quiet; else nothing. Erases itself at 1.
job::Progress makeProgress(bool quiet);

// Stage by stage, to stderr.
void printTimings(const std::vector<std::pair<std::string, double>>& timings);

// Writes text to stdout for "-", else to the file. Throws Error (exit 4).
void writeJson(const std::string& target, const std::string& text);

// The extension in lower case, with its dot: as base::writeImage chooses the format.
std::string extensionOf(const std::string& file);

bool stdoutIsTerminal();

// GitHub annotations of a report, where `annotate` is "github": to stdout, or to stderr where stdout is taken by JSON
// (GitHub reads either).
void printAnnotations(const std::string& annotate, const compare::Report& report, bool stdoutTaken);

} // namespace parity::cli
