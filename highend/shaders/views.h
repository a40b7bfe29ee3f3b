// What a pass of the high-end path can show besides the lit picture; C++ and GLSL (highend/views.h has their names).
#ifndef PARITY_HIGHEND_SHADERS_VIEWS_H
#define PARITY_HIGHEND_SHADERS_VIEWS_H

#ifdef __cplusplus
namespace parity::highend {
#define PARITY_CONST inline constexpr unsigned
#else
#define PARITY_CONST const uint
#endif

PARITY_CONST kViewLit = 0u;
PARITY_CONST kViewEnvBrdfA = 1u;
PARITY_CONST kViewEnvBrdfB = 2u;
PARITY_CONST kViewEnvBrdf = 3u;
PARITY_CONST kViewEnvBrdfMultiple = 4u;
PARITY_CONST kViewSpecularIBL = 5u;
PARITY_CONST kViewCount = 6u;

#ifdef __cplusplus
} // namespace parity::highend
#endif
#undef PARITY_CONST
#endif
