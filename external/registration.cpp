#include "external/registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include <kissfft/kissfft.hh>

#include "base/parallel.h"
#include "external/angles.h"

namespace parity::external {

namespace {

using Complex = std::complex<double>;

// In place; rows, then columns.
void transform(std::vector<Complex>& values, int width, int height, bool inverse) {
  const kissfft<double> alongX(static_cast<std::size_t>(width), inverse),
      alongY(static_cast<std::size_t>(height), inverse);
  const auto each = [&](int count, int length, int step, int next, const kissfft<double>& fft) {
    base::parallelFor(static_cast<std::size_t>(count), 16, [&](std::size_t begin, std::size_t end) {
      std::vector<Complex> in(static_cast<std::size_t>(length)), out(in.size());
      kissfft<double> own = fft; // has a buffer of its own
      for (std::size_t line = begin; line < end; ++line) {
        Complex* first = values.data() + line * static_cast<std::size_t>(next);
        for (int i = 0; i < length; ++i)
          in[static_cast<std::size_t>(i)] = first[static_cast<std::size_t>(i) * static_cast<std::size_t>(step)];
        own.transform(in.data(), out.data());
        for (int i = 0; i < length; ++i)
          first[static_cast<std::size_t>(i) * static_cast<std::size_t>(step)] = out[static_cast<std::size_t>(i)];
      }
    });
  };
  each(height, width, 1, width, alongX);
  each(width, height, width, 1, alongY);
}

// Edges without their mean, faded out at the border: what is cut off there is no edge.
std::vector<Complex> windowed(const base::Image& edges) {
  double mean = 0;
  for (const float value : edges.pixels) mean += value;
  mean /= static_cast<double>(edges.pixels.size());
  std::vector<Complex> out(edges.pixels.size());
  const auto fade = [](int i, int count) {
    const double border = 0.08 * count, near = std::min(i + 0.5, count - i - 0.5);
    return near >= border ? 1.0 : 0.5 - 0.5 * std::cos(kPi * near / border);
  };
  for (int y = 0; y < edges.height; ++y)
    for (int x = 0; x < edges.width; ++x)
      out[static_cast<std::size_t>(y) * static_cast<std::size_t>(edges.width) + static_cast<std::size_t>(x)] =
          (*edges.at(x, y) - mean) * fade(x, edges.width) * fade(y, edges.height);
  return out;
}

// Frequency of the k-th value of a transform.
double frequency(int k, int count) { return (k <= count / 2 ? k : k - count) / static_cast<double>(count); }

// The correlation between the pixels: the inverse transform at one place.
class Between {
public:
  Between(const std::vector<Complex>& spectrum, int width, int height)
      : m_spectrum(spectrum), m_width(width), m_height(height) {}

  // At all (x, y) of the two lists: row by row.
  std::vector<double> at(const std::vector<double>& xs, const std::vector<double>& ys) const {
    const std::vector<Complex> wavesX = wavesOf(xs, m_width), wavesY = wavesOf(ys, m_height);
    const auto width = static_cast<std::size_t>(m_width), height = static_cast<std::size_t>(m_height);
    std::vector<Complex> alongX(height * xs.size()); // each row at the xs
    base::parallelFor(height, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row)
        for (std::size_t i = 0; i < xs.size(); ++i)
          alongX[row * xs.size() + i] = dot(&m_spectrum[row * width], &wavesX[i * width], width, 1);
    });
    std::vector<double> values;
    for (std::size_t j = 0; j < ys.size(); ++j)
      for (std::size_t i = 0; i < xs.size(); ++i)
        values.push_back(dot(&alongX[i], &wavesY[j * height], height, xs.size()).real());
    return values;
  }

private:
  // Of each place the wave of each frequency there.
  static std::vector<Complex> wavesOf(const std::vector<double>& places, int count) {
    std::vector<Complex> waves;
    for (const double place : places)
      for (int k = 0; k < count; ++k) waves.push_back(std::polar(1.0, 2 * kPi * frequency(k, count) * place));
    return waves;
  }
  // Written out: Complex' own product looks for infinities.
  static Complex dot(const Complex* values, const Complex* waves, std::size_t count, std::size_t step) {
    double real = 0, imaginary = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Complex &v = values[k * step], &w = waves[k];
      real += v.real() * w.real() - v.imag() * w.imag();
      imaginary += v.real() * w.imag() + v.imag() * w.real();
    }
    return {real, imaginary};
  }

  const std::vector<Complex>& m_spectrum;
  int m_width, m_height;
};

double lanczos(double x) {
  constexpr double kLobes = 3;
  if (x == 0) return 1;
  if (std::abs(x) >= kLobes) return 0;
  return kLobes * std::sin(kPi * x) * std::sin(kPi * x / kLobes) / (kPi * kPi * x * x);
}

// One pixel of the picture between its pixels.
void sample(const base::Image& picture, double x, double y, float* out) {
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const auto pixel = [&](int px, int py) {
    return picture.at(std::clamp(px, 0, picture.width - 1), std::clamp(py, 0, picture.height - 1));
  };
  constexpr int kReach = 3;
  std::array<double, 2 * kReach> alongX{}, alongY{};
  double all = 0;
  for (int i = 0; i < 2 * kReach; ++i) {
    alongX[static_cast<std::size_t>(i)] = lanczos(x - (x0 + 1 - kReach + i));
    alongY[static_cast<std::size_t>(i)] = lanczos(y - (y0 + 1 - kReach + i));
  }
  for (const double wy : alongY)
    for (const double wx : alongX) all += wx * wy;
  for (int c = 0; c < picture.channels; ++c) {
    double sum = 0;
    for (int j = 0; j < 2 * kReach; ++j)
      for (int i = 0; i < 2 * kReach; ++i)
        sum += alongX[static_cast<std::size_t>(i)] * alongY[static_cast<std::size_t>(j)] *
               pixel(x0 + 1 - kReach + i, y0 + 1 - kReach + j)[c];
    const auto [least, most] =
        std::minmax({pixel(x0, y0)[c], pixel(x0 + 1, y0)[c], pixel(x0, y0 + 1)[c], pixel(x0 + 1, y0 + 1)[c]});
    out[c] = std::clamp(static_cast<float>(sum / all), least, most);
  }
}

} // namespace

double likenessOf(const base::Image& a, const base::Image& b) {
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  const auto n = static_cast<double>(a.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double x = a.pixels[i], y = b.pixels[i];
    sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y;
  }
  const double va = saa - sa * sa / n, vb = sbb - sb * sb / n;
  return va > 0 && vb > 0 ? (sab - sa * sb / n) / std::sqrt(va * vb) : 0;
}

double mostMoved(const Placement& placement, int width, int height) {
  const double angle = placement.rotationDeg * kDegree, c = std::cos(angle) * placement.scale - 1,
               s = std::sin(angle) * placement.scale;
  double most = 0;
  for (const auto& [x, y] : {std::pair(-0.5, -0.5), std::pair(0.5, -0.5), std::pair(0.5, 0.5), std::pair(-0.5, 0.5)}) {
    const double px = x * width, py = y * height;
    most = std::max(most, std::hypot(placement.dx + c * px - s * py, placement.dy + s * px + c * py));
  }
  return most;
}

base::Image edgesOf(const base::Image& rgb) {
  constexpr float kFloor = 1.f / 64; // of luminance: below it all is black
  base::Image luminance(rgb.width, rgb.height, 1), edges(rgb.width, rgb.height, 1);
  for (std::size_t i = 0; i < luminance.pixels.size(); ++i) {
    const float* c = &rgb.pixels[3 * i];
    const float value = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
    luminance.pixels[i] = std::log2((std::isfinite(value) ? std::clamp(value, 0.f, 64.f) : 0.f) + kFloor);
  }
  for (int y = 1; y + 1 < rgb.height; ++y)
    for (int x = 1; x + 1 < rgb.width; ++x) {
      const auto at = [&](int i, int j) { return *luminance.at(x + i, y + j); };
      const float gx = 3 * (at(1, -1) - at(-1, -1)) + 10 * (at(1, 0) - at(-1, 0)) + 3 * (at(1, 1) - at(-1, 1)),
                  gy = 3 * (at(-1, 1) - at(-1, -1)) + 10 * (at(0, 1) - at(0, -1)) + 3 * (at(1, 1) - at(1, -1));
      *edges.at(x, y) = std::hypot(gx, gy) / 32;
    }
  return edges;
}

Shift findShift(const base::Image& picture, const base::Image& other) {
  const int width = picture.width, height = picture.height;
  std::vector<Complex> a = windowed(picture), b = windowed(other);
  transform(a, width, height, false);
  transform(b, width, height, false);
  // The cross spectrum. Phases alone would give noise as much weight as edges: each is weighted by the root of its
  // strength.
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Complex product = a[i] * std::conj(b[i]);
    const double strength = std::abs(product);
    a[i] = strength > 0 ? product / std::sqrt(strength) : Complex(0);
  }
  std::vector<Complex> peaks = a;
  transform(peaks, width, height, true);
  int bestX = 0, bestY = 0;
  double best = -1;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double sx = std::abs(frequency(x, width)), sy = std::abs(frequency(y, height));
      const double value =
          peaks[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)].real();
      if (sx <= 0.25 && sy <= 0.25 && value > best) best = value, bestX = x, bestY = y;
    }
  Shift shift{frequency(bestX, width) * width, frequency(bestY, height) * height, 0};
  const Between between(a, width, height);
  for (const double step : {0.1, 0.01}) {
    constexpr int kSteps = 10; // to either side
    std::vector<double> xs, ys;
    for (int i = -kSteps; i <= kSteps; ++i) xs.push_back(shift.dx + i * step), ys.push_back(shift.dy + i * step);
    const std::vector<double> values = between.at(xs, ys);
    const auto top = static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
    shift.dx = xs[top % xs.size()], shift.dy = ys[top / xs.size()];
  }
  shift.likeness = likenessOf(placedOnView(picture, {.dx = shift.dx, .dy = shift.dy}), other);
  return shift;
}

base::Image placedOnView(const base::Image& picture, const Placement& placement) {
  base::Image out(picture.width, picture.height, picture.channels);
  const double cx = 0.5 * (picture.width - 1), cy = 0.5 * (picture.height - 1);
  const double angle = placement.rotationDeg * kDegree, c = std::cos(angle) * placement.scale,
               s = std::sin(angle) * placement.scale;
  base::parallelFor(static_cast<std::size_t>(picture.height), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int x = 0; x < picture.width; ++x) {
        const double px = (placement.mirrored ? cx - x : x - cx), py = static_cast<double>(row) - cy;
        sample(picture, cx + placement.dx + c * px - s * py, cy + placement.dy + s * px + c * py,
               out.at(x, static_cast<int>(row)));
      }
  });
  return out;
}

} // namespace parity::external
