// parity flip: pairs of pictures in, figures, verdicts and maps out, one pair after the other.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/images/flip_checks.h"
#include "compare/images/image_pairs.h"
#include "compare/images/mask_file.h"
#include "compare/images/plain_image.h"
#include "compare/metrics/metric.h"
#include "compare/pooling/figures.h"
#include "compare/pooling/pooling.h"
#include "compare/verdict/budget.h"

namespace parity::compare {

enum class DynamicRange { automatic, ldr, hdr };

// Files to write; empty paths: none. With many pairs each is a folder that gets one file a pair, of that kind.
struct FlipOutputs {
  std::filesystem::path map;         // FLIP of the pair: .png in magma, .exr and .pfm as values; 0 outside the area
  std::filesystem::path exposureMap; // HDR pairs: which exposure the error is worst at, i/(n-1); same kinds
  std::filesystem::path histogram;   // .svg
  std::string mapKind = ".png";      // of map and exposureMap in folders
};

struct FlipRequest {
  FilePairs files;
  PlainImageOptions image;
  DynamicRange range = DynamicRange::automatic;
  std::vector<std::string> metrics; // empty: defaultMetrics(); what limits name is added
  MetricOptions metric;             // its box is set for each pair
  MaskRequest mask;
  std::vector<Threshold> thresholds;
  std::optional<Budgets> budgets;
  std::vector<std::string> hdrOptions; // of the command line, given for HDR-FLIP: a note where a pair has none
  bool worstNonFinite = false; // pixels that are NaN or infinite count as the worst error and fail; else an error
  FlipOutputs outputs;
};

// One region of one pair.
struct FlipRow {
  std::string name; // "image", "area", "mask", "id 7", "alpha", "alpha, id 7"
  Figures figures;
  bool whole = false; // no mask divides the picture: to budgets it is a whole image, else a material
  std::vector<CheckResult> checks;
  Verdict verdict = Verdict::pass;
  std::string reason; // one sentence: what decided the verdict; empty on a pass
  AppliedRule rule;   // of the budgets
};

struct FlipPair {
  FilePair files;
  int width = 0, height = 0;
  std::string channels; // "RGB + alpha"
  bool hdr = false;
  std::string rangeReason;               // why LDR or HDR
  std::string referenceSpace, testSpace; // "srgb, assumed of 8-bit integers"
  std::vector<std::string> notes;        // what else was assumed or left out
  bool identical = false, black = false; // every pixel is the same; all of them are black, in both
  bool invisible = false;                // nothing but the background is seen, in both
  bool partial = false;                  // the files hold more than was compared: layers, further images
  std::string where;                     // "area 24,8,10,4 of mask ids.exr"; empty: the whole picture
  std::optional<Pooling>
      pooling; // of the FLIP map over the image; none with a mask or an area, or where FLIP was not measured
  std::vector<FlipRow> rows;
  std::vector<std::filesystem::path> written; // files
  Verdict verdict = Verdict::pass;
  std::string reason; // one sentence: the first row's that decided the verdict, or the error
  int errorCode = 0;  // 3 or 4 where the verdict is `error`
};

struct FlipResult {
  std::vector<FlipPair> pairs;
  bool judged = false;               // any limits were given; else a verdict `pass` says no more than "compared"
  std::vector<std::string> skipped;  // files of the folders that were passed over
  std::vector<std::string> warnings; // of the whole run: rules of the budgets that judged nothing
};

// What a run measures that names no metrics, the cheap ones: flip, rmse, psnr, bias; of HDR pairs hdrflip, relmse,
// bias.
std::vector<std::string> defaultFlipMetrics(bool hdr);

// What makes sense for no pair at all: limits and metrics that are unknown, or need HDR where LDR is asked for. Throws
// Error (usage).
void requireSense(const FlipRequest& request);

// What is wrong with one pair (missing, unreadable, not comparable, non-finite, not writable) is its own result, and
// the others still run. Memory is that of one pair. Throws Error (usage) as requireSense(), and where options make no
// sense for the only pair there is. progress (may be empty) is told the name of the pair at work, and how much of all
// is done, 0..1.
FlipResult runFlip(const FlipRequest& request, const std::function<void(const std::string&, double)>& progress = {});

Verdict worstVerdict(const FlipResult& result);

// Of one pair: 0, 1 (warnings, only with warnExit), 2, 3 or 4; of all, the highest (docs/design.md 8a).
int exitCode(const FlipPair& pair, bool warnExit);
int exitCode(const FlipResult& result, bool warnExit);

} // namespace parity::compare
