// Compute shaders in GLSL, compiled while the program runs, by glslang's library.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace parity::gpu {

// A text that #include finds, by the path that the directive names.
struct ShaderText {
  std::string_view path, text;
};

// shading/*.glsl and gpu/shaders/*, as this program was built from them.
const std::vector<ShaderText>& sharedShaderTexts();

// What #include of that path reads, and its name in messages. Nothing: the path may not be included.
struct IncludedText {
  std::string name, text;
};
using FindInclude = std::function<std::optional<IncludedText>(std::string_view path)>;

// SPIR-V for Vulkan 1.2, word for word what parity_shaders (cmake/ParityShaders.cmake) makes of the same text at build
// time. No file is read but by `find`. Throws Error (failed): the name of the text, "line N", and glslang's first
// reason.
std::vector<std::uint32_t> compileComputeShader(const std::string& text, const std::string& name,
                                                const FindInclude& find);

} // namespace parity::gpu
