// Small textures made by formula for the built-in scenes.
#include "scenes/builtin/generated_textures.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace parity::scenes {
namespace {

constexpr int kSize = 256;

std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  std::uint32_t state = (x + 0x9e3779b9u * (y + 0x85ebca6bu * seed)) * 747796405u + 2891336453u;
  state = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (state >> 22) ^ state;
}

float fade(float x) { return x * x * x * (x * (x * 6 - 15) + 10); }

// Long thin cells: 4 along u, 128 across.
float scratches(float u, float v) {
  return 0.6f * periodicNoise(u * 4, v * 128, 4, 128, 1) + 0.4f * periodicNoise(u * 8, v * 64, 8, 64, 2);
}

// Height of a plain weave, and which thread is on top (1: the one along u).
struct Weave {
  float height;
  bool alongU;
};
Weave weaveAt(float u, float v, int threads) {
  const float x = u * static_cast<float>(threads), y = v * static_cast<float>(threads);
  const float pi = glm::pi<float>();
  const auto profile = [&](float across, float along, float phase) {
    const float round = std::sqrt(std::max(0.f, 1 - std::pow(2 * (across - std::floor(across)) - 1, 2.f)));
    return 0.5f * round + 0.5f * std::cos(pi * (along + phase)) * 0.7f;
  };
  const float first = profile(y, x - 0.5f, std::floor(y));        // runs along u
  const float second = profile(x, y - 0.5f, std::floor(x) + 1.f); // runs along v
  return {std::max(first, second), first >= second};
}

} // namespace

TextureImage makeTexture(std::string name, int size, const std::function<glm::vec4(float, float)>& at) {
  TextureImage image{std::move(name), base::Image8(size, size, 4)};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float scale = 1.f / static_cast<float>(size);
      const glm::vec4 value = at((static_cast<float>(x) + 0.5f) * scale, (static_cast<float>(y) + 0.5f) * scale);
      for (int c = 0; c < 4; ++c)
        image.pixels.at(x, y)[c] = static_cast<std::uint8_t>(std::clamp(value[c], 0.f, 1.f) * 255.f + 0.5f);
    }
  return image;
}

TextureImage makeNormalMap(std::string name, int size, const std::function<float(float, float)>& height) {
  return makeTexture(std::move(name), size, [&](float u, float v) {
    const float step = 0.5f / static_cast<float>(size);
    const float du = (height(u + step, v) - height(u - step, v)) / (2 * step);
    const float dv = (height(u, v + step) - height(u, v - step)) / (2 * step);
    const glm::vec3 normal = glm::normalize(glm::vec3(-du, dv, 1.f)); // +Y is up, v runs down
    return glm::vec4(normal * 0.5f + 0.5f, 1.f);
  });
}

float periodicNoise(float x, float y, int periodX, int periodY, std::uint32_t seed) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto wrap = [](float cell, int period) {
    const int c = static_cast<int>(cell) % period;
    return static_cast<std::uint32_t>(c < 0 ? c + period : c);
  };
  const auto at = [&](float cx, float cy) {
    return static_cast<float>(hash(wrap(cx, periodX), wrap(cy, periodY), seed) >> 8) * (1.f / 16777216.f);
  };
  const float tx = fade(x - fx), ty = fade(y - fy);
  return glm::mix(glm::mix(at(fx, fy), at(fx + 1, fy), tx), glm::mix(at(fx, fy + 1), at(fx + 1, fy + 1), tx), ty);
}

TextureImage makeChecker(std::string name, int cells, const glm::vec3& even, const glm::vec3& odd) {
  return makeTexture(std::move(name), kSize, [&](float u, float v) {
    const int square =
        static_cast<int>(u * static_cast<float>(cells)) + static_cast<int>(v * static_cast<float>(cells));
    return glm::vec4(square % 2 ? odd : even, 1.f);
  });
}

TextureImage makeBrushedNormals(std::string name) {
  return makeNormalMap(std::move(name), kSize, [](float u, float v) { return 0.0012f * scratches(u, v); });
}

TextureImage makeBrushedRoughness(std::string name) {
  return makeTexture(std::move(name), kSize,
                     [](float u, float v) { return glm::vec4(1.f, 0.6f + 0.4f * scratches(u, v), 1.f, 1.f); });
}

TextureImage makeWovenNormals(std::string name, int threads) {
  const float amplitude = 0.35f / static_cast<float>(threads);
  return makeNormalMap(std::move(name), kSize,
                       [=](float u, float v) { return amplitude * weaveAt(u, v, threads).height; });
}

TextureImage makeWovenColor(std::string name, int threads, const glm::vec3& warp, const glm::vec3& weft) {
  return makeTexture(std::move(name), kSize, [&](float u, float v) {
    const Weave weave = weaveAt(u, v, threads);
    const float shade = 0.72f + 0.33f * std::clamp(weave.height, 0.f, 0.85f);
    return glm::vec4((weave.alongU ? warp : weft) * shade, 1.f);
  });
}

TextureImage makeHoles(std::string name, int cells) {
  return makeTexture(std::move(name), kSize, [=](float u, float v) {
    const float x = u * static_cast<float>(cells), y = v * static_cast<float>(cells);
    const float distance = glm::length(glm::vec2(x - std::floor(x) - 0.5f, y - std::floor(y) - 0.5f));
    return glm::vec4(1.f, 1.f, 1.f, glm::smoothstep(0.26f, 0.34f, distance));
  });
}

TextureImage makeLeaves(std::string name, int cells) {
  return makeTexture(std::move(name), kSize, [=](float u, float v) {
    const glm::vec2 at = glm::vec2(u, v) * static_cast<float>(cells), cell = glm::floor(at), p = at - cell - 0.5f;
    const auto seed = hash(static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y), 3);
    const float random = static_cast<float>(seed >> 8) * (1.f / 16777216.f), angle = glm::two_pi<float>() * random;
    const glm::vec2 along(std::cos(angle), std::sin(angle));
    const float x = glm::dot(p, along) / 0.5f, y = std::abs(glm::dot(p, glm::vec2(-along.y, along.x))) / 0.28f;
    const float inside = 1 - x * x - y; // between two parabolas
    const float shade = 0.8f + 0.4f * random + (y < 0.1f ? 0.25f : 0.f);
    return glm::vec4(glm::vec3(0.28f, 0.50f, 0.16f) * shade, glm::smoothstep(-0.1f, 0.1f, inside));
  });
}

} // namespace parity::scenes
