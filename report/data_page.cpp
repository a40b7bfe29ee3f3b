#include "report/data_page.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "base/text/text.h"
#include "report/base64.h"
#include "report/dashboard_files.h"
#include "report/pixel_chunk.h"

namespace parity::report {
namespace {

// file: for browsers to which 'self' means nothing where the page is a file; to Chromium it is the page's own folder.
constexpr const char* kPolicyOfAFolder = "default-src 'none'; script-src 'self' file:; style-src 'self' file:; img-src "
                                         "'self' file: data: blob:; base-uri 'none'; form-action 'none'";

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
std::string policyOf(const DataPage& page) {
  if (!page.singleFile) return kPolicyOfAFolder;
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

constexpr const char* kEndBlock = "</script>\n";

void writeJsonBlock(const std::string& attribute, const std::string& value, std::string_view json,
                    const base::TextSink& sink) {
  sink(fmt::format("<script type=\"application/json\" {}=\"{}\">", attribute, base::escapeMarkup(value)));
  sink(escapeJson(json));
  sink(kEndBlock);
}

void writeFileBlock(const PageFile& file, const base::TextSink& sink) {
  const std::string name = base::escapeMarkup(file.file);
  if (file.file.ends_with(".js")) {
    sink(fmt::format("<script type=\"application/json\" data-file=\"{}\">", name));
    sink(chunkObject(file.bytes)); // base64 and safe names
  } else {
    sink(fmt::format("<script type=\"text/plain\" data-file=\"{}\">", name));
    sink(toBase64(file.bytes));
  }
  sink(kEndBlock);
}

std::string cssClass(std::string name) {
  std::ranges::replace(name, ' ', '-');
  return name;
}

} // namespace

void writeHtml(const DataPage& page, const base::TextSink& sink) {
  const std::string title = base::escapeMarkup(page.title), verdict = cssClass(page.verdict);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"{}\"/>\n<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"/>\n<meta name=\"referrer\" content=\"no-referrer\"/>\n<meta name=\"color-scheme\" "
      "content=\"light dark\"/>\n<title>{}: {}</title>\n<link rel=\"icon\" href=\"data:,\"/>\n",
      policyOf(page), base::escapeMarkup(page.tool), title);
  if (page.singleFile)
    html += fmt::format("<style>{}</style>\n", dashboardStyle().text);
  else
    html += "<link rel=\"stylesheet\" href=\"dashboard.css\"/>\n<script defer=\"\" src=\"dashboard.js\"></script>\n";
  html += fmt::format("</head>\n<body>\n<main id=\"app\">\n<header class=\"first {}\">\n", verdict);
  if (!page.verdict.empty())
    html += fmt::format("<p class=\"badge {}\">{}</p>\n", verdict, base::escapeMarkup(page.verdict));
  html += fmt::format("<h1>{}</h1>\n<p class=\"device\">{}</p>\n</header>\n<noscript>\n{}</noscript>\n</main>\n", title,
                      base::escapeMarkup(page.sub), page.plain);
  sink(html);
  for (const DataBlock& block : page.blocks) writeJsonBlock("id", block.id, block.json, sink);
  for (const MadeFile& file : page.made) writeJsonBlock("data-file", file.file, file.object(), sink);
  for (const PageFile& file : page.files) writeFileBlock(file, sink);
  if (page.singleFile) sink(fmt::format("<script>{}</script>\n", dashboardScript().text));
  sink("</body>\n</html>\n");
}

std::string toHtml(const DataPage& page) {
  std::string html;
  writeHtml(page, [&](std::string_view piece) { html += piece; });
  return html;
}

} // namespace parity::report
