// Four floats that the compiler keeps in one register, as it does not with glm's vectors.
#pragma once

namespace parity::lighting {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

} // namespace parity::lighting
