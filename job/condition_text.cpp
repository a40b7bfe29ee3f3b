#include "job/condition_text.h"

#include <fmt/ranges.h>

namespace parity::job {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

} // namespace

std::string valueText(const glm::vec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

std::string valueText(const std::vector<glm::vec3>& list) {
  std::vector<std::string> texts;
  for (const glm::vec3& each : list) texts.push_back(valueText(each));
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string valueText(const std::vector<std::string>& list) {
  std::vector<std::string> texts;
  for (const std::string& each : list) texts.push_back(quoted(each));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string quotedOr(const std::string& text, const char* none) { return text.empty() ? none : quoted(text); }

std::string listOr(const std::vector<std::string>& list, const char* none) {
  return list.empty() ? none : valueText(list);
}

std::string wordsOf(const std::vector<std::string>& list, const char* none) {
  return list.empty() ? none : fmt::format("{}", fmt::join(list, ", "));
}

std::string describePrecision(mobile::Precision asked, mobile::Precision taken) {
  const std::string& name = nameAt(mobile::precisionNames(), taken);
  return taken == asked ? name : name + ", as the device has no shaderFloat16";
}

std::string describeTarget(gpu::OutputTarget target) {
  return nameAt(gpu::outputTargetNames(), target) +
         (gpu::isDisplayed(target) ? ", as displayed: light above white is cut off" : "");
}

std::string describeTextures(base::TextureBlock block) {
  return block == base::TextureBlock::none
             ? "as they are"
             : fmt::format("{}, {:.2f} bits a texel", nameAt(base::textureBlockNames(), block),
                           base::bitsPerTexel(block));
}

} // namespace parity::job
