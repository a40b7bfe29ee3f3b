#include "cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "base/terminal.h"
#include "base/text/text.h"

namespace parity::cli {

namespace {

constexpr std::size_t kBarColumns = 24, kNarrow = 72; // below the latter the bar is half as wide

// "0:07", "12:40", "1:02:03".
std::string clockText(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::clamp(seconds, 0.0, 359'999.0)));
  const long long hours = whole / 3600, minutes = whole / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

// What is left, at the pace so far: nothing that is said before a pace is known.
std::string remaining(double done, double elapsedS) {
  constexpr double kLeastS = 2, kLeastDone = 0.02;
  if (elapsedS < kLeastS || done < kLeastDone || done >= 1) return {};
  return fmt::format(", about {} left", clockText(elapsedS * (1 - done) / done));
}

} // namespace

std::string describeProgress(const std::string& what, double done, double elapsedS, std::size_t columns) {
  const std::size_t width = columns < kNarrow ? kBarColumns / 2 : kBarColumns;
  const double share = std::clamp(done, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(std::llround(share * static_cast<double>(width)));
  std::string line;
  for (std::size_t i = 0; i < width; ++i) line += i < filled ? "█" : "░";
  line += fmt::format(" {:3.0f} % {}{}  {}", share * 100, clockText(elapsedS), remaining(share, elapsedS),
                      base::plainLine(what));
  return base::displayWidth(line) <= columns ? line : base::fitColumns(line, std::max<std::size_t>(columns, 1));
}

job::Progress makeProgress(bool quiet) {
  const base::TerminalFacts facts = base::readTerminal(STDERR_FILENO);
  if (quiet || !base::canRedraw(facts)) return {};
  return [start = std::chrono::steady_clock::now()](const std::string& what, double done) {
    const base::TerminalFacts now = base::readTerminal(STDERR_FILENO); // a window that grows
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const std::string wipe = base::wipeLine(now);
    // The last column stays free: some terminals wrap there.
    const std::string line = done >= 1 ? wipe : wipe + describeProgress(what, done, elapsed.count(), now.columns - 1);
    std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
  };
}

job::Progress progressOfScene(const job::Progress& whole, std::size_t index, std::size_t count) {
  if (!whole || count < 2) return whole;
  return [&whole, index, count](const std::string& what, double done) {
    whole(fmt::format("{} of {} done, {}", index, count, what),
          (static_cast<double>(index) + done) / static_cast<double>(count));
  };
}

} // namespace parity::cli
