// The completion of each shell, tried in that shell; and the manual pages, read by groff. Skipped, visibly, where the
// shell is not installed.
#include <algorithm>
#include <array>
#include <cstdio>

#include "cli/checks.h"

namespace parity::tests {
namespace {

struct Ran {
  int status = 0;
  std::string out;
};

// By sh, stderr too.
Ran run(const std::string& command) {
  Ran ran;
  FILE* pipe = popen(("{ " + command + "\n} 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("no shell");
  std::array<char, 4096> part{};
  for (std::size_t count; (count = fread(part.data(), 1, part.size(), pipe)) > 0;) ran.out.append(part.data(), count);
  ran.status = pclose(pipe);
  return ran;
}

bool isInstalled(const std::string& program) { return run("command -v " + program).status == 0; }

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

class CompletionTest : public FolderTest {
protected:
  void SetUp() override {
    for (const char* file : {"a.glb", "b.gltf", "notes.txt", "sky.hdr", "two words.glb"}) write(file, "x");
    std::filesystem::create_directory(m_folder / "deep");
  }
  void useShell(const std::string& shell) {
    if (!isInstalled(shell)) GTEST_SKIP() << shell << " is not installed";
    const RunResult script = runParity({"completion", shell});
    ASSERT_TRUE(exitedWith(0, script));
    write("script", script.out);
    const Ran check = run(shell + " -n " + quoted(path("script")));
    EXPECT_EQ(check.status, 0) << check.out;
  }
  // What the last word of the line may become, sorted; `words` as bash has them in COMP_WORDS.
  std::vector<std::string> bash(const std::vector<std::string>& words) const {
    std::string list;
    for (const std::string& word : words) list += " " + quoted(word);
    const std::string script = "cd " + quoted(m_folder.path().string()) + "; . ./script; COMP_WORDS=(" + list +
                               "); COMP_CWORD=" + std::to_string(words.size() - 1) +
                               "; _parity; printf '%s\\n' \"${COMPREPLY[@]}\"";
    return sorted(run("bash --norc -c " + quoted(script)).out);
  }
  static std::vector<std::string> sorted(const std::string& text) {
    std::vector<std::string> lines = linesOf(text);
    std::erase(lines, "");
    std::ranges::sort(lines);
    return lines;
  }
};

using Words = std::vector<std::string>;

TEST_F(CompletionTest, OfBashKnowsCommandsOptionsValuesScenesAndFiles) {
  useShell("bash");
  if (IsSkipped()) return;
  EXPECT_EQ(bash({"parity", "re"}), (Words{"render", "report"}));
  EXPECT_EQ(bash({"parity", "budget", ""}), (Words{"check", "suggest"}));
  EXPECT_EQ(bash({"parity", "budget", "suggest", "--mar"}), Words{"--margin"});
  EXPECT_EQ(bash({"parity", "diff", "a.glb", "--mobile-prese"}), Words{"--mobile-preset"});
  EXPECT_EQ(bash({"parity", "diff", "--mobile-preset", "ref"}), Words{"refit"});
  EXPECT_EQ(bash({"parity", "diff", "--mobile-preset", "=", "ref"}), Words{"refit"}) << "bash breaks words at =";
  EXPECT_EQ(bash({"parity", "diff", "builtin", ":", "sph"}), Words{"spheres"}) << "and at :";
  EXPECT_EQ(bash({"parity", "diff", "--env", "builtin", ":", "sk"}), Words{"sky"});
  EXPECT_EQ(bash({"parity", "diff", "--env", ""}),
            (Words{"builtin:night", "builtin:sky", "builtin:studio", "builtin:white", "deep", "sky.hdr"}));
  EXPECT_EQ(bash({"parity", "report", "--material", "x", "a"}), Words{"a.glb"}) << "x is the option's value";
  EXPECT_EQ(bash({"parity", "report", "tw"}), Words{"two words.glb"});
  EXPECT_EQ(bash({"parity", "report", "b"}).back(), "builtin:spheres");
  EXPECT_EQ(bash({"parity", "report", "-o", ""}), Words{"deep"}) << "a folder";
  EXPECT_EQ(bash({"parity", "report", "--budgets", "n"}), Words{"notes.txt"}) << "any file";
  EXPECT_EQ(bash({"parity", "report", "--size", ""}), Words()) << "nothing that is known";
  EXPECT_EQ(bash({"parity", "completion", ""}), (Words{"bash", "fish", "zsh"}));
  EXPECT_TRUE(std::ranges::count(bash({"parity", "help", ""}), "bench") == 1);
}

TEST_F(CompletionTest, OfFishKnowsTheSame) {
  useShell("fish");
  if (IsSkipped()) return;
  const auto fish = [&](const std::string& line) {
    const std::string script =
        "cd " + quoted(m_folder.path().string()) + "; source script; complete -C " + quoted(line);
    std::string names; // without the descriptions behind a tab
    for (const std::string& each :
         linesOf(run("HOME=" + quoted(m_folder.path().string()) + " fish -N -c " + quoted(script)).out))
      names += each.substr(0, each.find('\t')) + "\n";
    return sorted(names);
  };
  EXPECT_EQ(fish("parity re"), (Words{"render", "report"}));
  EXPECT_EQ(fish("parity budget "), (Words{"check", "suggest"}));
  EXPECT_EQ(fish("parity budget suggest --mar"), Words{"--margin"});
  EXPECT_EQ(fish("parity diff --mobile-preset ref"), Words{"refit"});
  EXPECT_EQ(fish("parity diff builtin:sph"), Words{"builtin:spheres"});
  EXPECT_EQ(fish("parity diff --env builtin:sk"), Words{"builtin:sky"});
  EXPECT_EQ(fish("parity completion "), (Words{"bash", "fish", "zsh"}));
  EXPECT_EQ(fish("parity report -o d"), Words{"deep/"});
  EXPECT_EQ(std::ranges::count(fish("parity report "), "a.glb"), 1);
}

// zsh completes in a line editor alone: its functions are stood in for by such that print what they are told.
TEST_F(CompletionTest, OfZshKnowsTheSame) {
  useShell("zsh");
  if (IsSkipped()) return;
  const auto zsh = [&](const Words& words) {
    std::string list;
    for (const std::string& word : words) list += " " + quoted(word);
    const std::string script =
        "cd " + quoted(m_folder.path().string()) +
        "; compdef() { :; }; compset() { PREFIX=${PREFIX#*=}; }; _files() { print -r -- FILES \"$@\"; }; "
        "_describe() { local -a all=(\"${(@P)@[-1]}\"); print -rl -- ${${(M)all:#$PREFIX*}%%:*}; }; "
        "compadd() { local -a all=(\"${(@P)2}\"); print -rl -- ${(M)all:#$PREFIX*}; }; . ./script; words=(" +
        list + "); CURRENT=$#words; PREFIX=$words[-1]; _parity";
    return sorted(run("zsh -f -c " + quoted(script)).out);
  };
  EXPECT_EQ(zsh({"parity", "re"}), (Words{"render", "report"}));
  EXPECT_EQ(zsh({"parity", "budget", ""}), (Words{"check", "suggest"}));
  EXPECT_EQ(zsh({"parity", "budget", "suggest", "--mar"}), Words{"--margin"});
  EXPECT_EQ(zsh({"parity", "diff", "--mobile-preset", "ref"}), Words{"refit"});
  EXPECT_EQ(zsh({"parity", "diff", "--mobile-preset=ref"}), Words{"refit"});
  EXPECT_EQ(zsh({"parity", "diff", "builtin:sph"}), (Words{"FILES -g *.(#i)(gltf|glb)", "builtin:spheres"}));
  EXPECT_EQ(zsh({"parity", "diff", "--env", "builtin:sk"}), (Words{"FILES -g *.(#i)(hdr|exr|pfm)", "builtin:sky"}));
  EXPECT_EQ(zsh({"parity", "report", "-o", ""}), Words{"FILES -/"});
  EXPECT_EQ(zsh({"parity", "completion", ""}), (Words{"bash", "fish", "zsh"}));
}

class ManTest : public FolderTest {};

TEST_F(ManTest, PagesAreThoseOfAllCommandsAndHoldTheirOptions) {
  const std::filesystem::path folder = m_folder / "man1";
  EXPECT_TRUE(exitedWith(0, runParity({"man", "-o", folder.string()})));
  const std::vector<std::string> files = listFiles(folder);
  EXPECT_GT(files.size(), 15u);
  for (const char* file : {"parity.1", "parity-report.1", "parity-budget.1", "parity-cache.1"})
    EXPECT_EQ(std::ranges::count(files, file), 1) << file;
  EXPECT_EQ(readWholeFile(folder / "parity-report.1"), runParity({"man", "report"}).out);
  const std::string page = readWholeFile(folder / "parity-report.1");
  for (const char* part : {"\\-\\-mobile\\-preset", "\\-\\-exposure", ".SH EXAMPLES", ".SH EXIT STATUS"})
    EXPECT_TRUE(contains(page, part)) << part;
  EXPECT_TRUE(contains(readWholeFile(folder / "parity-budget.1"), "\\-\\-margin"));
}

TEST_F(ManTest, PagesAreGoodRoff) {
  if (!isInstalled("groff")) GTEST_SKIP() << "groff is not installed";
  EXPECT_TRUE(exitedWith(0, runParity({"man", "-o", m_folder.path().string()})));
  for (const std::string& file : listFiles(m_folder.path())) {
    const Ran warnings = run("groff -man -ww -z -Kutf8 -Tutf8 " + quoted(path(file)));
    EXPECT_EQ(warnings.out, "") << file;
  }
  const Ran shown = run("groff -man -Tascii -P-cbou " + quoted(path("parity-flip.1")));
  for (const char* part : {"--metric flip.mean --fail 0.05", "EXIT STATUS", "over a limit"})
    EXPECT_TRUE(contains(shown.out, part)) << part << " in:\n" << shown.out;
}

} // namespace
} // namespace parity::tests
