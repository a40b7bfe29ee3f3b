// A report as a page of Markdown or a message: what is new, what still fails and since when, what is fixed.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "report/report.h"
#include "report/standing.h"

namespace parity::report {

// One line of a section. All texts are as the report has them: the writers escape them.
struct SummaryLine {
  std::string name, place; // the material and where it is; place: empty where the name says all
  std::string why;         // may be empty
  std::string note;        // nights, owner, days left; may be empty
  std::string picture;     // relative to the report's folder; empty: none
};

struct SummarySection {
  std::string title;
  std::vector<SummaryLine> lines; // the gravest first
};

struct Summary {
  std::string title; // "parity: nightly"
  std::string verdict, headline;
  std::string changes; // "3 new failures, 12 still failing, 2 fixed"; empty: nothing is known of before
  std::vector<SummarySection> sections; // the most important first; none is empty
};

// find: empty: standingOf (report/standing.h).
Summary summarize(const Report& report, const RunInfo& run, const FindStanding& find = {});

enum class SummaryFormat { github, gitlab, slack };
inline constexpr const char* kSummaryFormats[] = {"github", "gitlab", "slack"};

// What the sites take, with room for what a script adds. GitHub takes 1 MiB a step; 65,536 characters a comment; Slack
// 3,000 a block and 50 blocks.
inline constexpr std::size_t kMostStepSummaryBytes = std::size_t{900} << 10, kMostCommentBytes = 60000,
                             kMostSlackBlockBytes = 2900;

struct SummaryOptions {
  std::size_t mostBytes = kMostCommentBytes; // of Markdown
  std::string picturesUrl;                   // of the report's folder, with http:// or https://; empty: no pictures
};

// What does not fit is left out, the mildest lines of each section first, and counted. Slack: JSON with "text" and
// "blocks", as an incoming webhook takes it.
std::string toSummary(const Summary& summary, SummaryFormat format, const SummaryOptions& options);

// How many of the sections' lines fit into so many bytes: a few of each, then the rest in the order of the sections.
// bytesOf: of a line as it is written.
std::vector<std::size_t> fitLines(std::span<const SummarySection> sections, std::size_t bytes,
                                  const std::function<std::size_t(const SummaryLine&)>& bytesOf);

// The picture below that address, with its path percent-encoded; empty where there is none of either.
std::string pictureUrl(const std::string& picturesUrl, const std::string& picture);

} // namespace parity::report
