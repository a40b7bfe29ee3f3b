// The histogram's picture: what is drawn, and what is refused.
#include "compare/images/histogram_svg.h"

#include <limits>

#include <gtest/gtest.h>

#include "base/error.h"

namespace parity::compare {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(HistogramSvg, DrawsABarForEachFilledBucketAndNamesTheMarks) {
  const std::vector<double> buckets = {90, 0, 9, 1};
  const std::string svg = toSvg({"a <b>", "FLIP", buckets, {{"mean", 0.1}, {"p99", 0.75}}});
  EXPECT_EQ(count(svg, "<title>"), 3u);
  EXPECT_NE(svg.find("0.75 to 1: 1 %"), std::string::npos) << svg;
  EXPECT_NE(svg.find("mean 0.1000"), std::string::npos);
  EXPECT_NE(svg.find("a &lt;b&gt;"), std::string::npos) << "names are escaped";
  EXPECT_EQ(svg.find("<b>"), std::string::npos);
}

TEST(HistogramSvg, NoPixelsAreNoPicture) {
  const std::vector<double> none, zero = {0, 0}, bad = {1, std::numeric_limits<double>::quiet_NaN()};
  for (const auto& buckets : {none, zero, bad}) EXPECT_THROW(toSvg({"", "", buckets, {}}), base::Error);
}

} // namespace
} // namespace parity::compare
