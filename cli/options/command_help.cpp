// A table of texts, read from top to bottom, and how CLI11 is to show them.
#include "cli/options/command_help.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/app_description.h"
#include "cli/options/option_parts.h"
#include "scenes/builtin/builtin.h"

namespace parity::cli {

namespace {

constexpr const char* kIntro = R"(parity: does a material look the same on two shading paths?

Renders a glTF scene by a high-end path (full GGX, tabulated environment BRDF, all lights) and by a mobile path (Karis 2014, UE4's
base pass), compares them per material by FLIP, and judges them against budgets.
)";

constexpr const char* kFlipNotes =
    R"(Pictures in two folders are matched by relative path, or by stem if only one file has it. A picture without counterpart fails
(exit 4); the others still run. Other files are skipped with a warning. Each line of a list has two paths, relative to the list's
folder; put "..." around a path with spaces, and # before a comment.

Colour: integers are sRGB and floats are linear Rec.709, unless the file or --colorspace says otherwise. A pair is HDR if both files
hold floats and any value is above 1; then hdrflip replaces flip. Grey is copied to R, G and B. Both files need the same channels.
Files are not comparable if they differ in layers, further images, orientation, or the position of the pixels in a larger picture;
--ignore-layers compares only the colour and alpha of the first image.
Alpha: both are composited over --background, always in linear Rec.709: C + (1-a) B if the colour is multiplied by alpha
(OpenEXR, some TIFF), a C + (1-a) B if not (PNG). With --alpha channel, colour is compared as stored, and alpha as a separate
grey picture.

A limit belongs to the --metric before it. Without --metric it belongs to FLIP, pixel by pixel.
  --metric flip.mean --fail 0.05             a pooled figure: fails above 0.05 (psnr, ssim...: below; bias: absolute value)
  --metric flip --fail 0.2 --failpercent 1   pixel by pixel, as idiff: fails if more than 1 % of the pixels are over 0.2
  --metric maxabs --fail 0.01 --failpercent 1  the same with the largest difference of R, G, B, as in idiff
  --metric flip --hardfail 0.9               fails if any pixel is over 0.9
  --fail 0.2                                 the same as --metric flip --fail 0.2 --failpercent 0
--warn, --warnpercent and --hardwarn warn in the same way. Every region must hold all limits. A limit that no value can exceed is
an error. Budgets: [[whole]] rules judge a pair without a mask; [[material]] rules judge each region of a mask. Without limits
nothing is judged: any two finite pictures of the same size exit with 0. Pixels that are NaN or infinite never pass.)";

constexpr ExitCodeText kDone = {0, "done"}, kFailed = {4, "a file is missing or damaged, or a step failed"},
                       kUsage = {64, "wrong usage"}, kWithin = {0, "within budget"},
                       kWarned = {1, "warnings only (with --warn-exit)"}, kOver = {2, "over budget"},
                       kNotComparable = {3, "not comparable: sizes, channels, or a metric that does not apply"},
                       kStopped =
                           {130, "interrupted by SIGINT (SIGHUP: 129, SIGTERM: 143); the result has what was finished"},
                       kNoResult = {4, "a scene failed, a figure is not finite, or no material was compared"},
                       kWriting = {75, "another process writes the history: try again"};

const std::vector<CommandHelp>& table() {
  static const std::vector<CommandHelp> kTable = {
      {"",
       "",
       {{"parity report scene.glb --env studio.hdr --sun 30,50,4 -o out", "report with pictures: out/index.html"},
        {"parity diff scene.glb --env studio.hdr", "table with one row for each material"},
        {"parity flip reference.png test.png -o map.exr", "compare any two images"},
        {"parity budget suggest out/report.json -o budgets.toml", "suggest limits from observed figures"},
        {"parity help report", "the options of a command"}},
       {{0, "within budget, done"},
        kWarned,
        kOver,
        {3, "not comparable"},
        {4, "a file is missing or not finite, or a step failed"},
        kUsage}},
      {"report",
       "If a scene fails, the others still run. The highest exit code wins. A scene is a .gltf or .glb file, or "
       "builtin:NAME;\n- reads more of them from standard input, one a line.",
       {{"parity report scene.glb", "writes parity-report/index.html"},
        {"parity report a.glb b.glb --env studio.hdr --env builtin:sky -o out", "each scene in each environment"},
        {"parity report --suite nightly.toml --budgets budgets.toml --annotate github", "in CI"},
        {"parity report scene.glb --material 'metal*' --csv figures.csv", "some materials, also as a table"},
        {"parity report - --baseline main/report.json", "scenes from standard input, against an earlier report"}},
       {kWithin, kWarned, kOver, kNotComparable, kNoResult, kUsage, kStopped}},
      {"plan",
       "The folder must be one that every machine reaches. Each shard is one `parity work FOLDER --shard N`; then\n"
       "`parity merge FOLDER -o OUT` writes the report that `parity report` would have written, byte for byte.",
       {{"parity plan --suite nightly.toml --shards 64 -o night", "night/plan.json"}},
       {kDone, kFailed, kUsage}},
      {"work",
       "What is done is not done again. A worker process that crashes, takes too long or takes too much memory costs "
       "one\n"
       "scene: it is tried once more alone, and then it is an error of the report.",
       {{"parity work night --shard 7 --jobs 4", "a shard, in four worker processes"},
        {"parity work night --shard auto", "the shard that the scheduler says"},
        {"parity work night --missing", "prints 3,7,12: for sbatch --array"}},
       {{0, "all scenes of the shard are done, whatever their verdicts"},
        kFailed,
        kUsage,
        {75, "not all scenes are done: try again"},
        {78, "the plan is of another build, or of a machine that rounds otherwise"}}},
      {"merge",
       "",
       {{"parity merge night -o out", "out/index.html"},
        {"parity merge night -o out --incomplete report", "scenes without a result are errors of the report"}},
       {kWithin,
        kWarned,
        kOver,
        kNotComparable,
        {4, "a scene failed or has no result, or a figure is not finite"},
        kUsage,
        {75, "another merge of the plan runs"},
        {78, "the plan or a result is of another build, plan or machine"}}},
      {"diff",
       "",
       {{"parity diff scene.glb --env studio.hdr --sun 30,50,4", "a table"},
        {"parity diff scene.glb --material gold --truth", "one material, both paths against the ground truth"},
        {"parity diff scene.glb --csv - -q", "figures for a spreadsheet"}},
       {kWithin, kWarned, kOver, kNotComparable, kNoResult, kUsage, kStopped}},
      {"render",
       "",
       {{"parity render scene.glb --path truth -o truth.png", "the picture as displayed"},
        {"parity render scene.glb --path truth --terms -o terms.exr", "all terms of light as layers"},
        {"parity render --list-terms", "what --term takes"}},
       {kDone, kFailed, kUsage}},
      {"contract",
       "contract.json holds matrices, light and what the pictures must be like; beside it lie environments, built-in\n"
       "scenes as .glb, our own pictures and which pixel shows which material.",
       {{"parity contract scene.glb --env studio.hdr -o contract", "for an adapter, such as integrations/threejs"}},
       {kDone, kFailed, kUsage}},
      {"calibrate",
       "Where its pixels lie, its tone curve, how wide its filter is, how its environment is turned.",
       {{"parity calibrate shots", "shots/calibration.png"}},
       {kDone, {3, "the picture does not show the calibration scene"}, kFailed, kUsage}},
      {"flip",
       kFlipNotes,
       {{"parity flip reference.png test.png -o map.png", "two images, and a map of their difference"},
        {"parity flip old new --metric flip.mean --fail 0.05 --junit flip.xml", "two folders, judged"},
        {"parity flip --pairs - --csv figures.csv", "a list of pairs from standard input"}},
       {{0, "within limits"},
        kWarned,
        {2, "over a limit"},
        kNotComparable,
        {4, "unreadable, missing or not finite"},
        kUsage}},
      {"approve",
       "The report has to be whole: all scenes compared, without --only and --material. Review the file's changes as\n"
       "code; `parity report --approvals FILE` judges by it.",
       {{"parity approve out --material 'Chrome*' --reason 'refit in sprint 12' --owner characters --until 2027-02-01",
         "writes approvals.toml"},
        {"parity report --suite nightly.toml --approvals approvals.toml -o out", "accepted rows pass, and are shown"}},
       {kDone, {4, "nothing to approve, or the report is not whole"}, kUsage}},
      {"budget", "", {}, {kDone, kFailed, kUsage}},
      {"budget suggest",
       "",
       {{"parity budget suggest out -o budgets.toml", "from the report in out"},
        {"parity budget suggest run1 run2 run3 --metrics flip,ssim --margin 0.2", "from several runs"}},
       {kDone, kFailed, kUsage}},
      {"budget check",
       "",
       {{"parity budget check budgets.toml", "its rules, or what is wrong"}},
       {kDone, kFailed, kUsage}},
      {"fit",
       "",
       {{"parity fit --geometry-term schlick-smith --format hlsl", "constants for your own path"}},
       {kDone, kFailed, kUsage}},
      {"plot",
       "",
       {{"parity plot env-brdf scene.glb -o plot", "error of EnvBRDFApprox against the table"}},
       {kDone, kFailed, kUsage}},
      {"bench",
       "",
       {{"parity bench scene.glb --env studio.hdr --budget flip=0.02 -o out", "time and error of each setting"},
        {"parity bench scene.glb --settings '*: refit*' --no-truth", "some settings"},
        {"parity bench --scaling -o scaling", "time over size"}},
       {{0, "done, and a setting is within --budget"},
        {2, "no setting is within --budget, or one is slower than in --compare"},
        {4, "a scene failed, or no setting could be judged against --compare"},
        kUsage}},
      {"explain",
       "",
       {{"parity explain scene.glb --env studio.hdr", "what would help each material"},
        {"parity explain scene.glb --switch sky-sh=9 --switch formulas=refit", "these changes, alone and together"},
        {"parity explain --suite suite.toml", "and the one set that repairs the most materials"}},
       {kDone, {3, "no chosen material is seen"}, kFailed, kUsage}},
      {"worst",
       "",
       {{"parity worst scene.glb --env studio.hdr", "where it is worst, as a scene of a suite"},
        {"parity worst scene.glb --sun 30,50,4 --material chrome", "also by the sun; of one material"}},
       {kDone, {3, "no view shows a chosen material large enough"}, kFailed, kUsage}},
      {"preset", "", {}, {kDone, kFailed, kUsage}},
      {"preset new",
       "The folder holds preset.toml and preset.glsl, with the template's formulas. See docs/presets.md.",
       {{"parity preset new mypreset --from ue4-2020", "a folder; it says which option takes it"}},
       {kDone, {4, "the folder has files already, or cannot be written"}, kUsage}},
      {"preset functions", "", {{"parity preset functions", "their prototypes, units and ranges"}}, {kDone, kUsage}},
      {"study-preset",
       "The page compares the presets that are named: errors of their functions, NaN and infinity at the edges, cost, "
       "and "
       "FLIP\nof a scene under each environment.",
       {{"parity study-preset ./mypreset ue4-2020 -o study", "beside the preset that it began as"},
        {"parity study-preset ./mypreset --env studio.hdr --scene car.glb -o study", "in another scene"}},
       {{0, "no function gives NaN or infinity"},
        {2, "some function does"},
        {4, "a preset could not be studied"},
        kUsage}},
      {"stress",
       "",
       {{"parity stress -o stress", "all functions, and renders at the edges"},
        {"parity stress --functions 'D_*' --points 100000", "some functions, more points"},
        {"parity stress --only renders --seconds 600", "a soak test"}},
       {{0, "nothing new was found"}, {2, "a new finding"}, kFailed, kUsage}},
      {"bake",
       "If a scene fails, the others are still baked. - reads more scenes from standard input, one a line.",
       {{"parity bake scene.glb --env studio.hdr -o baked",
         "then: parity report scene.glb --env studio.hdr --baked baked"},
        {"parity bake --suite demo.toml", "each scene of the suite that has the key baked"}},
       {kDone, kFailed, kUsage}},
      {"devices",
       "",
       {{"parity devices --device nvidia", "which one this name selects"}},
       {kDone, {4, "no device can be used"}, kUsage}},
      {"info", "", {{"parity info scene.glb", "materials, lights, cameras"}}, {kDone, kFailed, kUsage}},
      {"export",
       "Environment maps are not part of glTF: the command says which one the file lacks. What else of a scene glTF "
       "cannot\nsay is a warning.",
       {{"parity export builtin:materials -o materials.glb", "a built-in scene for another engine"},
        {"parity export walk.gltf --time 1.5 -o pose.glb", "an animation's pose at 1.5 s"}},
       {kDone, kFailed, kUsage}},
      {"knobs", "", {{"parity knobs | less", "all settings"}}, {kDone, kUsage}},
      {"cache", "", {}, {kDone, kFailed, kUsage}},
      {"cache info", "", {{"parity cache info", "what it holds"}}, {kDone, kFailed, kUsage}},
      {"cache clear", "", {{"parity cache clear", "removes all entries"}}, {kDone, kFailed, kUsage}},
      {"suite", "", {}, {kDone, kFailed, kUsage}},
      {"suite list",
       "",
       {{"parity suite list nightly.toml --only tag:hero", "the scenes with a tag, with views and times"}},
       {kDone, kFailed, kUsage}},
      {"history",
       "A folder with one file a run, which is the truth, and an index, which is made from them and may be removed.",
       {},
       {kDone, kFailed, kUsage, kWriting}},
      {"history add",
       "Commit, its time and branch come from the options, else from the environment of GitHub, GitLab, Buildkite or\n"
       "CircleCI (or PARITY_COMMIT, PARITY_BRANCH, PARITY_COMMIT_TIME), else from git. The same run again changes "
       "nothing.",
       {{"parity history add out --history /srv/parity", "what is new, worse, better or gone since the run before"}},
       {{0, "done, whatever changed"}, kFailed, kUsage, kWriting}},
      {"history rebuild",
       "",
       {{"parity history rebuild --history /srv/parity", "the same index as before"}},
       {kDone, kFailed, kUsage, kWriting}},
      {"history show",
       "",
       {{"parity history show", "the last 30 runs"},
        {"parity history show 'Hero/front/Chrome'", "all its values, each with its runs"}},
       {kDone, kFailed, {64, "wrong usage, or the history has no such row"}, kWriting}},
      {"history blame",
       "Figures have no noise. What changed is due to an input, the build, the driver or a setting that changed, too;\n"
       "if none of them did, it is nondeterminism.",
       {{"parity history blame 'Hero/front/Chrome' --metric flip.mean", "since which run and commit, and why"}},
       {kDone, kFailed, {64, "wrong usage, or the history has no such row or figure"}, kWriting}},
      {"history step",
       "Other failures end with 125, too, and wrong usage with 128, which stops git bisect: it takes 64 for bad.\n"
       "A report that was there before the command ran is not judged.",
       {{"parity history step out --at-most flip.mean=.062 --material Chrome", "a report that is there"},
        {"git bisect run parity history step out --at-most flip.mean=.062 -- ./night.sh", "each commit's own"}},
       {{0, "good: all rows are within the limits"},
        {1, "bad: a row is beyond a limit"},
        {125, "skip: no report was made, a row could not be judged, or there is none"},
        {128, "wrong usage"}}},
      {"history gc",
       "It keeps pictures of recent runs, and of the first and last run of each interval of a row's verdict. It "
       "removes no\n"
       "figures.",
       {{"parity history gc --days 90 --dry-run", "what would be removed"}},
       {kDone, kFailed, kUsage, kWriting}},
      {"history page",
       "One file, which works without a server. It shows the rows that changed last, at most 2,000.",
       {{"parity history page --history /srv/parity -o nights", "open nights/index.html"}},
       {kDone, kFailed, kUsage, kWriting}},
      {"history baseline",
       "It goes back from the merge base to the newest commit that has a whole and complete run.",
       {{"parity report --suite nightly.toml --baseline \"$(parity history baseline --print report)\"", "on a branch"}},
       {kDone, {4, "there is no such run, or git knows no such commits"}, kUsage, kWriting}},
      {"help", "", {{"parity help budget suggest", "the same as parity budget suggest --help"}}, {kDone, kUsage}},
      {"completion",
       "The Debian package and `cmake --install` put these scripts where the shells look for them.",
       {{"source <(parity completion bash)", "for this shell (bash)"},
        {"parity completion fish > ~/.config/fish/completions/parity.fish", "for good (fish)"},
        {"parity completion zsh > ~/.zfunc/_parity", "for good (zsh); ~/.zfunc must be in fpath"}},
       {kDone, kUsage}},
      {"man",
       "",
       {{"parity man report | man -l -", "reads it"}, {"parity man -o man1", "writes the pages of all commands"}},
       {kDone, kFailed, kUsage}},
  };
  return kTable;
}

std::string footerOf(const CommandHelp& help) {
  std::string text;
  if (!help.notes.empty()) text += fmt::format("{}\n", help.notes);
  std::size_t width = 0;
  for (const Example& example : help.examples) width = std::max(width, example.line.size());
  if (!help.examples.empty()) text += text.empty() ? "Examples:\n" : "\nExamples:\n";
  constexpr std::size_t kColumns = 130;
  for (const Example& example : help.examples) {
    const bool fits = 4 + width + example.what.size() <= kColumns;
    text += fits ? fmt::format("  {:<{}}  {}\n", example.line, width, example.what)
                 : fmt::format("  {}\n      {}\n", example.line, example.what);
  }
  text += text.empty() ? "Exit codes:\n" : "\nExit codes:\n";
  for (const ExitCodeText& each : help.exitCodes) text += fmt::format("  {:>3}  {}\n", each.code, each.meaning);
  text.pop_back(); // CLI11 ends the line
  return text;
}

// Headings in one order, and whether an option is repeatable in plain words.
class HelpFormatter : public CLI::Formatter {
public:
  // As CLI11's own, whose make_groups() is not virtual.
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return make_description(app) + make_usage(app, std::move(name)) + make_positionals(app) + groupsOf(app) +
           make_subcommands(app, mode) + '\n' + make_footer(app);
  }

private:
  std::string groupsOf(const CLI::App* app) const {
    std::string text;
    for (const std::string& title : groupTitles(*app)) {
      const std::vector<const CLI::Option*> options =
          app->get_options([&](const CLI::Option* o) { return o->get_group() == title && o->nonpositional(); });
      if (!options.empty()) text += make_group(title, false, options);
    }
    return text;
  }
};

// CLI11 tells INT, UINT and FLOAT apart, which is of use to nobody: the range says what is taken.
void nameNumbers(CLI::App& app) {
  for (CLI::Option* option : app.get_options([](CLI::Option*) { return true; }))
    for (const std::string type : {"INT", "UINT", "FLOAT"})
      if (const std::string shown = option->get_type_name(); shown == type || shown.starts_with(type + ":"))
        option->type_name("NUMBER");
}

void addHelpTo(CLI::App& app, const std::string& name, const std::shared_ptr<HelpFormatter>& formatter) {
  app.formatter(formatter);
  app.footer(footerOf(helpOf(name)));
  app.get_help_ptr()->group(kGeneralGroup);
  nameNumbers(app);
  for (CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; }))
    addHelpTo(*below, name.empty() ? below->get_name() : name + " " + below->get_name(), formatter);
}

} // namespace

const CommandHelp& helpOf(std::string_view command) {
  const auto found = std::ranges::find(table(), command, &CommandHelp::command);
  if (found == table().end()) throw std::out_of_range("no help of " + std::string(command));
  return *found;
}

std::string introduction() {
  constexpr std::size_t kColumns = 120;
  std::string text = kIntro, line = "Scenes are .gltf or .glb files, or";
  for (const std::string& scene : scenes::builtinSceneNames()) {
    const std::string word = fmt::format(" builtin:{},", scene);
    if (line.size() + word.size() > kColumns) text += "\n" + line, line.clear();
    line += line.empty() ? word.substr(1) : word;
  }
  line.back() = '.';
  return text + "\n" + line;
}

void addHelp(CLI::App& app) {
  const auto formatter = std::make_shared<HelpFormatter>();
  formatter->column_width(34);
  addHelpTo(app, "", formatter);
}

} // namespace parity::cli
