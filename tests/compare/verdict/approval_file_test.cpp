// Files of approvals: what is read comes back when it is written, and every mistake is one clear line with its place.
#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "base/file.h"
#include "base/temp_folder.h"
#include "compare/verdict/approval.h"
#include "compare/verdict/budget.h"

namespace parity::compare {
namespace {

const std::string kEntry = R"toml([[accept]]
scene = "Hero"
view = "front"
material = "Chrome"
metric = "flip.mean"
value = 0.142
slack = 0.002
until = 2027-02-01
owner = "characters"
reason = "refit in sprint 12 (#481)"
inputs = "9f3c0a1b2c3d"
)toml";

Approvals readEntries(const std::string& text) { return readApprovals(text, "ci/approvals.toml"); }

// The entry with a line of its own in place of the one that sets the key.
std::string with(const std::string& key, const std::string& line) {
  const std::size_t at = kEntry.find("\n" + key + " = ") + 1, end = kEntry.find('\n', at);
  return kEntry.substr(0, at) + line + (line.empty() ? kEntry.substr(end + 1) : kEntry.substr(end));
}

void expectRefusedEntry(const std::string& text, const std::string& line, const std::string& reason) {
  base::expectError([&] { readEntries(text); }, "ci/approvals.toml: " + line, reason);
}

TEST(ApprovalFile, EntryIsReadAsItStands) {
  const Approvals approvals = readEntries("# ours\n\nnumerics = \"" + std::string(32, 'a') + "\"\n" + kEntry);
  EXPECT_EQ(approvals.head, "# ours\n");
  EXPECT_EQ(approvals.numerics, std::string(32, 'a'));
  ASSERT_EQ(approvals.entries.size(), 1u);
  const Approval& entry = approvals.entries[0];
  EXPECT_EQ(entry.scene + entry.view + entry.material + entry.metric, "HerofrontChromeflip.mean");
  EXPECT_EQ(entry.value, 0.142);
  EXPECT_EQ(entry.slack, 0.002);
  EXPECT_EQ(base::textOf(entry.until), "2027-02-01");
  EXPECT_EQ(entry.owner, "characters");
  EXPECT_EQ(entry.reason, "refit in sprint 12 (#481)");
  EXPECT_EQ(entry.inputs, "9f3c0a1b2c3d");
  EXPECT_EQ(originOf(approvals, entry), "approvals.toml, line 4");
  EXPECT_TRUE(readEntries("").entries.empty()) << "a project that has accepted nothing yet";
  EXPECT_EQ(readEntries(with("material", "whole = true")).entries[0].material, "");
  EXPECT_EQ(readEntries(with("slack", "")).entries[0].slack, 0);
}

TEST(ApprovalFile, IsWrittenSortedAndReadBackTheSame) {
  Approvals approvals = readEntries("# ours\n" + kEntry);
  Approval other = approvals.entries[0];
  for (const char* scene : {"Zebra", "Alpha"}) {
    other.scene = scene;
    other.reason = "quotes \" and \\ and\nlines";
    approvals.entries.push_back(other);
  }
  other.material.clear();
  approvals.entries.push_back(other);
  const std::string text = formatApprovals(approvals);
  const Approvals back = readEntries(text);
  EXPECT_TRUE(text.starts_with("# ours\n")) << text;
  ASSERT_EQ(back.entries.size(), 4u);
  EXPECT_EQ(back.entries[0].scene, "Alpha");
  EXPECT_EQ(back.entries[0].material, "") << "whole images first";
  EXPECT_EQ(back.entries[1].reason, other.reason);
  EXPECT_EQ(back.entries[3].scene, "Zebra");
  EXPECT_EQ(formatApprovals(back), text);
  EXPECT_NE(text.find("\n\n" + kEntry), std::string::npos) << text;
}

TEST(ApprovalFile, EveryMistakeIsNamedWithItsLine) {
  expectRefusedEntry(with("reason", "reasn = \"x\""), "line 10", "unknown key 'reasn'; did you mean 'reason'?");
  expectRefusedEntry("acept = 1\n", "line 1", "unknown key 'acept'");
  expectRefusedEntry(with("value", "value = \"0.142\""), "line 6", "'value' must be a number");
  expectRefusedEntry(with("value", "value = nan"), "line 6", "'value' is not a finite number");
  expectRefusedEntry(with("value", "value = 1.5"), "line 6", "outside the range 0..1 of flip.mean");
  expectRefusedEntry(with("value", "value = 0.999"), "line 6", "would accept whatever comes");
  expectRefusedEntry(with("slack", "slack = -0.1"), "line 7", "below 0");
  expectRefusedEntry(with("scene", "scene = 3"), "line 2", "'scene' must be a string");
  expectRefusedEntry(with("owner", "owner = \"\""), "line 9", "'owner' is empty");
  expectRefusedEntry(with("metric", "metric = \"flip.meen\""), "line 5", "unknown metric 'flip.meen'");
  expectRefusedEntry(with("until", "until = \"2027-02-01\""), "line 8",
                     "'until' must be a date, without quotes and time");
  expectRefusedEntry(with("until", "until = 2027-02-01T10:00:00"), "line 8", "'until' must be a date");
  expectRefusedEntry(with("until", "until = 2027-02-30"), "line 8", "");
  expectRefusedEntry(with("inputs", "inputs = \"9f3c\""), "line 11", "is not a digest of 12 hexadecimal digits");
  for (const char* key : {"scene", "view", "material", "metric", "value", "until", "owner", "reason", "inputs"})
    expectRefusedEntry(with(key, ""), "line 1", "the entry has no '" + std::string(key) + "'");
  expectRefusedEntry(with("view", "view = \"front\"\nwhole = true"), "line 4", "'whole' contradicts 'material'");
  expectRefusedEntry(with("material", "whole = false"), "line 4", "'whole' must be true");
  expectRefusedEntry("numerics = \"12\"\n" + kEntry, "line 1", "'numerics' is not 32 hexadecimal digits");
  expectRefusedEntry("accept = 1\n", "line 1", "'accept' must be an array of tables");
  expectRefusedEntry(kEntry + "\n" + kEntry, "line 13",
                     "the entry of line 1 is for the same figure (flip.mean of 'Chrome', Hero, front)");
}

TEST(ApprovalFile, ConflictOfAMergeIsCalledSo) {
  const std::string conflict = kEntry + "<<<<<<< HEAD\nx = 1\n||||||| base\n=======\nx = 2\n>>>>>>> branch\n";
  expectRefusedEntry(conflict, "line 12", "a merge conflict marker ('<<<<<<< HEAD'): resolve the conflict");
  base::expectError([&] { readBudgets(conflict, "b.toml"); }, "b.toml: line 12", "a merge conflict marker");
  EXPECT_NO_THROW(readEntries(with("reason", "reason = \"\"\"\n<<<<<<< not one\n\"\"\"")))
      << "a text that looks like it";
}

} // namespace
} // namespace parity::compare
