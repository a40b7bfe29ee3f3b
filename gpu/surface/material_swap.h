// The material swap (docs/metrics.md): a picture in which one material alone carries another path's colours.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/frame.h"
#include "base/raw_vector.h"
#include "gpu/surface/output_target.h"
#include "gpu/surface/shading_pass.h"

namespace parity::gpu {

// A material's swapped pictures at the pixels of its coverage list, in that list's order. Linear, scene-referred RGB;
// everywhere else the swapped picture is the reference path's.
struct SwappedPixels {
  std::vector<base::Image> planes; // gathered (base/gathered.h), 3 channels; empty for an empty list
  // Pixels all of whose samples show this material's opaque surface and no other material over it: places in the list,
  // ascending.
  std::vector<std::uint32_t> whole;
};

// One (reference, test) pair of colours of a surface: what a swapped picture is made of. Entries in the surface's
// order.
struct SwapPlane {
  PlaneView reference, test;
};

// Composes the swapped pictures of all materials at the same time, layer by layer, as FrameBuilder composes frames. For
// each pixel and each material that it shows: the material's entries carry the test colour and the test opacity, all
// other entries the reference's. That is reference + sum over the material's entries of weight * (test
// - reference), where both have the same opacities. Several planes are composed side by side (the terms).
class SwapBuilder {
public:
  // materialOf: of each instance its material, of so many; must outlive the builder. width: of the picture.
  // background: linear RGB of each plane, where no material is seen. target: of the test path. An opaque surface shows
  // what the target returns for its colour. A blended one is blended in linear light where the target is of floats;
  // else in the target's numbers, less what the target makes of the picture behind alone. None: colours as computed.
  // wanted: for each material of the scene whether it is swapped; empty: all.
  SwapBuilder(const std::vector<std::uint32_t>& materialOf, std::size_t materials, std::uint32_t width, int samples,
              std::vector<glm::vec3> background, const std::optional<TargetCodec>& target = std::nullopt,
              std::vector<char> wanted = {});

  // One (tile, sample), as FrameBuilder takes it; tiles in order of rows, all samples of one before the next. layers:
  // how many will be laid, at most.
  void begin(const Tile& tile, std::size_t layers);
  // reference, test: for the opacities, and whether colours are premultiplied. planes: as many as backgrounds.
  void lay(const Surface& surface, const ShadedSurface& reference, const ShadedSurface& test,
           std::span<const SwapPlane> planes);
  void end();

  // Whether the builder swaps what is seen at this entry of a surface: else it does not read the test's colours there.
  bool swaps(const Surface& surface, std::size_t entry) const {
    return m_wanted[m_materialOf[surface.instances[entry]]] != 0;
  }

  // For each coverage list (CoverageBuilder) the swapped pixels. finished: the test path's finished picture, one a
  // plane, or empty: it is what a whole pixel shows, so that samples are averaged in the target's own numbers. The
  // builder is empty afterwards.
  std::vector<SwappedPixels> take(const std::vector<base::PixelList>& coverage,
                                  std::span<const base::Image* const> finished);

private:
  static constexpr std::uint32_t kNone = ~0u;
  // A material at a pixel of this sample; those of a pixel are a chain.
  struct Entry {
    std::uint32_t material = kNone, next = kNone;
    bool whole = false;      // nothing else is seen here: it is opaque, and no other material lies over it
    std::uint32_t place = 0; // where there is one sample: among the material's pixels
  };
  // Of a tile over its samples: ascending by pixel, then material; a pair once.
  struct Sum {
    std::uint32_t pixel, material, whole; // whole: samples
  };
  // A material's pictures at its pixels, so far.
  struct Material {
    std::vector<std::uint32_t> pixels;
    base::RawVector<glm::vec3> colors; // of each pixel, plane by plane
    std::vector<char> whole;           // of each pixel
  };
  void keepOnlySample();
  void addToSums(const std::vector<std::uint32_t>& chain, std::uint32_t place, std::size_t& old,
                 std::vector<Sum>& merged, std::vector<glm::dvec3>& differences) const;
  void finishTile();

  const std::vector<std::uint32_t>& m_materialOf;
  std::size_t m_width;
  int m_samples, m_samplesOfTile = 0;
  std::vector<glm::vec3> m_background;
  std::optional<TargetCodec> m_target;
  std::vector<char> m_wanted;
  std::size_t m_planes;
  std::uint32_t m_firstPixel = 0; // of the tile

  // Of the sample.
  std::vector<std::uint32_t> m_head; // the first entry of each pixel
  std::vector<Entry> m_entries;
  base::RawVector<glm::vec3> m_colors; // of the entries: their swapped pictures, plane by plane
  base::RawVector<glm::vec3> m_base;   // of the pixels: the base pictures, plane by plane; empty where none is read
  std::vector<char> m_isBare;          // of the pixels, where there is one sample: m_base is not set yet
  // Of the tile, where there are several samples: sums over them.
  std::vector<glm::vec3> m_baseSums; // as FrameBuilder adds them up
  std::vector<glm::dvec3> m_exactSums;
  std::vector<Sum> m_sums;
  std::vector<glm::dvec3> m_differences; // of the sums, swapped - base, plane by plane
  std::vector<Material> m_materials;
};

} // namespace parity::gpu
