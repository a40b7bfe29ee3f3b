// Fits as shader constants and JSON (see refit_text.h).
#include "study/fit/refit_text.h"

#include <cstdlib>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace parity::fit {

namespace {

const char* nameOf(GeometryTerm term) {
  return term == GeometryTerm::heightCorrelated ? "height-correlated" : "schlick-smith";
}

const char* nameOf(FresnelCurve curve) {
  switch (curve) {
  case FresnelCurve::sphericalGaussian:
    return "spherical-gaussian";
  case FresnelCurve::dielectric:
    return "dielectric";
  default:
    return "schlick";
  }
}

const char* nameOf(Compensation compensation) {
  switch (compensation) {
  case Compensation::turquin:
    return "turquin";
  case Compensation::fdezAguera:
    return "fdez-aguera";
  case Compensation::kullaConty:
    return "kulla-conty";
  default:
    return "none";
  }
}

std::string number(double value) {
  std::string text = fmt::format("{:.6g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string arrayOf(Language language, const char* name, std::span<const double> values) {
  const std::size_t n = values.size();
  std::string list;
  for (std::size_t i = 0; i < n; ++i) list += (i > 0 ? ", " : "") + number(values[i]);
  if (language == Language::glsl) return fmt::format("const float {}[{}] = float[{}]({});\n", name, n, n, list);
  return fmt::format("static const float {}[{}] = {{{}}};\n", name, n, list);
}

std::string scalar(Language language, const char* name, double value) {
  return fmt::format("{} {} = {};\n", language == Language::glsl ? "const float" : "static const float", name,
                     number(value));
}

// What multiple scattering and visibility are, in words for a comment.
std::string describeDirect(const Settings& settings) {
  const bool correlated = settings.geometryTerm == GeometryTerm::heightCorrelated;
  std::string text = fmt::format("pi D V F NoL, D: GGX, V: {} Smith, F: {}",
                                 correlated ? "height-correlated" : "Schlick's", nameOf(settings.fresnel));
  if (settings.compensation == Compensation::turquin) return text + ", all times (S + M) / S";
  if (settings.compensation == Compensation::none) return text;
  return text + "; plus M (g + 1.5 (1 - g) NoL) NoL";
}

} // namespace

double roundConstant(double value) { return std::strtod(number(value).c_str(), nullptr); }

std::string formatShader(const Refit& r, Language language) {
  const bool compensated = r.settings.compensation != Compensation::none;
  std::string text =
      fmt::format("// Specular lobe of the mobile preset refit, fitted to: geometry term {}, Fresnel {}, "
                  "compensation {}.\n",
                  nameOf(r.settings.geometryTerm), nameOf(r.settings.fresnel), nameOf(r.settings.compensation));
  text +=
      "// R: roughness in [0, 1], N: NoV in [0, 1], alpha = max(R^2, 2^-12), b, w, d, m, s: the constants in order.\n"
      "//   B = exp2(R (b0 + R (b1 + b2 R)) + N (b3 + R (b4 + b5 R) + b6 N))\n"
      "//   loss = N / (w0 + t (w1 + w2 t)), t = N / alpha\n"
      "//   S = F0 (1 - loss) + (F90 - F0) B                        scattered once\n";
  text += compensated ? "//   M = loss F0^2 (1 - k alpha (F90 - F0))                  scattered more than once\n"
                      : "//   M = 0\n";
  text += "//   environment: fetch along R + lean N at mip, times (1 - wide) S; irradiance / pi times wide S + M\n"
          "//   lean = alpha (d0 + d1 N), mip = m0 + m1 log2(alpha) + m2 N of 6 mips\n"
          "//   wide = clamp(s0 alpha + s1 + s2 N, 0, 1)\n"
          "//   diffuse colour times 1 - (S + M)\n";
  text += fmt::format("//   light: {}\n//\n", describeDirect(r.settings));
  text += "// Error of S + M, NoV in [1/256, 1], roughness in [1/64, 1]:\n";
  for (const AlbedoError& row : r.albedo)
    text += fmt::format("//   F0 {:<13} rms {:.4f}  max {:.4f}\n", row.F0, row.rms, row.max);
  text +=
      fmt::format("// Direct light at F0 = 1: rms log ratio {:.4f}, range {:.3f} to {:.3f}, exitance at most {:.3f}\n",
                  r.direct.rmsLogRatio, r.direct.least, r.direct.most, r.direct.exitanceMax);
  text += fmt::format(
      "// Environment, a lamp as displayed: error {:.3f} (one read in the mirror direction {:.3f}, dominant {:.3f})\n",
      r.tapError, r.mirrorError, r.dominantError);
  text += fmt::format("// Sheen (Charlie, Estevez and Kulla 2017), c: the constants in order, r = max(sheen roughness, "
                      "0.07), u = 1 / r:\n"
                      "//   albedo = min(exp2(c0 + c1 u + c2 r + c3 r^2 + sqrt(N) (c4 u^2 + c5 u + c6 r)\n"
                      "//                     + N (c7 u + c8 u^2) + c9 N^2 u^2), 1)\n"
                      "// Error of it, N in [0.02, 1], r in [0.07, 1]: rms {:.4f}  max {:.4f}\n",
                      r.sheen.rms, r.sheen.max);
  text += arrayOf(language, "kRefitB", r.lobe.B) + arrayOf(language, "kRefitLoss", r.lobe.loss);
  if (compensated) text += scalar(language, "kRefitReturn", r.lobe.k);
  if (r.spread != 0) text += scalar(language, "kRefitSpread", r.spread);
  return text + arrayOf(language, "kRefitLean", r.tap.lean) + arrayOf(language, "kRefitMip", r.tap.mip) +
         arrayOf(language, "kRefitWide", r.tap.wide) + arrayOf(language, "kRefitSheen", r.sheen.constants);
}

std::string formatJson(const Refit& r) {
  nlohmann::ordered_json albedo = nlohmann::ordered_json::array();
  for (const AlbedoError& row : r.albedo) albedo.push_back({{"F0", row.F0}, {"rms", row.rms}, {"max", row.max}});
  const nlohmann::ordered_json all = {
      {"settings",
       {{"geometryTerm", nameOf(r.settings.geometryTerm)},
        {"fresnel", nameOf(r.settings.fresnel)},
        {"compensation", nameOf(r.settings.compensation)}}},
      {"constants",
       {{"B", r.lobe.B},
        {"loss", r.lobe.loss},
        {"return", r.lobe.k},
        {"spread", r.spread},
        {"lean", r.tap.lean},
        {"mip", r.tap.mip},
        {"wide", r.tap.wide},
        {"sheen", r.sheen.constants}}},
      {"errors",
       {{"albedo", albedo},
        {"direct",
         {{"rmsLogRatio", r.direct.rmsLogRatio},
          {"least", r.direct.least},
          {"most", r.direct.most},
          {"exitanceMax", r.direct.exitanceMax}}},
        {"sheen", {{"rms", r.sheen.rms}, {"max", r.sheen.max}}},
        {"read", {{"error", r.tapError}, {"mirror", r.mirrorError}, {"dominant", r.dominantError}}}}}};
  return all.dump(2) + "\n";
}

} // namespace parity::fit
