// Untrusted text made fit for where it is shown: names of files, scenes and materials come from whoever wrote them. One
// function a destination; markup (HTML, JUnit) has its own in base/text/text.h, annotations theirs in
// base/text/github_command.h.
#pragma once

#include <string>
#include <string_view>

namespace parity::base {

// One line, or a part of one, for a terminal or a CI server's log: clean UTF-8 without control characters (C0, DEL, C1)
// and without those that reorder text (bidirectional controls), each of which becomes U+FFFD; and without the marks of
// commands that Azure Pipelines and GitHub Actions take anywhere in a line, "##[" and "##vso[", whose second # becomes
// U+FFFD.
std::string plainLine(std::string_view text);

enum class Colors { none, ours }; // ours: the text was put together of plain lines and colours, ESC [ ... m, which stay

// All that is printed: lines as plainLine() makes them; tabs and ends of lines (LF, CR LF) are kept. Where a line would
// be a workflow command ("::stop-commands::..." behind white space, as GitHub Actions reads it), its second colon
// becomes U+FFFD.
std::string shownText(std::string_view text, Colors colors = Colors::none);

// JSON or TOML that is printed, whose strings know \uXXXX: what plainLine() would replace is written so, and is the
// same value to a reader.
std::string shownStrings(std::string_view text);

// A cell of a CSV file (RFC 4180, quoted where it has to be), on one line as plainLine() makes it. What a spreadsheet
// would take for a formula (= + - @ in front, full-width ones, too) gets ' in front, unless it is a number.
std::string csvCell(std::string_view text);

} // namespace parity::base
