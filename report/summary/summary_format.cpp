// A summary as Markdown of GitHub or GitLab, and as blocks of Slack.
#include <algorithm>

#include <fmt/format.h>

#include "base/text/json_writer.h"
#include "base/text/markdown.h"
#include "base/text/text.h"
#include "report/summary/summary.h"

namespace parity::report {
namespace {

constexpr std::size_t kMostColumns = 300; // of a text: a message of a library may be any length
constexpr int kThumbnail = 96;            // pixels

std::string cut(const std::string& text, std::size_t columns = kMostColumns) {
  const std::string line = base::plainLine(text);
  return base::displayWidth(line) <= columns ? line : base::fitColumns(line, columns);
}

std::string markdown(const std::string& text) { return base::markdownText(cut(text)); }

std::string andMore(std::size_t count) {
  return fmt::format("and {} more that {} milder", count, count == 1 ? "is" : "are");
}

std::string heading(const SummarySection& section) {
  return fmt::format("{} ({})", section.title, section.lines.size());
}

// A row of a table: pictures, if there are any, then the texts.
std::string markdownRow(const SummaryLine& line, const SummaryOptions& options) {
  std::string row = "|";
  if (!options.picturesUrl.empty()) {
    const std::string url = pictureUrl(options.picturesUrl, line.picture);
    row += url.empty()
               ? " |"
               : fmt::format(" <img src=\"{}\" width=\"{}\" alt=\"FLIP\"> |", base::escapeMarkup(url), kThumbnail);
  }
  return row + fmt::format(" {} | {} | {} | {} |\n", markdown(line.name), markdown(line.place), markdown(line.why),
                           markdown(line.note));
}

std::string toMarkdown(const Summary& summary, const SummaryOptions& options) {
  const std::string columns = options.picturesUrl.empty()
                                  ? "| what | where | why | who, when |\n|---|---|---|---|\n"
                                  : "| FLIP | what | where | why | who, when |\n|---|---|---|---|---|\n";
  std::string head =
      fmt::format("## {}: {}\n\n{}\n", markdown(summary.title), markdown(summary.verdict), markdown(summary.headline));
  if (!summary.changes.empty()) head += "\n" + markdown(summary.changes) + "\n";
  const auto open = [&](const SummarySection& section) {
    return fmt::format("\n### {}\n\n{}", markdown(heading(section)), columns);
  };
  const auto close = [](std::size_t more) { return more == 0 ? std::string() : "\n" + andMore(more) + "\n"; };
  std::size_t fixed = head.size();
  for (const SummarySection& section : summary.sections)
    fixed += open(section).size() + close(section.lines.size()).size();
  const std::vector<std::size_t> counts =
      fitLines(summary.sections, options.mostBytes > fixed ? options.mostBytes - fixed : 0,
               [&](const SummaryLine& line) { return markdownRow(line, options).size(); });
  std::string text = head;
  for (std::size_t i = 0; i < summary.sections.size(); ++i) {
    const SummarySection& section = summary.sections[i];
    text += open(section);
    for (std::size_t line = 0; line < counts[i]; ++line) text += markdownRow(section.lines[line], options);
    text += close(section.lines.size() - counts[i]);
  }
  return text;
}

std::string slackLine(const SummaryLine& line) {
  const auto part = [](const std::string& text) { return base::slackText(cut(text, 150)); };
  std::string text = "• " + part(line.name);
  if (!line.place.empty()) text += " (" + part(line.place) + ")";
  if (!line.why.empty()) text += ": " + part(line.why);
  if (!line.note.empty()) text += " [" + part(line.note) + "]";
  return text + "\n";
}

void writeText(base::JsonWriter& out, const char* type, const std::string& text) {
  out.beginObject();
  out.key("type").text(type);
  out.key("text").text(text);
  if (std::string_view(type) == "mrkdwn") out.key("verbatim").boolean(true);
  out.endObject();
}

void writeSection(base::JsonWriter& out, const std::string& text) {
  out.beginObject();
  out.key("type").text("section");
  writeText(out.key("text"), "mrkdwn", text);
  out.endObject();
}

void writePicture(base::JsonWriter& out, const SummaryLine& line, const std::string& url) {
  out.beginObject();
  out.key("type").text("image");
  out.key("image_url").text(url);
  out.key("alt_text").text(cut("FLIP of " + line.name, 150));
  out.endObject();
}

// Each section is a block, and the worst row of the first section with pictures has its picture.
std::string toSlack(const Summary& summary, const SummaryOptions& options) {
  constexpr std::size_t kMostHeader = 140;
  const std::string title = summary.title + ": " + summary.verdict;
  base::JsonWriter out;
  out.beginObject();
  out.key("text").text(base::slackText(cut(title + ": " + summary.headline)));
  out.key("blocks").beginArray();
  out.beginObject();
  out.key("type").text("header");
  writeText(out.key("text"), "plain_text", cut(title, kMostHeader));
  out.endObject();
  writeSection(out, base::slackText(cut(summary.headline)) +
                        (summary.changes.empty() ? "" : "\n" + base::slackText(cut(summary.changes))));
  bool hasPicture = false;
  for (const SummarySection& section : summary.sections) {
    std::string text = "*" + base::slackText(heading(section)) + "*\n";
    const std::size_t fixed = text.size() + andMore(section.lines.size()).size();
    const auto bytesOf = [](const SummaryLine& line) { return slackLine(line).size(); };
    const std::size_t count = fitLines(std::span(&section, 1), kMostSlackBlockBytes - fixed, bytesOf)[0];
    for (std::size_t i = 0; i < count; ++i) text += slackLine(section.lines[i]);
    if (count < section.lines.size()) text += andMore(section.lines.size() - count);
    writeSection(out, text);
    const std::string url = pictureUrl(options.picturesUrl, section.lines.front().picture);
    if (!hasPicture && !url.empty()) writePicture(out, section.lines.front(), url);
    hasPicture = hasPicture || !url.empty();
  }
  out.endArray();
  out.endObject();
  return out.finish();
}

} // namespace

std::string toSummary(const Summary& summary, SummaryFormat format, const SummaryOptions& options) {
  return format == SummaryFormat::slack ? toSlack(summary, options) : toMarkdown(summary, options);
}

} // namespace parity::report
