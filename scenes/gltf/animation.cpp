// Animations of a glTF file, evaluated at one moment.
#include "scenes/gltf/animation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "scenes/gltf/file/accessor.h"
#include "scenes/gltf/variants.h"

namespace parity::scenes {
namespace {

// Where a moment lies among the keys: at key `before`, or by `fraction` on the way to the next.
struct Moment {
  std::size_t before = 0;
  double fraction = 0, span = 0; // span: seconds between the two
};

Moment findMoment(const AccessorView& input, const std::vector<float>& keys, double time) {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i] < 0 || (i > 0 && keys[i] <= keys[i - 1]))
      throw input.error(fmt::format("key {} is at {} s, expected increasing times from 0", i, keys[i]));
  // As the keys are, so that a key's own time is that key.
  const auto after = std::upper_bound(keys.begin(), keys.end(), static_cast<float>(time));
  if (after == keys.begin()) return {};
  const auto before = static_cast<std::size_t>(after - keys.begin()) - 1;
  if (after == keys.end()) return {before};
  const double span = static_cast<double>(*after) - keys[before];
  return {before, std::clamp((time - keys[before]) / span, 0.0, 1.0), span};
}

// One animated property; `width` numbers a key.
class AnimatedProperty {
public:
  AnimatedProperty(const GltfDocument& document, const tinygltf::AnimationSampler& source, const std::string& place,
                   std::size_t width)
      : m_width(width), m_isCubic(source.interpolation == "CUBICSPLINE"), m_isStep(source.interpolation == "STEP") {
    const AccessorView input(document, source.input, place + "/input");
    const AccessorView output(document, source.output, place + "/output");
    if (!input.isFloat() || input.componentCount() != 1) throw input.error("expected SCALAR of FLOAT");
    if (!output.isFloat() && !output.isNormalized()) throw output.error("expected FLOAT or normalized integers");
    const std::size_t numbers = input.count() + output.count() * static_cast<std::size_t>(output.componentCount());
    const MemoryCharge charge(document.memory, numbers * (sizeof(double) + sizeof(glm::vec4)), place);
    const std::vector<float> keys = input.readScalars();
    m_moment = findMoment(input, keys, document.options.timeSeconds);
    m_end = keys.back();
    const bool isScalar = output.componentCount() == 1; // weights, all targets of a key in a row
    const std::size_t perKey = (isScalar ? width : 1) * (m_isCubic ? 3 : 1);
    if (!isScalar && static_cast<std::size_t>(output.componentCount()) != width)
      throw output.error(fmt::format("has {} components, expected {}", output.componentCount(), width));
    if (output.count() != input.count() * perKey)
      throw output.error(fmt::format("has {} elements, expected {}, {} for each of {} keys", output.count(),
                                     input.count() * perKey, perKey, input.count()));
    if (isScalar) {
      const std::vector<float> values = output.readScalars();
      m_values.assign(values.begin(), values.end());
    } else
      for (const glm::vec4& value : output.readVec4(0.f))
        for (int c = 0; c < static_cast<int>(width); ++c) m_values.push_back(value[c]);
  }

  // part: 0 the tangent into the key, 1 its value, 2 the tangent out of it, of CUBICSPLINE.
  double at(std::size_t key, std::size_t part, std::size_t i) const {
    return m_values[(m_isCubic ? 3 * key + part : key) * m_width + i];
  }
  const Moment& moment() const { return m_moment; }
  double end() const { return m_end; } // time of the last key
  bool holdsStill() const { return m_isStep || m_moment.fraction == 0; }
  bool isCubic() const { return m_isCubic; }

  // The numbers at the moment, each by itself: linear, or a cubic Hermite spline (glTF 2.0, appendix C.5).
  std::vector<double> evaluate() const {
    std::vector<double> out(m_width);
    const auto [k, t, span] = m_moment;
    const double t2 = t * t, t3 = t2 * t;
    for (std::size_t i = 0; i < m_width; ++i)
      out[i] = holdsStill() ? at(k, 1, i)
               : m_isCubic  ? (2 * t3 - 3 * t2 + 1) * at(k, 1, i) + span * (t3 - 2 * t2 + t) * at(k, 2, i) +
                                 (3 * t2 - 2 * t3) * at(k + 1, 1, i) + span * (t3 - t2) * at(k + 1, 0, i)
                           : (1 - t) * at(k, 1, i) + t * at(k + 1, 1, i);
    return out;
  }

private:
  std::size_t m_width;
  bool m_isCubic, m_isStep;
  Moment m_moment;
  double m_end = 0;
  std::vector<double> m_values;
};

// Spherical between two keys, the shorter way round; a spline's result is made unit length.
glm::dquat evaluateRotation(const AnimatedProperty& sampler) {
  const auto key = [&](std::size_t k) {
    return glm::dquat(sampler.at(k, 1, 3), sampler.at(k, 1, 0), sampler.at(k, 1, 1), sampler.at(k, 1, 2));
  };
  if (!sampler.holdsStill() && !sampler.isCubic()) {
    const glm::dquat a = key(sampler.moment().before), b = key(sampler.moment().before + 1);
    if (!(glm::length(a) > 0 && glm::length(b) > 0)) return glm::dquat(0, 0, 0, 0);
    return glm::normalize(glm::slerp(glm::normalize(a), glm::normalize(b), sampler.moment().fraction));
  }
  const std::vector<double> value = sampler.evaluate();
  const glm::dquat rotation(value[3], value[0], value[1], value[2]);
  return glm::length(rotation) > 0 ? glm::normalize(rotation) : glm::dquat(0, 0, 0, 0);
}

// The animations to play, in order.
std::vector<std::size_t> chosenAnimations(const GltfDocument& document) {
  const std::string& wanted = document.options.animation;
  const std::vector<std::string>& names = document.facts.animations;
  if (wanted == kNoAnimation && std::find(names.begin(), names.end(), wanted) == names.end()) return {};
  if (!wanted.empty())
    return {findNamed(document.facts.animations, wanted, document.label, "--animation", "animation")};
  std::vector<std::size_t> all(document.model.animations.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

// Returns the time of its last key.
double applyChannel(const GltfDocument& document, const tinygltf::AnimationChannel& channel,
                    const tinygltf::AnimationSampler& source, const std::string& place, Pose& pose) {
  const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(channel.target_node)];
  const auto sample = [&](std::size_t width) { return AnimatedProperty(document, source, place, width); };
  if (channel.target_path == "weights") {
    const std::size_t targets =
        node.mesh < 0 ? 0
                      : document.model.meshes[static_cast<std::size_t>(node.mesh)].primitives.front().targets.size();
    if (targets == 0) throw document.error(place, "animates weights of a node whose mesh has no morph targets");
    const AnimatedProperty sampler = sample(targets);
    const std::vector<double> value = sampler.evaluate();
    pose[channel.target_node].weights.emplace(value.begin(), value.end());
    return sampler.end();
  }
  if (!node.matrix.empty())
    throw document.error(fmt::format("/nodes/{}/matrix", channel.target_node),
                         "is on an animated node, expected translation, rotation and scale");
  if (channel.target_path == "rotation") {
    const AnimatedProperty sampler = sample(4);
    const glm::dquat rotation = evaluateRotation(sampler);
    if (!(glm::length(rotation) > 0)) throw document.error(place, "is a rotation of length 0");
    pose[channel.target_node].rotation = rotation;
    return sampler.end();
  }
  const AnimatedProperty sampler = sample(3);
  const std::vector<double> value = sampler.evaluate();
  (channel.target_path == "scale" ? pose[channel.target_node].scale : pose[channel.target_node].translation) =
      glm::dvec3(value[0], value[1], value[2]);
  return sampler.end();
}

// Where the time that was asked for shows nothing of its own.
void warnOfTime(double time, const std::optional<double>& end, std::vector<std::string>& warnings) {
  if (time != 0 && !end)
    warnings.push_back(fmt::format("--time {:g} has no effect: no animation moves a visible object", time));
  else if (time < 0)
    warnings.push_back(fmt::format("--time {:g} shows the first pose, because animations begin at 0 s", time));
  else if (end && time > *end && static_cast<float>(time) > static_cast<float>(*end))
    warnings.push_back(fmt::format("--time {:g} shows the last pose, because the last key is at {:g} s", time, *end));
}

} // namespace

std::vector<double> animationLengths(const GltfDocument& document) {
  std::vector<double> lengths;
  for (const tinygltf::Animation& animation : document.model.animations) {
    double& length = lengths.emplace_back(0);
    for (const tinygltf::AnimationSampler& sampler : animation.samplers)
      if (const auto& most = document.model.accessors[static_cast<std::size_t>(sampler.input)].maxValues; !most.empty())
        length = std::max(length, most.front());
  }
  return lengths;
}

Pose poseAt(const GltfDocument& document, const std::function<bool(int)>& isNeeded, Problems& problems,
            std::vector<std::string>& warnings) {
  Pose pose;
  std::set<std::pair<int, std::string>> known; // properties of earlier animations
  std::size_t contradictions = 0;
  std::optional<double> end; // of all that is played
  for (const std::size_t a : chosenAnimations(document)) {
    const tinygltf::Animation& animation = document.model.animations[a];
    std::set<std::pair<int, std::string>> own;
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
      const tinygltf::AnimationChannel& channel = animation.channels[c];
      const std::string place = fmt::format("/animations/{}/channels/{}", a, c);
      constexpr std::array kPaths = {"translation", "rotation", "scale", "weights"};
      if (std::find(kPaths.begin(), kPaths.end(), channel.target_path) == kPaths.end()) { // an extension's
        warnings.push_back(place + ": does not animate a node, ignored");
        continue;
      }
      if (channel.target_node < 0 || !isNeeded(channel.target_node)) continue;
      const std::pair<int, std::string> property(channel.target_node, channel.target_path);
      if (known.contains(property)) {
        ++contradictions;
        continue;
      }
      problems.attempt([&] {
        if (!own.insert(property).second)
          throw document.error(place, fmt::format("animates the {} of /nodes/{}, as an earlier channel does",
                                                  property.second, property.first));
        const double last =
            applyChannel(document, channel, animation.samplers[static_cast<std::size_t>(channel.sampler)],
                         fmt::format("/animations/{}/samplers/{}", a, channel.sampler), pose);
        end = std::max(end.value_or(0), last);
      });
    }
    known.merge(own);
  }
  warnOfTime(document.options.timeSeconds, end, warnings);
  if (contradictions)
    warnings.push_back(
        fmt::format("{} channels of later animations are ignored: an earlier animation moves the same nodes "
                    "(--animation chooses one)",
                    contradictions));
  return pose;
}

} // namespace parity::scenes
