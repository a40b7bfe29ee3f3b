#include <algorithm>
#include <charconv>
#include <vector>

#include <fmt/format.h>

#include "compare/base64.h"
#include "compare/dashboard_files.h"
#include "compare/pixel_chunk.h"
#include "compare/report_page.h"
#include "compare/text.h"
#include "compare/wording.h"

namespace parity::compare {
namespace {

// file: for browsers to which 'self' means nothing where the page is a file; to Chromium it is the page's own folder.
constexpr const char* kPolicyOfAFolder = "default-src 'none'; script-src 'self' file:; style-src 'self' file:; img-src "
                                         "'self' file: data: blob:; base-uri 'none'; form-action 'none'";
constexpr std::size_t kMostRows = 50;

// Of a file of the dashboard, as a policy names it.
std::string hashSource(const DashboardFile& file) {
  std::vector<std::byte> digest;
  for (std::size_t i = 0; i + 1 < file.sha256.size(); i += 2) {
    unsigned byte = 0;
    std::from_chars(&file.sha256[i], &file.sha256[i] + 2, byte, 16);
    digest.push_back(static_cast<std::byte>(byte));
  }
  return "'sha256-" + toBase64(digest) + "'";
}

// Hashes and not a nonce: what else may get into the page is not run, whatever it says of itself.
std::string policyOf(const PageRequest& request) {
  if (!request.singleFile) return kPolicyOfAFolder;
  return fmt::format("default-src 'none'; script-src {}; style-src {}; img-src data: blob:; base-uri 'none'; "
                     "form-action 'none'",
                     hashSource(dashboardScript()), hashSource(dashboardStyle()));
}

// JSON that cannot end the element that it stands in, nor begin another.
std::string escapeJson(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '<' || c == '>' || c == '&') {
      out += c == '<' ? "\\u003c" : c == '>' ? "\\u003e" : "\\u0026";
    } else if (c == '\xe2' && json.substr(i + 1, 1) == "\x80" &&
               (json.substr(i + 2, 1) == "\xa8" || json.substr(i + 2, 1) == "\xa9")) {
      out += json[i + 2] == '\xa8' ? "\\u2028" : "\\u2029"; // line ends to old JavaScript
      i += 2;
    } else {
      out += c;
    }
  }
  return out;
}

std::string dataBlock(const char* id, std::string_view json) {
  return fmt::format("<script type=\"application/json\" id=\"{}\">{}</script>\n", id, escapeJson(json));
}

std::string fileBlock(const PageFile& file) {
  const std::string name = escapeMarkup(file.file);
  if (file.file.ends_with(".js"))
    return fmt::format("<script type=\"application/json\" data-file=\"{}\">{}</script>\n", name,
                       chunkObject(file.bytes)); // base64 and safe names
  return fmt::format("<script type=\"text/plain\" data-file=\"{}\">{}</script>\n", name, toBase64(file.bytes));
}

std::string cssClass(Verdict verdict) {
  std::string name = nameOf(verdict);
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string tableRow(Verdict verdict, const SceneResult& scene, std::string_view view, std::string_view material,
                     std::string_view reason) {
  return fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", nameOf(verdict),
                     escapeMarkup(scene.name), escapeMarkup(view), escapeMarkup(material), escapeMarkup(reason));
}

// What failed or could not be judged, in the order of the report.
std::vector<std::string> rowsOverBudget(const Report& report) {
  std::vector<std::string> rows;
  for (const SceneResult& scene : report.scenes) {
    if (!scene.error.empty()) rows.push_back(tableRow(Verdict::error, scene, "", "", scene.error));
    for (const ViewResult& view : scene.views) {
      if (view.wholeVerdict >= Verdict::fail)
        rows.push_back(tableRow(view.wholeVerdict, scene, view.name, "whole image", view.reason));
      for (const MaterialResult& material : view.materials)
        if (material.verdict >= Verdict::fail)
          rows.push_back(tableRow(material.verdict, scene, view.name, material.name, material.reason));
    }
  }
  return rows;
}

// For readers without scripts.
std::string plainPage(const Report& report) {
  std::string html = "<noscript>\n<p>This page needs JavaScript; all of its data is in report.json.</p>\n";
  if (report.baseline && !report.baseline->error.empty())
    html += fmt::format("<p>{}</p>\n", escapeMarkup(report.baseline->error));
  if (const std::vector<std::string> rows = rowsOverBudget(report); !rows.empty()) {
    html += "<table>\n<thead><tr><th>verdict</th><th>scene</th><th>view</th><th>material</th><th>why</th></tr></thead>"
            "\n<tbody>\n";
    for (std::size_t i = 0; i < std::min(rows.size(), kMostRows); ++i) html += rows[i];
    html += "</tbody>\n</table>\n";
    if (rows.size() > kMostRows) html += fmt::format("<p>and {} more</p>\n", rows.size() - kMostRows);
  }
  return html + "</noscript>\n";
}

} // namespace

std::string toHtml(const Report& report, const RunInfo& run, const PageRequest& request) {
  const std::string title = escapeMarkup(headline(report));
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"{}\"/>\n<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"/>\n<meta name=\"referrer\" content=\"no-referrer\"/>\n<meta name=\"color-scheme\" "
      "content=\"light dark\"/>\n<title>{}: {}</title>\n<link rel=\"icon\" href=\"data:,\"/>\n",
      policyOf(request), escapeMarkup(report.tool), title);
  if (request.singleFile)
    html += fmt::format("<style>{}</style>\n", dashboardStyle().text);
  else
    html += "<link rel=\"stylesheet\" href=\"dashboard.css\"/>\n<script defer=\"\" src=\"dashboard.js\"></script>\n";
  html += fmt::format(
      "</head>\n<body>\n<main id=\"app\">\n<header class=\"first {0}\">\n<p class=\"badge {0}\">{1}</p>\n"
      "<h1>{2}</h1>\n<p class=\"device\">{3}</p>\n</header>\n{4}</main>\n",
      cssClass(report.verdict), nameOf(report.verdict), title, escapeMarkup(report.device), plainPage(report));
  html += dataBlock("report", toJson(report, JsonLayout::compact));
  html += dataBlock("run", toJson(run, JsonLayout::compact));
  if (!request.bench.empty()) html += dataBlock("bench", request.bench);
  for (const PageFile& file : request.files) html += fileBlock(file);
  if (request.singleFile) html += fmt::format("<script>{}</script>\n", dashboardScript().text);
  return html + "</body>\n</html>\n";
}

} // namespace parity::compare
