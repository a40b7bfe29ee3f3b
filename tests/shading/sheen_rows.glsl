// The sheen's functions, five numbers a row: sheen_device_test.cpp has the same in C++.
#include "shading/sheen.glsl"

layout(constant_id = 0) const int kUnused = 0;
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer InputBuffer { float inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer OutputBuffer { float outputs[]; };
layout(push_constant) uniform Push { uint rows; };

void main() {
  uint row = gl_GlobalInvocationID.x;
  if (row >= rows) return;
  real roughness = real(inputs[row * 4u]), NoV = real(inputs[row * 4u + 1u]);
  real NoL = real(inputs[row * 4u + 2u]), NoH = real(inputs[row * 4u + 3u]);
  real alpha = sheenAlpha(roughness);
  outputs[row * 5u] = float(D_Charlie(alpha, NoH));
  outputs[row * 5u + 1u] = float(charlieLambda(alpha, NoV));
  outputs[row * 5u + 2u] = float(V_Charlie(alpha, NoV, NoL));
  outputs[row * 5u + 3u] = float(V_Neubelt(NoV, NoL));
  outputs[row * 5u + 4u] = float(sheenAlbedoFit(roughness, NoV));
}
