// Untrusted text for Markdown and for Slack: names of materials that neither form, nor link, nor call anyone.
#pragma once

#include <string>
#include <string_view>

namespace parity::base {

// For a line of GitHub's or GitLab's Markdown, also in a cell of a table: a plain line (base/text/shown_text.h), ASCII
// punctuation that means something there as a character reference, and U+200B behind what would begin a mention, a
// reference, an emoji or a link ("@all", "#1", "!2", ":tada:", "https://"), because both look for these in the text
// that a reader sees.
std::string markdownText(std::string_view text);

// For Slack's mrkdwn with `verbatim`: a plain line, & < > as Slack wants them, which takes "<!channel>" and links their
// meaning, and U+200B at what would form, call or become an emoji ("*", "_", "~", "`", "@", "#", ":").
std::string slackText(std::string_view text);

} // namespace parity::base
