// The functions of anisotropy and films, eight numbers a row: lobes_device_test.cpp has the same in C++.
#include "shading/anisotropic_brdf.glsl"
#include "shading/thin_film.glsl"

layout(constant_id = 0) const int kUnused = 0;
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer InputBuffer { float inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer OutputBuffer { float outputs[]; };
layout(push_constant) uniform Push { uint rows; };

void main() {
  uint row = gl_GlobalInvocationID.x;
  if (row >= rows) return;
  uint at = row * 12u;
  real alphaB = real(inputs[at]), alphaT = anisotropicAlpha(alphaB, real(inputs[at + 1u]));
  real ToV = real(inputs[at + 2u]), BoV = real(inputs[at + 3u]), NoV = real(inputs[at + 4u]);
  real ToL = real(inputs[at + 5u]), BoL = real(inputs[at + 6u]), NoL = real(inputs[at + 7u]);
  real alphaV = projectedAlpha(alphaT, alphaB, ToV, BoV);
  real3 film = thinFilmFresnel(real(inputs[at + 8u]), real(inputs[at + 9u]), real3(real(inputs[at + 10u])),
                               real(inputs[at + 11u]));
  outputs[row * 8u] = float(alphaT);
  outputs[row * 8u + 1u] = float(D_GGXAnisotropic(alphaT, alphaB, ToL, BoL, NoL));
  outputs[row * 8u + 2u] = float(V_SmithGGXAnisotropic(alphaT, alphaB, ToV, BoV, NoV, ToL, BoL, NoL) * NoL);
  outputs[row * 8u + 3u] = float(alphaV);
  outputs[row * 8u + 4u] = float(V_SchlickSmithAnisotropic(alphaV, alphaT, NoV, NoL) * NoL);
  outputs[row * 8u + 5u] = float(film.x);
  outputs[row * 8u + 6u] = float(film.y);
  outputs[row * 8u + 7u] = float(film.z);
}
