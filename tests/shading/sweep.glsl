// The mobile presets over their whole domain: each invocation shades kPointsOfRow points of a low-discrepancy sequence
// over roughness, N.V, N.L, azimuth, F0 and light, and says what went wrong in its row.
#include "shading/mobile_base_pass.glsl"

layout(constant_id = 0) const int kPreset = 0; // karis2014, ue4-2020, refit: in both enumerations; karis2014 with PhongApprox
const uint kPointsOfRow = 256u;
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer InputBuffer { float inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer OutputBuffer { float outputs[]; };
layout(push_constant) uniform Push { uint rows; };

struct SweepRow {
  uint notANumber, infinite, negative; // of the values
  float greatestRoughness;                 // of the points that had any that is not finite
  float leastRoughness, greatestF0;        // of those that had any negative one
};

// The R sequence of six dimensions (Roberts 2018): fractions of 2^32, exact in integers; now and then an end of the range.
float coordinate(uint index, uint step, uint salt) {
  uint x = index * step;
  uint pick = ((index ^ salt) * 2654435761u) >> 27; // 0..31
  if (pick == 0u) return 0.0;
  if (pick == 1u) return 1.0;
  return float(x >> 8) * exp2(-24.0);
}

const int kEnvironmentBrdf = kPreset == 3 ? kEnvironmentBrdfKaris2014 : kPreset;
const int kSun = kPreset == 3 ? kSunPhongApprox : kPreset;

void main() {
  uint row = gl_GlobalInvocationID.x;
  if (row >= rows) return;
  SweepRow found;
  found.notANumber = found.infinite = found.negative = 0u;
  found.greatestRoughness = found.greatestF0 = -1.0;
  found.leastRoughness = 2.0;
  for (uint k = 0u; k < kPointsOfRow; ++k) {
    uint index = row * kPointsOfRow + k;
    float roughness = coordinate(index, 3823231519u, 0x1u), NoV = coordinate(index, 3403264051u, 0x22u),
          NoL = coordinate(index, 3029428781u, 0x333u), azimuth = coordinate(index, 2696657321u, 0x4444u),
          F0 = coordinate(index, 2400439991u, 0x55555u), exponent = coordinate(index, 2136761237u, 0x666666u);
    if (kPreset == 1) roughness = max(roughness, 0.015625); // the floor is the preset's
    float light = exp2(19.93156857 * (2.0 * exponent - 1.0)); // 1e-6 to 1e6
    vec3 N = vec3(0.0, 0.0, 1.0), V = vec3(sqrt(1.0 - NoV * NoV), 0.0, NoV);
    float sine = sqrt(1.0 - NoL * NoL), phi = 6.283185307 * azimuth;
    vec3 L = azimuth == 0.0 && NoL == NoV ? vec3(-V.x, 0.0, V.z) : vec3(sine * cos(phi), sine * sin(phi), NoL);

    MobileMaterial m;
    m.BaseColor = real3(real(F0));
    m.Metallic = (index & 1u) == 0u ? R(1.0) : R(0.0); // a metal of that reflectance, or a dielectric
    m.DielectricSpecular = real3(real(F0));
    m.F90 = R(1.0);
    m.Roughness = real(roughness);
    MobileFrame frame = mobileFrame(N, V);
    MobileShadingModelContext c = initShadingModelContext(kEnvironmentBrdf, false, false, m, viewCosine(kEnvironmentBrdf, frame));
    MobileDirectLighting lighting = mobileIntegrateBxDF(kSun, false, c, frame, L);
    real3 lit = lightWith(vec3(light), lighting, R(1.0));
    real3 ibl = modulate(specularIBL(real3(real(min(light, 256.0))), R(1.0)), c.SpecularColor);
    // Both lobes before the store saturates, and what is stored: two such lights and the environment.
    vec3 values[4] = vec3[](vec3(lighting.Specular), vec3(lighting.Diffuse), vec3(c.SpecularColor), vec3(narrow(widen(lit + lit + ibl))));
    for (int i = 0; i < 4; ++i) {
      uint bits = floatBitsToUint(values[i].x);
      uint magnitude = bits & 0x7fffffffu;
      bool isNan = magnitude > 0x7f800000u, isInf = magnitude == 0x7f800000u, isNegative = !isNan && bits != magnitude && magnitude != 0u;
      if (isNan) ++found.notANumber;
      if (isInf) ++found.infinite;
      if (isNegative) ++found.negative;
      if (isNan || isInf) found.greatestRoughness = max(found.greatestRoughness, roughness);
      if (isNegative) {
        found.leastRoughness = min(found.leastRoughness, roughness);
        found.greatestF0 = max(found.greatestF0, F0);
      }
    }
  }
  outputs[row * 6u] = float(found.notANumber);
  outputs[row * 6u + 1u] = float(found.infinite);
  outputs[row * 6u + 2u] = float(found.negative);
  outputs[row * 6u + 3u] = found.greatestRoughness;
  outputs[row * 6u + 4u] = found.leastRoughness;
  outputs[row * 6u + 5u] = found.greatestF0;
}
