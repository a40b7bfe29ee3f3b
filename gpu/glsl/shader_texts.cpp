#include "gpu/glsl/glsl_compiler.h"
#include "gpu_texts/texts.h"

namespace parity::gpu {

const std::vector<ShaderText>& sharedShaderTexts() {
  static const std::vector<ShaderText> all(std::begin(kSharedShaderTexts), std::end(kSharedShaderTexts));
  return all;
}

} // namespace parity::gpu
