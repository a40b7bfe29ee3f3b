// Attribution by terms against hand-made pictures: the term that was changed explains all, no other anything.
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "compare/attribution.h"
#include "compare/measure.h"
#include "error_code.h"
#include "random_images.h"
#include "shading/terms.h"

namespace parity::compare {
namespace {

using shading::Term;
constexpr int kWidth = 96, kHeight = 80;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Clamped, no curve.
ShownPicture show(const base::Image& linear, const Rect& = {}) {
  ShownPicture shown{base::Image8(linear.width, linear.height, 3), {}};
  for (std::size_t p = 0; p < linear.pixelCount(); ++p) {
    const float* rgb = &linear.pixels[3 * p];
    if (std::all_of(rgb, rgb + 3, [](float v) { return std::isfinite(v); }))
      for (std::size_t c = 0; c < 3; ++c)
        shown.pixels.pixels[3 * p + c] = static_cast<std::uint8_t>(std::clamp(rgb[c], 0.f, 1.f) * 255 + 0.5f);
    else
      shown.nonFinite.push_back(static_cast<std::uint32_t>(p));
  }
  return shown;
}

// Terms of whole 256ths, so that their sums are exact: a fade, noise, and nothing else.
base::Frame makeFrame() {
  base::Frame frame;
  frame.terms.assign(shading::kTermCount, base::Image(kWidth, kHeight, 3));
  unsigned seed = 7;
  for (const Term term : {Term::sunSpecular, Term::skyDiffuse, Term::skySpecular}) {
    base::Image& image = frame.terms[static_cast<std::size_t>(term)];
    image = test::makeImage(test::Kind::smooth, kWidth, kHeight, seed++);
    for (float& v : image.pixels) v = std::round(v * 85) / 256;
  }
  return frame;
}

// The colour from the terms, as a path makes it.
base::Frame withColor(base::Frame frame) {
  frame.color = base::Image(kWidth, kHeight, 3);
  for (const base::Image& term : frame.terms)
    for (std::size_t i = 0; i < term.pixels.size(); ++i) frame.color.pixels[i] += term.pixels[i];
  return frame;
}

base::Image& termOf(base::Frame& frame, Term term) { return frame.terms[static_cast<std::size_t>(term)]; }

// What a fault in mobile's shader does to a term.
void scaleTerm(base::Frame& frame, Term term, float scale) {
  for (float& v : termOf(frame, term).pixels) v *= scale;
}

base::PixelList box(const char* name, int x0, int y0, int x1, int y1) {
  base::PixelList list{name, {}, {}};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) list.pixels.push_back(static_cast<std::uint32_t>(y * kWidth + x));
  return list;
}

std::vector<std::optional<Attribution>> attribute(const base::Frame& reference, const base::Frame& test,
                                                  const std::vector<base::PixelList>& lists) {
  const ShownPicture a = show(reference.color), b = show(test.color);
  std::vector<const base::PixelList*> pointers;
  for (const base::PixelList& list : lists) pointers.push_back(&list);
  return attributeTerms({a.pixels, b.pixels, a.nonFinite, b.nonFinite, test.color, reference.terms, test.terms},
                        pointers, show);
}

Attribution attributeOne(const base::Frame& reference, const base::Frame& test, const base::PixelList& list) {
  const auto results = attribute(reference, test, {list});
  EXPECT_TRUE(results.at(0));
  return results[0].value_or(Attribution{});
}

// The same by the way that the report's figures go, over the whole picture.
double measure(const base::Image& reference, const base::Image& test, const base::PixelList& list, bool interior) {
  const ShownPicture a = show(reference), b = show(test);
  std::vector<std::uint32_t> invalid = a.nonFinite;
  invalid.insert(invalid.end(), b.nonFinite.begin(), b.nonFinite.end());
  const RegionFigures figures =
      measureRegions({a.pixels, b.pixels, nullptr, nullptr, invalid}, {list}, {.metrics = {"flip"}}).regions[0];
  return (interior ? figures.interior : figures.all).find("flip.mean").value();
}

TEST(Attribution, theOneTermThatDiffersExplainsAll) {
  const base::Frame reference = withColor(makeFrame());
  base::Frame test = makeFrame();
  scaleTerm(test, Term::skySpecular, 0.5f);
  const Attribution found = attributeOne(reference, withColor(test), box("m", 8, 8, 80, 70));
  EXPECT_EQ(found.region, "interior");
  EXPECT_GT(found.flip, 0.05);
  ASSERT_EQ(found.terms.size(), 1u) << "terms that are the same in both are not named";
  EXPECT_EQ(found.terms[0].term, "skySpecular");
  EXPECT_EQ(found.terms[0].flip, 0);
}

TEST(Attribution, termThatDiffersOnlyElsewhereIsNotNamed) {
  const base::Frame reference = withColor(makeFrame());
  base::Frame test = makeFrame();
  scaleTerm(test, Term::skySpecular, 0.5f);
  // A fault of another term far to the right: in this material's own figures it changes nothing.
  const auto [left, right] = std::pair(box("left", 0, 0, 40, kHeight), box("right", 60, 0, kWidth, kHeight));
  for (const std::uint32_t p : right.pixels) termOf(test, Term::sunSpecular).pixels[3 * std::size_t{p}] += 0.25f;
  const auto found = attribute(reference, withColor(test), {left, right});
  ASSERT_TRUE(found[0] && found[1]);
  ASSERT_EQ(found[0]->terms.size(), 1u);
  EXPECT_EQ(found[0]->terms[0].flip, 0);
  ASSERT_EQ(found[1]->terms.size(), 2u);
  EXPECT_EQ(found[1]->terms[0].term, "sunSpecular");
  EXPECT_EQ(found[1]->terms[1].term, "skySpecular");
  EXPECT_GT(found[1]->terms[0].flip, 0);
  EXPECT_GT(found[1]->terms[1].flip, 0);
}

TEST(Attribution, swappingChangesNothingWhereTheTermsAreTheSame) {
  const base::Frame reference = withColor(makeFrame());
  base::Frame test = makeFrame();
  scaleTerm(test, Term::skySpecular, 0.5f);
  base::PixelList list = box("m", 8, 8, 80, 60);
  list.pixels.push_back(78 * kWidth + 90); // alone, out of the interior's reach: there alone the term differs
  termOf(test, Term::sunSpecular).at(90, 78)[0] += 0.5f;
  const Attribution found = attributeOne(reference, withColor(test), list);
  ASSERT_EQ(found.terms.size(), 2u);
  EXPECT_EQ(found.terms[0].term, "sunSpecular");
  EXPECT_EQ(found.terms[0].flip, found.flip);
}

TEST(Attribution, figuresAreThoseOfMeasureRegionsOnAHandMadePicture) {
  const base::Frame reference = withColor(makeFrame());
  base::Frame test = makeFrame();
  scaleTerm(test, Term::skySpecular, 0.5f);
  scaleTerm(test, Term::skyDiffuse, 1.25f);
  scaleTerm(test, Term::sunSpecular, -3); // what is left without it is no light: nothing clamps it too early
  test = withColor(test);
  base::PixelList weighted = box("weighted", 30, 20, 90, 60);
  for (std::size_t i = 0; i < weighted.pixels.size(); ++i)
    weighted.weights.push_back(0.25f + 0.5f * static_cast<float>(i % 2));
  const base::PixelList thin = box("thin", 70, 66, 90, 69), corner = box("corner", 0, 0, 40, 30);
  const std::vector<base::PixelList> lists = {weighted, thin, corner};
  const auto found = attribute(reference, test, lists);
  for (std::size_t i = 0; i < lists.size(); ++i) {
    ASSERT_TRUE(found[i]);
    const bool interior = i != 1;
    EXPECT_EQ(found[i]->region, interior ? "interior" : "all");
    EXPECT_EQ(found[i]->flip, measure(reference.color, test.color, lists[i], interior)) << lists[i].name;
    ASSERT_EQ(found[i]->terms.size(), 3u);
    for (const TermEffect& effect : found[i]->terms) {
      const auto term = static_cast<std::size_t>(shading::termByName(effect.term).value());
      base::Image swapped = test.color;
      for (std::size_t k = 0; k < swapped.pixels.size(); ++k)
        swapped.pixels[k] += reference.terms[term].pixels[k] - test.terms[term].pixels[k];
      EXPECT_EQ(effect.flip, measure(reference.color, swapped, lists[i], interior))
          << lists[i].name << " " << effect.term;
    }
  }
}

TEST(Attribution, nonFinitePixelsCountAsTheWorstValueAndNoFigureIsNan) {
  const base::Frame reference = withColor(makeFrame());
  base::Frame test = makeFrame();
  scaleTerm(test, Term::skyDiffuse, 0.75f);
  termOf(test, Term::skySpecular).at(40, 40)[1] = kNan;
  termOf(test, Term::sunSpecular).at(44, 40)[1] = std::numeric_limits<float>::infinity();
  test = withColor(test);
  const base::PixelList list = box("m", 8, 8, 80, 70);
  const Attribution found = attributeOne(reference, test, list);
  EXPECT_EQ(found.flip, measure(reference.color, test.color, list, true));
  ASSERT_EQ(found.terms.size(), 3u);
  // The truth: the sum of terms, with that term of the high-end path.
  const auto swapBySum = [&](const base::Frame& frame, Term term) {
    base::Frame swapped = frame;
    termOf(swapped, term) = reference.terms[static_cast<std::size_t>(term)];
    return withColor(std::move(swapped)).color;
  };
  for (const TermEffect& effect : found.terms) {
    const Term term = shading::termByName(effect.term).value();
    EXPECT_EQ(effect.flip, measure(reference.color, swapBySum(test, term), list, true)) << effect.term;
    EXPECT_LT(effect.flip, found.flip) << effect.term << " is wrong somewhere";
    EXPECT_GT(effect.flip, 0) << effect.term << " is not all that is wrong";
  }

  // A term of the high-end path that is not finite spoils the picture that takes it over, and that one alone.
  base::Frame broken = withColor(makeFrame());
  termOf(broken, Term::skySpecular).at(40, 40)[0] = kNan; // of the term, not of the colour
  base::Frame dark = makeFrame();
  scaleTerm(dark, Term::skyDiffuse, 0.75f);
  const Attribution spoilt = attributeOne(broken, withColor(dark), list);
  ASSERT_EQ(spoilt.terms.size(), 2u);
  EXPECT_EQ(spoilt.terms[0].flip, 0);
  EXPECT_GT(spoilt.terms[1].flip, spoilt.flip);

  // Where the high-end colour is no number nothing helps.
  const base::Frame lost = withColor(broken), same = withColor(dark);
  const Attribution hopeless = attributeOne(lost, same, list);
  EXPECT_EQ(hopeless.flip, measure(lost.color, same.color, list, true));
  const base::Image helped = withColor(makeFrame()).color; // all but that pixel
  EXPECT_EQ(hopeless.terms.at(0).flip, measure(lost.color, helped, list, true));
  EXPECT_GE(hopeless.terms.at(0).flip, 1 / (52. * 42)) << "of the interior that pixel";
}

TEST(Attribution, materialWithoutPixelsHasNoneAndThinOnesGoByAllPixels) {
  const base::Frame reference = withColor(makeFrame());
  base::Frame test = makeFrame();
  scaleTerm(test, Term::skySpecular, 0.5f);
  base::PixelList weightless = box("weightless", 4, 4, 6, 6);
  weightless.weights.assign(4, 0.f);
  const auto found =
      attribute(reference, withColor(test), {{"empty", {}, {}}, weightless, box("thin", 50, 10, 55, 12)});
  EXPECT_FALSE(found[0]);
  EXPECT_FALSE(found[1]);
  ASSERT_TRUE(found[2]);
  EXPECT_EQ(found[2]->region, "all");
  EXPECT_GT(found[2]->flip, 0);
  EXPECT_EQ(found[2]->terms.at(0).flip, 0);
  EXPECT_TRUE(attribute(reference, reference, {}).empty());
}

TEST(Attribution, resultDoesNotDependOnTheThreads) {
  const base::Frame reference = withColor(makeFrame());
  base::Frame test = makeFrame();
  scaleTerm(test, Term::skySpecular, 0.7f);
  scaleTerm(test, Term::sunSpecular, 1.3f);
  const std::vector<base::PixelList> lists = {box("a", 0, 0, 40, 70), box("b", 40, 0, 96, 80)};
  const auto run = [&](int threads) {
    const base::ThreadLimit limit(threads);
    std::vector<double> flips;
    for (const auto& each : attribute(reference, withColor(test), lists)) {
      flips.push_back(each.value().flip);
      for (const TermEffect& effect : each->terms) flips.push_back(effect.flip);
    }
    return flips;
  };
  EXPECT_EQ(run(1), run(2));
  EXPECT_EQ(run(1).size(), 6u);
}

TEST(Attribution, picturesThatDoNotFitAreRefused) {
  const base::Frame reference = withColor(makeFrame()), test = withColor(makeFrame());
  const ShownPicture shown = show(reference.color), other = show(base::Image(8, 8, 3));
  const base::PixelList list = box("m", 8, 8, 80, 70), outside{"outside", {kWidth * kHeight}, {}};
  const base::PixelList *lists[] = {&list}, *malformed[] = {&outside};
  const std::vector<base::Image> none;
  const auto run = [&](const base::Image8& picture, const std::vector<base::Image>& terms, auto& materials) {
    return test::codeOf([&] {
      attributeTerms({shown.pixels, picture, {}, {}, test.color, reference.terms, terms}, materials, show);
    });
  };
  EXPECT_EQ(run(shown.pixels, test.terms, lists), base::ExitCode::withinBudget);
  EXPECT_EQ(run(other.pixels, test.terms, lists), base::ExitCode::notComparable);
  EXPECT_EQ(run(shown.pixels, none, lists), base::ExitCode::notComparable);
  EXPECT_EQ(run(shown.pixels, test.terms, malformed), base::ExitCode::failed);
}

} // namespace
} // namespace parity::compare
