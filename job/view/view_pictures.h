// The pictures of a view, and of each material that it shows a crop of each; and the values behind them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/image/image.h"
#include "compare/pooling/pixel_view.h"
#include "job/view/view_planes.h"
#include "report/report.h"

namespace parity::job {

// What is written, as PNG; the three after `flip` are set where there is a truth. And as pixel files.
struct ViewPictures {
  struct OfPath {
    std::string name;
    const base::Image8* picture = nullptr; // as displayed
  } reference, test;
  const base::Image* flip = nullptr;                             // of test against reference
  std::vector<const base::PixelList*> materials;                 // of the view, in their order
  const std::vector<std::vector<float>>* materialFlip = nullptr; // of each the FLIP of its pixels, by the material swap
  const base::Image8* truth = nullptr;                           // as displayed
  const base::Image *referenceTruthFlip = nullptr, *testTruthFlip = nullptr;
  ViewPlanes planes; // none: no such files
};

// A file of a report, not yet written.
struct EncodedPicture {
  std::string file; // relative to the report's folder, as the report names it
  std::vector<std::byte> bytes;
};

// A material's pixels with a margin, so that the crop shows what surrounds them. Empty for an empty list.
compare::Rect cropOf(const base::PixelList& list, int width, int height);
base::Image8 crop(const base::Image8& image, const compare::Rect& box);

// The name of a picture beside that of a path: "images/0_m3_mobile.png", mobile, "mask": "images/0_m3_mask.png".
std::string pictureBeside(const std::string& picture, const std::string& path, const std::string& kind);

// Makes images/PREFIX_*.png, by the names of the paths, and names them in the view; of each material whose crop is not
// empty images/PREFIX_mNUMBER_*.png, FLIP of which is the material's own. crops and numbers: as many as the view has
// materials. Of planes pixels/PREFIX.js and pixels/PREFIX_terms.js. Throws Error (exit 4).
std::vector<EncodedPicture> encodeViewPictures(report::ViewResult& view, const ViewPictures& pictures,
                                               const std::vector<compare::Rect>& crops,
                                               const std::vector<std::size_t>& numbers, const std::string& prefix);

// pixels/PREFIX_terms.js alone, named in the view: of terms that were rendered after its pictures were made; nothing
// where there are no planes.
std::vector<EncodedPicture> encodeTerms(report::ViewResult& view, const std::vector<report::PixelPlane>& planes,
                                        const std::string& prefix);

// Writes them below the report's folder, all at the same time. Throws Error (exit 4).
void writePictures(const std::vector<EncodedPicture>& pictures, const std::filesystem::path& folder);

} // namespace parity::job
