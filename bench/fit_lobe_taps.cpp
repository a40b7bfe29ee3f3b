// Fits the taps of shading/off_specular.glsl: prints the coefficients that stand there. build/fit_lobe_taps
//
// The light that GGX reflects is the environment weighted by the lobe D V NoL. A few reads of the prefiltered cube are
// to stand for it: each is the environment weighted by a rotationally symmetric lobe (N = V = R) of some mip around
// some direction in the plane of incidence. In spherical harmonics both are known, and the error that an environment
// makes of their difference is a sum over bands, weighted by the environment's power there. Natural light falls off as
// (l + 1/2)^-2.5 (Dror, Willsky and Adelson 2004, "Statistical characterization of real-world illumination"): no
// particular map is fitted. The taps' parameters are quadratic in roughness and NoV; Levenberg and Marquardt's method
// finds the coefficients that make the sum over a grid of both least.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "shading/shading.h"
#include "study/fit/harmonics.h"

namespace {

namespace f64 = parity::shading::f64;
using namespace parity::fit;
using Vector = std::vector<double>;
constexpr int kTerms = 6;

// The levels of the prefiltered cube array: all layers of every mip from 1 on.
struct Cube {
  std::array<Zonal, f64::kPrefilterLayers * f64::kPrefilterRoughestMip + 1> levels;
  Cube() {
    for (std::size_t l = 0; l < levels.size(); ++l)
      levels[l] = dampingOf(f64::roughnessFromMip(static_cast<double>(l) / f64::kPrefilterLayers));
  }
  Zonal at(double mip) const { // as the shader blends two levels
    const f64::PrefilterBlend blend =
        f64::prefilterBlend(std::clamp(mip, 0.0, static_cast<double>(f64::kPrefilterRoughestMip)));
    Zonal z;
    for (int l = 0; l <= kBands; ++l)
      z[l] = levels[blend.lower][l] + (levels[blend.upper][l] - levels[blend.lower][l]) * blend.upperShare;
    return z;
  }
};

enum class Form { stretched, two, three };

struct Tap {
  double angle, mip, weight;
};

// As the functions of shading/off_specular.glsl turn their polynomials q into taps.
std::vector<Tap> tapsOf(Form form, const Vector& q, double roughness, double NoV) {
  const double alpha = roughness * roughness, mip = f64::mipFromRoughness(roughness);
  const auto tap = [&](double lean, double mipOffset, double weight) {
    const double blend = 1 - alpha * lean;
    return Tap{angleOfBlend(NoV, blend), mip + mipOffset, weight};
  };
  if (form == Form::stretched) return {tap(q[0] + q[1], q[2], 0.5), tap(q[0] - q[1], q[2], 0.5)};
  if (form == Form::two) {
    const double w = std::clamp(q[4], 0.0, 1.0);
    return {tap(q[0], q[2], w), tap(q[1], q[3], 1 - w)};
  }
  const double w = std::clamp(q[6], 0.0, 1.0), v = (1 - w) * std::clamp(q[7], 0.0, 1.0);
  return {tap(q[0], q[3], w), tap(q[1], q[4], v), tap(q[2], q[5], 1 - w - v)};
}

struct Point {
  double roughness, NoV, weight;
  Vector lobe;
  std::array<double, kTerms> powers;
};

class Fit {
public:
  Fit(Form form, Vector start) : m_form(form), m_unknowns(start.size()), m_x(start.size() * kTerms, 0.0) {
    for (std::size_t j = 0; j < start.size(); ++j) m_x[j * kTerms] = start[j];
    for (int i = 2; i <= 20; ++i)
      for (const double NoV : {.04, .1, .18, .27, .37, .48, .6, .72, .84, .93, .99}) {
        const double R = 0.05 * i;
        // A sphere shows NoV in proportion to itself; what is grazing must not be forgotten.
        m_points.push_back({R, NoV, NoV + 0.1, {}, {1, NoV, NoV * NoV, R, R * NoV, R * R}});
      }
    parity::base::parallelFor(m_points.size(), 1, [&](std::size_t i, std::size_t) {
      m_points[i].lobe =
          projectLobe(parity::shading::GeometryTerm::heightCorrelated, m_points[i].roughness, m_points[i].NoV);
    });
    for (int l = 1; l <= kBands; ++l)
      for (int m = 0; m <= l; ++m) m_scale[indexOf(l, m)] = std::sqrt(naturalPower(l));
  }

  double cost() const { return cost(m_x); }

  // One step downhill; false where none is found.
  bool step() {
    const std::size_t n = m_x.size();
    std::vector<Vector> normal(n, Vector(n, 0.0));
    Vector gradient(n, 0.0);
    accumulate(normal, gradient);
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) mean += normal[i][i] / static_cast<double>(n);
    const double before = cost(m_x);
    for (int attempt = 0; attempt < 10; ++attempt, m_damping *= 4) {
      std::vector<Vector> damped = normal;
      for (std::size_t i = 0; i < n; ++i) damped[i][i] += m_damping * (normal[i][i] + 1e-6 * mean);
      const Vector change = solve(std::move(damped), gradient);
      if (change.empty()) continue;
      Vector next = m_x;
      for (std::size_t i = 0; i < n; ++i) next[i] -= change[i];
      if (const double after = cost(next); after < before) {
        m_x = next;
        m_damping = std::max(m_damping / 3, 1e-9);
        return before - after > 1e-6 * before;
      }
    }
    return false;
  }

  void print(const char* name) const {
    std::printf("%s: cost %.4g\n", name, cost());
    for (std::size_t j = 0; j < m_unknowns; ++j) {
      for (int k = 0; k < kTerms; ++k) std::printf("%sR(%.4f)", k ? ", " : "  ", m_x[j * kTerms + k]);
      std::printf("\n");
    }
  }

private:
  Vector parametersAt(const Vector& x, const Point& p) const {
    Vector q(m_unknowns, 0.0);
    for (std::size_t j = 0; j < m_unknowns; ++j)
      for (int k = 0; k < kTerms; ++k) q[j] += x[j * kTerms + k] * p.powers[k];
    return q;
  }

  Vector residual(const Vector& q, const Point& p) const {
    Vector d = p.lobe;
    for (const Tap& tap : tapsOf(m_form, q, p.roughness, p.NoV)) {
      const Zonal z = m_cube.at(tap.mip);
      const Vector y = harmonicsAt(std::cos(tap.angle));
      for (int l = 0; l <= kBands; ++l)
        for (int m = 0; m <= l; ++m) // beyond the normal the azimuth is pi
          d[indexOf(l, m)] -= tap.weight * z[l] * y[indexOf(l, m)] * (tap.angle < 0 && m % 2 == 1 ? -1 : 1);
    }
    for (int i = 0; i < kHarmonics; ++i) d[i] *= m_scale[i];
    return d;
  }

  double cost(const Vector& x) const {
    Vector parts(m_points.size());
    parity::base::parallelFor(m_points.size(), 1, [&](std::size_t i, std::size_t) {
      for (const double r : residual(parametersAt(x, m_points[i]), m_points[i])) parts[i] += m_points[i].weight * r * r;
    });
    double sum = 0;
    for (const double part : parts) sum += part;
    return sum;
  }

  void accumulate(std::vector<Vector>& normal, Vector& gradient) const {
    std::vector<std::vector<Vector>> slopes(m_points.size());
    std::vector<Vector> residuals(m_points.size());
    parity::base::parallelFor(m_points.size(), 1, [&](std::size_t i, std::size_t) {
      const Vector q = parametersAt(m_x, m_points[i]);
      residuals[i] = residual(q, m_points[i]);
      for (std::size_t j = 0; j < m_unknowns; ++j) {
        constexpr double kStep = 1e-4;
        Vector low = q, high = q;
        low[j] -= kStep;
        high[j] += kStep;
        const Vector a = residual(low, m_points[i]), b = residual(high, m_points[i]);
        Vector& slope = slopes[i].emplace_back(kHarmonics);
        for (int h = 0; h < kHarmonics; ++h) slope[h] = (b[h] - a[h]) / (2 * kStep);
      }
    });
    const auto dot = [](const Vector& a, const Vector& b) {
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
      return sum;
    };
    for (std::size_t i = 0; i < m_points.size(); ++i)
      for (std::size_t j = 0; j < m_unknowns; ++j) {
        const Point& p = m_points[i];
        const double g = p.weight * dot(slopes[i][j], residuals[i]);
        for (int a = 0; a < kTerms; ++a) gradient[j * kTerms + a] += g * p.powers[a];
        for (std::size_t k = 0; k < m_unknowns; ++k) {
          const double h = p.weight * dot(slopes[i][j], slopes[i][k]);
          for (int a = 0; a < kTerms; ++a)
            for (int b = 0; b < kTerms; ++b) normal[j * kTerms + a][k * kTerms + b] += h * p.powers[a] * p.powers[b];
        }
      }
  }

  // A x = b by Cholesky's decomposition; empty where A is not positive definite.
  static Vector solve(std::vector<Vector> A, Vector b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double s = A[i][j];
        for (std::size_t k = 0; k < j; ++k) s -= A[i][k] * A[j][k];
        if (i == j && !(s > 0)) return {};
        A[i][j] = i == j ? std::sqrt(s) : s / A[j][j];
      }
      for (std::size_t k = 0; k < i; ++k) b[i] -= A[i][k] * b[k];
      b[i] /= A[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t k = i + 1; k < n; ++k) b[i] -= A[k][i] * b[k];
      b[i] /= A[i][i];
    }
    return b;
  }

  Form m_form;
  std::size_t m_unknowns;
  Vector m_x;
  std::vector<Point> m_points;
  Vector m_scale = Vector(kHarmonics, 0.0);
  Cube m_cube;
  double m_damping = 1e-3;
};

void run(const char* name, Form form, const Vector& start) {
  Fit fit(form, start);
  for (int i = 0; i < 100 && fit.step(); ++i) {
  }
  fit.print(name);
}

} // namespace

int main() {
  std::printf("a row a polynomial in (1, NoV, NoV^2, roughness, roughness NoV, roughness^2)\n");
  run("stretched (lean, spread, mip)", Form::stretched, {1, 0.5, -0.4});
  run("two taps (lean, lean, mip, mip, weight)", Form::two, {1.6, 0.6, 0.1, -0.7, 0.5});
  run("three taps (lean x 3, mip x 3, weight, share of the rest)", Form::three,
      {1.8, 1, 0.5, 0.1, -0.3, -0.9, 0.33, 0.5});
}
