// One invocation a row: reads its inputs, calls the function that the specialization constant names, writes its outputs.
#include "shading/brdf.glsl"
#include "shading/capture.glsl"
#include "shading/env_brdf.glsl"
#include "shading/fog.glsl"
#include "shading/light.glsl"
#include "shading/lightmap.glsl"
#include "shading/material.glsl"
#include "shading/mips.glsl"
#include "shading/mobile_direct.glsl"
#include "shading/mobile_base_pass.glsl"
#include "shading/mobile_shadow.glsl"
#include "shading/off_specular.glsl"
#include "shading/refit.glsl"
#include "shading/rgbm.glsl"
#include "shading/sh.glsl"
#include "shading/tinted_sky.glsl"
#include "shading/sky_sh.glsl"
#include "shading/specular_aa.glsl"
#include "shading/target.glsl"

#include "function_ids.glsl"

#include "evaluate.glsl"
#include "evaluate_base_pass.glsl"
#include "evaluate_baked.glsl"

layout(constant_id = 0) const int kFunction = 0;
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer InputBuffer { float inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer OutputBuffer { float outputs[]; };
layout(push_constant) uniform Push { uint rows; };

void main() {
  uint row = gl_GlobalInvocationID.x;
  if (row >= rows) return;
  Inputs i;
  for (int k = 0; k < kInputs; ++k) i.x[k] = inputs[row * kInputs + k];
#ifdef PARITY_BAKED
  Outputs o = evaluateBaked(kFunction, i);
#elif defined(PARITY_BASE_PASS)
  Outputs o = evaluateBasePass(kFunction, i);
#else
  Outputs o = evaluate(kFunction, i);
#endif
  for (int k = 0; k < kOutputs; ++k) outputs[row * kOutputs + k] = o.y[k];
}
