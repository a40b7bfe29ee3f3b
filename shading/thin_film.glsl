// Fresnel's reflectance of a surface under a thin film (KHR_materials_iridescence).
#ifndef PARITY_SHADING_THIN_FILM
#define PARITY_SHADING_THIN_FILM

#include "shading/brdf.glsl"
#include "shading/real.glsl"

// cos(2 pi x), of any finite x: by its distance to the nearest integer, as Vulkan promises nothing for cos beyond
// [-pi, pi].
FN real cosOfTurns(real x) {
  PRECISE real rest = x - floor(x + R(0.5));
  PRECISE real angle = R(2.0) * kPi * rest;
  return cos(angle);
}

// How a reflectance that oscillates over the wavelength as cos(2 pi opd / wavelength + 2 pi turns) looks under an
// equal-energy light, as XYZ: Gaussian fits of the colour matching functions in Fourier space,
//   S = val sqrt(2 pi var) cos(pos phase + shift) exp(-var phase^2) / 1.0685e-7,  phase = 2 pi opd
// Belcour and Barla 2017, section 4; KHR_materials_iridescence prints val, pos and var. opd: optical path difference in
// micrometres, at least 0; turns: of X, Y and Z. In micrometres pos is 1e-6 of what is printed, the exponents are
// (2 pi)^2 log2(e) 1e-12 var, and nothing leaves the range of half. The path is cut at 64, where the colours have long
// vanished (exp2(-1e3)), so that its square stays finite in half.
FN real3 filmSensitivity(real opd, real3 turns) {
  PRECISE real d = min(opd, R(64.0));
  PRECISE real d2 = d * d;
  PRECISE real x1 = R(0.846590) * cosOfTurns(R(1.6810) * d + turns.x) * exp2(R(-0.246491) * d2);
  PRECISE real x2 = R(0.153868) * cosOfTurns(R(2.2399) * d + turns.x) * exp2(R(-0.257905) * d2);
  PRECISE real y = R(1.000222) * cosOfTurns(R(1.7953) * d + turns.y) * exp2(R(-0.529946) * d2);
  PRECISE real z = R(1.001122) * cosOfTurns(R(2.2084) * d + turns.z) * exp2(R(-0.376594) * d2);
  return real3(x1 + x2, y, z);
}

// XYZ to linear Rec.709 by its primaries and D65 (the matrix that KHR_materials_iridescence prints).
FN real3 xyzToRec709(real3 xyz) {
  PRECISE real3 rgb = real3(R(3.2404542) * xyz.x - R(1.5371385) * xyz.y - R(0.4985314) * xyz.z,
                            R(-0.9692660) * xyz.x + R(1.8760108) * xyz.y + R(0.0415560) * xyz.z,
                            R(0.0556434) * xyz.x - R(0.2040259) * xyz.y + R(1.0572252) * xyz.z);
  return rgb;
}

// How the base reflects light within the film.
struct FilmBase {
  real R23;   // reflectance from the film to the base
  real turns; // phase that both reflections inside the film add, in turns: 0, 1/2 or 1
};

// baseF0: reflectance of the base in air, which stands for its index n3 = (1 + s) / (1 - s), s = sqrt(baseF0). film: the
// film's index n2. cosFilm: the cosine within the film.
//   R1 = ((n3 - n2) / (n3 + n2))^2 = ((1 + s - n2 (1 - s)) / (1 + s + n2 (1 - s)))^2,
// which is finite at baseF0 = 1. A reflection at the higher index shifts by half a turn.
FN FilmBase filmBase(real film, real baseF0, real cosFilm) {
  PRECISE real s = sqrt(baseF0);
  PRECISE real low = film * (R(1.0) - s);
  PRECISE real difference = (R(1.0) + s) - low;
  PRECISE real r = difference / ((R(1.0) + s) + low);
  PRECISE real R1 = r * r;
  PRECISE real w = schlickWeight(cosFilm);
  FilmBase base;
  base.R23 = R1 * (R(1.0) - w) + w;
  base.turns = film < R(1.0) ? R(0.0) : R(0.5);
  if (difference < R(0.0)) base.turns = base.turns + R(0.5);
  return base;
}

// Airy's sum of one channel as orders of interference: x of the path-independent part, y and z of the first and second.
//   C0 = R12 + Rs,  Rs = T^2 R23 / (1 - R12 R23),  T = 1 - R12,  Cm = 2 (Rs - T) sqrt(R12 R23)^m
// Belcour and Barla 2017, sections 3 and 4. 1 - R12 R23 is written T + R12 (1 - R23), which does not cancel.
FN real3 airyOrders(real R12, real R23) {
  PRECISE real T = R(1.0) - R12;
  PRECISE real d = T + R12 * (R(1.0) - R23);
  PRECISE real share = T / max(d, kSmallest);
  PRECISE real Rs = T * share * R23;
  PRECISE real r = sqrt(R12 * R23);
  PRECISE real C1 = R(2.0) * (Rs - T) * r;
  PRECISE real C2 = C1 * r;
  return real3(R12 + Rs, C1, C2);
}

// The sum that thinFilmFresnel cuts to [0, 1], between air and the base, RGB:
//   F = C0 + C1 S(D) + C2 S(2 D),  D = 2 n2 thickness cos(theta2),  S: filmSensitivity as linear Rec.709
// Belcour and Barla 2017 as KHR_materials_iridescence, "Iridescence Fresnel", simplifies it: Schlick's curve for both
// interfaces, no polarisation, phases of 0 or pi, two orders. filmIor above 0; thicknessNm in nm, at least 0; baseF0 in
// [0, 1]; cosTheta (of the view and the microfacet) in [0, 1]. Total reflection (filmIor < 1) gives 1.
// Deviations from that text (and the cut at 1, below):
//   - Below 30 nm n2 runs to 1 by smoothstep and R12's F90 to 0 by its square, so that F ends in F_Schlick(baseF0).
//     Belcour and Barla's code does so with n2; Khronos' sample viewer counts its 0.03 in nm.
//   - R12 R23 is not cut to [1e-5, .9999] and baseF0 not shifted, as nothing here divides by 0.
// How far this is from the spectrum's integral, and half from this: docs/shading.md 12.
FN real3 thinFilmSum(real filmIor, real thicknessNm, real3 baseF0, real cosTheta) {
  PRECISE real x = saturate(thicknessNm / R(30.0));
  PRECISE real fade = x * x * (R(3.0) - R(2.0) * x);
  PRECISE real over = (filmIor - R(1.0)) * fade; // n2 - 1
  PRECISE real film = over + R(1.0);
  PRECISE real c2 = over * (film + R(1.0)) + cosTheta * cosTheta; // (n2 cos(theta2))^2, without cancelling
  if (c2 < R(0.0)) return real3(R(1.0), R(1.0), R(1.0));
  PRECISE real across = sqrt(c2);
  PRECISE real cosFilm = min(across / film, R(1.0));
  PRECISE real opd = thicknessNm * R(0.001) * (R(2.0) * across);
  PRECISE real r0 = over / (film + R(1.0));
  PRECISE real R0 = r0 * r0;
  PRECISE real w = schlickWeight(cosTheta);
  PRECISE real R12 = R0 * (R(1.0) - w) + fade * fade * w;

  FilmBase red = filmBase(film, baseF0.x, cosFilm);
  FilmBase green = filmBase(film, baseF0.y, cosFilm);
  FilmBase blue = filmBase(film, baseF0.z, cosFilm);
  // X, Y and Z take the phases of the red, green and blue base, as the text has it.
  PRECISE real3 turns = real3(red.turns, green.turns, blue.turns);
  PRECISE real3 turns2 = real3(R(2.0) * turns.x, R(2.0) * turns.y, R(2.0) * turns.z);
  PRECISE real opd2 = R(2.0) * opd;
  real3 first = xyzToRec709(filmSensitivity(opd, turns));
  real3 second = xyzToRec709(filmSensitivity(opd2, turns2));
  real3 ofRed = airyOrders(R12, red.R23);
  real3 ofGreen = airyOrders(R12, green.R23);
  real3 ofBlue = airyOrders(R12, blue.R23);
  PRECISE real3 F = real3(ofRed.x + ofRed.y * first.x + ofRed.z * second.x,
                          ofGreen.x + ofGreen.y * first.y + ofGreen.z * second.y,
                          ofBlue.x + ofBlue.y * first.z + ofBlue.z * second.z);
  return F;
}

// Fresnel's reflectance under a film: thinFilmSum, of whose oscillation two orders alone are known and whose colours may
// lie outside Rec.709, cut to [0, 1]. KHR_materials_iridescence cuts at 0 alone, which lets more light out than came in.
FN real3 thinFilmFresnel(real filmIor, real thicknessNm, real3 baseF0, real cosTheta) {
  return saturate(thinFilmSum(filmIor, thicknessNm, baseF0, cosTheta));
}

// Of a surface that a film covers in part: exactly bare at share 0 and film at share 1. share in [0, 1].
FN real3 iridescentFresnel(real3 bare, real3 film, real share) {
  PRECISE real rest = R(1.0) - share;
  PRECISE real3 F = real3(bare.x * rest + film.x * share, bare.y * rest + film.y * share, bare.z * rest + film.z * share);
  return F;
}

#endif
