#include "gpu/surface/frame_builder.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"

namespace parity::gpu {

namespace {

constexpr std::size_t kFrameGrain = 16384;

// plane = value * weight + plane * keep at the pixels of a surface, in the target's numbers where there is one; the
// plane begins at the tile's first pixel. weightsOf: entry -> (keep, weight).
void composite(float* plane, std::size_t firstPixel, const Surface& surface, const std::vector<glm::vec4>& values,
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

} // namespace

FrameBuilder::FrameBuilder(std::uint32_t width, std::uint32_t height, int samples, const std::vector<char>& terms,
                           const glm::vec3& background, const std::optional<TargetCodec>& target)
    : m_samples(samples), m_background(target ? target->store(target->write(background)) : background),
      m_target(target) {
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  m_frame.color = base::Image(w, h, 3);
  m_frame.terms.resize(terms.size());
  base::parallelFor(terms.size(), 1, [&](std::size_t t, std::size_t) {
    if (terms[t] != 0) m_frame.terms[t] = base::Image(w, h, 3);
  });
}

float* FrameBuilder::planeAt(std::size_t plane) {
  if (m_samples > 1) return m_sample[plane].data();
  base::Image& image = plane == 0 ? m_frame.color : m_frame.terms[plane - 1];
  return image.at(0, static_cast<int>(m_tile.firstRow));
}

void FrameBuilder::begin(const Tile& tile) {
  m_tile = tile;
  const std::size_t count = std::size_t{tile.rows} * static_cast<std::size_t>(m_frame.color.width);
  if (m_samples > 1) {
    m_sample.resize(1 + m_frame.terms.size());
    for (std::size_t plane = 0; plane < m_sample.size(); ++plane)
      if (plane == 0 || isComposed(plane - 1)) m_sample[plane].assign(count * 3, 0.f);
  }
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
  composite(planeAt(0), firstPixel, surface, shaded.color, weightsOf, m_target ? &*m_target : nullptr);
  for (std::size_t t = 0; t < m_frame.terms.size(); ++t)
    if (isComposed(t)) composite(planeAt(t + 1), firstPixel, surface, shaded.terms[t], weightsOf, nullptr);
}

void FrameBuilder::end() {
  if (m_samples == 1) return;
  for (std::size_t plane = 0; plane < m_sample.size(); ++plane) {
    if (plane > 0 && !isComposed(plane - 1)) continue;
    base::Image& sum = plane == 0 ? m_frame.color : m_frame.terms[plane - 1];
    float* out = sum.pixels.data() + std::size_t{m_tile.firstRow} * static_cast<std::size_t>(sum.width) * 3;
    for (const float value : m_sample[plane]) *out++ += value;
  }
}

base::Frame FrameBuilder::take() {
  const auto divide = [&](base::Image& image) {
    for (float& value : image.pixels) value /= static_cast<float>(m_samples);
  };
  if (m_samples > 1) {
    divide(m_frame.color);
    for (base::Image& term : m_frame.terms) divide(term);
  }
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
