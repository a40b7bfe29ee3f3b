#include "gpu/surface/frame_builder.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"

namespace parity::gpu {

namespace {

constexpr std::size_t kFrameGrain = 16384;

// plane = value * weight + plane * keep at the pixels of a surface, in the target's numbers where there is one; the
// plane begins at the tile's first pixel. weightsOf: entry -> (keep, weight).
void composite(float* plane, std::size_t firstPixel, const Surface& surface, const PlaneView& values,
               const auto& weightsOf, const TargetCodec* target) {
  base::parallelFor(surface.size(), kFrameGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float* out = plane + (surface.pixels[i] - firstPixel) * 3;
      const auto [keep, weight] = weightsOf(i);
      // What is hidden wholly is replaced, not multiplied by 0: it may be NaN.
      glm::vec3 value(values[i]);
      if (target) value = target->write(value);
      for (int c = 0; c < 3; ++c) value[c] = (keep == 0 ? 0 : out[c] * keep) + value[c] * weight;
      if (target) value = target->store(value);
      for (int c = 0; c < 3; ++c) out[c] = value[c];
    }
  });
}

std::vector<base::Image> makeTerms(std::uint32_t width, std::uint32_t height, const std::vector<char>& terms) {
  std::vector<base::Image> images(terms.size());
  base::parallelFor(terms.size(), 1, [&](std::size_t t, std::size_t) {
    if (terms[t] != 0) images[t] = base::Image(static_cast<int>(width), static_cast<int>(height), 3);
  });
  return images;
}

} // namespace

FrameBuilder::FrameBuilder(std::uint32_t width, int samples, const glm::vec3& background,
                           const std::optional<TargetCodec>& target)
    : m_width(width), m_samples(samples), m_background(target ? target->store(target->write(background)) : background),
      m_target(target) {}

FrameBuilder::FrameBuilder(std::uint32_t width, std::uint32_t height, int samples, const std::vector<char>& terms,
                           const glm::vec3& background, const std::optional<TargetCodec>& target)
    : FrameBuilder(width, samples, background, target) {
  m_frame.terms = makeTerms(width, height, terms);
  m_frame.color = base::Image(static_cast<int>(width), static_cast<int>(height), 3);
}

FrameBuilder FrameBuilder::ofTerms(std::uint32_t width, std::uint32_t height, int samples,
                                   const std::vector<char>& terms) {
  FrameBuilder builder(width, samples, glm::vec3(0), std::nullopt);
  builder.m_frame.terms = makeTerms(width, height, terms);
  return builder;
}

float* FrameBuilder::planeAt(std::size_t plane) {
  return m_samples > 1 ? m_sample[plane].data() : imageOf(plane).at(0, static_cast<int>(m_tile.firstRow));
}

void FrameBuilder::begin(const Tile& tile) {
  m_tile = tile;
  const std::size_t count = std::size_t{tile.rows} * m_width;
  if (m_samples > 1) {
    m_sample.resize(planeCount());
    for (std::size_t plane = 0; plane < m_sample.size(); ++plane)
      if (isComposed(plane)) m_sample[plane].assign(count * 3, 0.f);
  }
  if (!isComposed(0)) return;
  float* color = planeAt(0);
  for (std::size_t p = 0; p < count; ++p)
    for (int c = 0; c < 3; ++c) color[p * 3 + c] = m_background[c];
}

void FrameBuilder::lay(const Surface& surface, const ShadedSurface& shaded) {
  if (surface.size() == 0) return;
  const std::size_t firstPixel = std::size_t{m_tile.firstRow} * surface.width;
  const auto weightsOf = [&](std::size_t i) {
    if (!surface.blended) return std::pair(0.f, 1.f);
    const float opacity = shaded.color[i].w;
    return std::pair(1 - opacity, shaded.premultiplied ? 1.f : opacity);
  };
  for (std::size_t plane = 0; plane < planeCount(); ++plane)
    if (isComposed(plane))
      composite(planeAt(plane), firstPixel, surface, plane == 0 ? shaded.color : shaded.terms[plane - 1], weightsOf,
                plane == 0 && m_target ? &*m_target : nullptr);
}

void FrameBuilder::end() {
  if (m_samples == 1) return;
  for (std::size_t plane = 0; plane < m_sample.size(); ++plane) {
    if (!isComposed(plane)) continue;
    float* out = imageOf(plane).at(0, static_cast<int>(m_tile.firstRow));
    for (const float value : m_sample[plane]) *out++ += value;
  }
}

base::Frame FrameBuilder::take() {
  const auto divide = [&](base::Image& image) {
    for (float& value : image.pixels) value /= static_cast<float>(m_samples);
  };
  if (m_samples > 1)
    for (std::size_t plane = 0; plane < planeCount(); ++plane) divide(imageOf(plane));
  if (m_target)
    base::parallelFor(m_frame.color.pixelCount(), kFrameGrain, [&](std::size_t begin, std::size_t end) {
      for (float* p = m_frame.color.pixels.data() + 3 * begin; p != m_frame.color.pixels.data() + 3 * end; p += 3) {
        const glm::vec3 light = m_target->read(m_target->store({p[0], p[1], p[2]}));
        for (int c = 0; c < 3; ++c) p[c] = light[c];
      }
    });
  return std::move(m_frame);
}

} // namespace parity::gpu
