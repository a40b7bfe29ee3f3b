// Small pictures for the tests of parity flip, and its JSON read back.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {

// A smooth RGB picture with detail, values of 0.2 to 0.8 times `gain`.
inline base::Image makePicture(int width, int height, float gain = 1) {
  base::Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] =
            gain * (0.5f + 0.3f * std::sin(0.7f * static_cast<float>(x + c) + 0.4f * static_cast<float>(y)));
  return image;
}

// The same with a change of each value.
inline base::Image changed(base::Image image, const std::function<float(float)>& change) {
  for (float& v : image.pixels) v = change(v);
  return image;
}

// Writes pictures into a folder of its own.
class FlipPictures : public FolderTest {
protected:
  std::string write(const std::string& name, const base::Image& image) const {
    base::writeImage(m_folder / name, image);
    return path(name);
  }
};

// parity flip ARGUMENTS --json -: its exit code is `code`. Null where it wrote no JSON.
inline nlohmann::json flipJson(const std::vector<std::string>& arguments, int code = 0) {
  const RunResult result = runParity(join({{"flip"}, arguments, {"--json", "-"}}));
  EXPECT_TRUE(exitedWith(code, result));
  const nlohmann::json json = nlohmann::json::parse(result.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << result.out;
  if (json.is_discarded()) return {};
  EXPECT_EQ(json["exitCode"], code) << "the JSON and the program disagree";
  return json;
}

// The figures of the first region of the first pair.
inline nlohmann::json firstFigures(const nlohmann::json& json) {
  return json["pairs"][0]["regions"][0]["figures"]["metrics"];
}

} // namespace parity::tests
