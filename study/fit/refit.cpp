// All fits of the preset, one after the other (see refit.h).
#include "study/fit/refit.h"

#include "shading/shading.h"
#include "study/fit/refit_text.h"

namespace parity::fit {

namespace f64 = shading::f64;

Refit fitRefit(const Settings& settings, const Say& say) {
  Refit refit{};
  refit.settings = settings;
  say("fitting the specular lobe");
  const Truth truth(settings);
  refit.lobe = fitLobe(truth);
  refit.spread = roundConstant(truth.spread());
  say("projecting lobes of the environment");
  const TapFit taps(settings.geometryTerm);
  say("fitting the environment fetch");
  refit.tap = taps.fit();
  say("fitting the sheen");
  refit.sheen = fitSheen();
  say("measuring errors");
  refit.tapError = taps.errorOf([&](double R, double N) { return evaluateTap(refit.tap, R, N); });
  refit.mirrorError = taps.errorOf([](double R, double) { return Tap{1, f64::mipFromRoughness(R)}; });
  refit.dominantError = taps.errorOf([](double R, double) {
    return Tap{f64::dominantBlend(R * R), f64::mipFromRoughness(R)};
  });
  const LobeModel model = [&](double F0, double R, double N) {
    return evaluateLobe(refit.lobe, settings.compensation, F0, R, N);
  };
  refit.albedo = albedoErrors(truth, model);
  refit.direct = directError(truth, model);
  return refit;
}

} // namespace parity::fit
