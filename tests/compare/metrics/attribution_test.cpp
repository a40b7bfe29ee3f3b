// Attribution by terms against hand-made swaps: the term that was changed explains all, no other anything.
#include <algorithm>

#include <gtest/gtest.h>

#include "base/gathered.h"
#include "base/parallel.h"
#include "compare/flip/random_images.h"
#include "compare/metrics/attribution.h"
#include "compare/metrics/measure.h"
#include "error_code.h"

namespace parity::compare {
namespace {

constexpr int kAttributedWidth = 96, kAttributedHeight = 80;

// A picture of the view as displayed.
base::Image8 makePicture(test::Kind kind, unsigned seed) {
  const base::Image image = test::makeImage(kind, kAttributedWidth, kAttributedHeight, seed);
  base::Image8 out(kAttributedWidth, kAttributedHeight, 3);
  std::ranges::transform(image.pixels, out.pixels.begin(),
                         [](float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.f, 1.f) * 255 + 0.5f); });
  return out;
}

base::PixelList box(const char* name, int x0, int y0, int x1, int y1) {
  base::PixelList list{name, {}, {}};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) list.pixels.push_back(static_cast<std::uint32_t>(y * kAttributedWidth + x));
  return list;
}

// The material of that list with this picture's colours.
Swap swapOf(const base::PixelList& list, const base::Image8& picture, std::vector<std::uint32_t> nonFinite = {}) {
  Swap swap{&list, base::makeGathered<std::uint8_t>(list.pixels.size(), 3), {}, std::move(nonFinite)};
  for (std::size_t i = 0; i < list.pixels.size(); ++i)
    std::copy_n(&picture.pixels[3 * std::size_t{list.pixels[i]}], 3, &swap.displayed.pixels[3 * i]);
  return swap;
}

// Mean FLIP by the way that pictures go: the reference against itself with the swap's colours, all of it filtered.
double measure(const base::Image8& reference, const Swap& swap, std::vector<std::uint32_t> invalid = {}) {
  base::Image8 picture = reference;
  for (std::size_t i = 0; i < swap.list->pixels.size(); ++i)
    std::copy_n(&swap.displayed.pixels[3 * i], 3, &picture.pixels[3 * std::size_t{swap.list->pixels[i]}]);
  for (const std::uint32_t place : swap.nonFinite) invalid.push_back(swap.list->pixels[place]);
  return measureRegions({reference, picture, nullptr, nullptr, invalid}, {*swap.list}, {.metrics = {"flip"}})
      .regions[0]
      .find("flip.mean")
      .value();
}

// Mobile's picture and those with a term of high-end's each.
struct AttributedPictures {
  base::Image8 reference = makePicture(test::Kind::smooth, 1), mobile = makePicture(test::Kind::noise, 2),
               sun = makePicture(test::Kind::noise8, 3), sky = makePicture(test::Kind::halves, 4);

  AttributionInput of(const base::PixelList& list) const {
    return {swapOf(list, mobile), {{"sunSpecular", swapOf(list, sun)}, {"skySpecular", swapOf(list, sky)}}};
  }
};

TEST(Attribution, TheTermThatMakesThePictureTheReferenceExplainsAll) {
  const AttributedPictures pictures;
  const base::PixelList list = box("m", 8, 8, 80, 70);
  const AttributionInput input{swapOf(list, pictures.mobile), {{"skySpecular", swapOf(list, pictures.reference)}}};
  const auto found = attributeTerms({pictures.reference}, {&input, 1});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(found[0].flip, 0.05);
  ASSERT_EQ(found[0].terms.size(), 1u) << "the terms that were given, and no other";
  EXPECT_EQ(found[0].terms[0].term, "skySpecular");
  EXPECT_EQ(found[0].terms[0].flip, 0);
}

TEST(Attribution, TheTermThatChangesNothingExplainsNothing) {
  const AttributedPictures pictures;
  const base::PixelList list = box("m", 8, 8, 80, 60);
  const AttributionInput input{swapOf(list, pictures.mobile), {{"fog", swapOf(list, pictures.mobile)}}};
  const auto found = attributeTerms({pictures.reference}, {&input, 1});
  EXPECT_EQ(found[0].terms.at(0).flip, found[0].flip);
}

TEST(Attribution, FiguresAreThoseOfPicturesInWhichTheOneMaterialIsSwapped) {
  const AttributedPictures pictures;
  base::PixelList weighted = box("weighted", 30, 20, 90, 60);
  for (std::size_t i = 0; i < weighted.pixels.size(); ++i)
    weighted.weights.push_back(0.25f + 0.5f * static_cast<float>(i % 2));
  const base::PixelList thin = box("thin", 70, 66, 90, 69), corner = box("corner", 0, 0, 40, 30);
  const base::PixelList* lists[] = {&weighted, &thin, &corner};
  std::vector<AttributionInput> inputs;
  for (const base::PixelList* list : lists) inputs.push_back(pictures.of(*list));
  inputs[1].terms.erase(inputs[1].terms.begin()); // the same in both paths there
  inputs[2].terms.push_back(inputs[2].terms[0]);  // another one
  inputs[2].terms[2].term = "emissive";
  inputs[2].terms[2].swap = swapOf(corner, pictures.reference);
  const auto found = attributeTerms({pictures.reference}, inputs);
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    EXPECT_NEAR(found[i].flip, measure(pictures.reference, inputs[i].swap), 1e-9) << lists[i]->name;
    ASSERT_EQ(found[i].terms.size(), inputs[i].terms.size());
    for (std::size_t t = 0; t < inputs[i].terms.size(); ++t) {
      EXPECT_EQ(found[i].terms[t].term, inputs[i].terms[t].term) << "in their order";
      EXPECT_NEAR(found[i].terms[t].flip, measure(pictures.reference, inputs[i].terms[t].swap), 1e-9)
          << lists[i]->name << " " << inputs[i].terms[t].term;
    }
  }
  EXPECT_EQ(found[2].terms[2].flip, 0);
}

// What another material's terms are is not seen: each is swapped alone.
TEST(Attribution, ANeighbourChangesNothing) {
  const AttributedPictures pictures;
  const base::PixelList left = box("left", 0, 0, 40, kAttributedHeight),
                        right = box("right", 40, 0, kAttributedWidth, kAttributedHeight);
  const AttributionInput both[] = {pictures.of(left), pictures.of(right)};
  const auto together = attributeTerms({pictures.reference}, both),
             alone = attributeTerms({pictures.reference}, {both, 1});
  EXPECT_EQ(together[0].flip, alone[0].flip);
  for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(together[0].terms[t].flip, alone[0].terms[t].flip);
  const AttributionInput same{swapOf(left, pictures.reference), {}};
  const AttributionInput beside[] = {same, both[1]};
  EXPECT_EQ(attributeTerms({pictures.reference}, beside)[0].flip, 0);
}

TEST(Attribution, NonFinitePixelsCountAsTheWorstValueAndNoFigureIsNan) {
  const AttributedPictures pictures;
  const base::PixelList list = box("m", 8, 8, 80, 70);
  AttributionInput input = pictures.of(list);
  input.swap.nonFinite = {100, 200};
  input.terms[0].swap.nonFinite = {100};                       // its term was what is wrong at 200
  input.terms[1].swap = swapOf(list, pictures.reference, {5}); // a term that spoils a pixel
  const auto found = attributeTerms({pictures.reference}, {&input, 1}).at(0);
  const auto pixels = static_cast<double>(list.pixels.size());
  EXPECT_NEAR(found.flip, measure(pictures.reference, input.swap), 1e-9);
  EXPECT_NEAR(found.terms[0].flip, measure(pictures.reference, input.terms[0].swap), 1e-9);
  EXPECT_NEAR(found.terms[1].flip, measure(pictures.reference, input.terms[1].swap), 1e-9);
  EXPECT_GE(found.terms[1].flip, 1 / pixels);
  AttributionInput sound = pictures.of(list);
  EXPECT_GT(found.flip, attributeTerms({pictures.reference}, {&sound, 1}).at(0).flip);

  // Where the high-end colour is no number nothing helps.
  const std::vector<std::uint32_t> lost = {40 * kAttributedWidth + 40,
                                           79 * kAttributedWidth + 95}; // of the material, and not
  input = {swapOf(list, pictures.mobile), {{"skySpecular", swapOf(list, pictures.reference)}}};
  const auto hopeless = attributeTerms({pictures.reference, nullptr, lost}, {&input, 1}).at(0);
  EXPECT_NEAR(hopeless.flip, measure(pictures.reference, input.swap, lost), 1e-9);
  EXPECT_NEAR(hopeless.terms.at(0).flip, 1 / pixels, 1e-9) << "of the material that pixel alone";
}

TEST(Attribution, AMaterialWithoutPixelsHasNothingToExplain) {
  const AttributedPictures pictures;
  base::PixelList empty{"empty", {}, {}}, weightless = box("weightless", 4, 4, 6, 6),
                                          thin = box("thin", 50, 10, 55, 12);
  weightless.weights.assign(4, 0.f);
  const AttributionInput inputs[] = {pictures.of(empty), pictures.of(weightless), pictures.of(thin)};
  const auto found = attributeTerms({pictures.reference}, inputs);
  ASSERT_EQ(found.size(), 3u);
  for (const std::size_t i : {0, 1}) {
    EXPECT_EQ(found[i].flip, 0);
    ASSERT_EQ(found[i].terms.size(), 2u);
    EXPECT_EQ(found[i].terms[1].flip, 0);
  }
  EXPECT_NEAR(found[2].flip, measure(pictures.reference, inputs[2].swap), 1e-9) << "and does not shift the next one's";
  EXPECT_TRUE(attributeTerms({pictures.reference}, {}).empty());
}

TEST(Attribution, ResultDoesNotDependOnTheThreads) {
  const AttributedPictures pictures;
  const base::PixelList left = box("a", 0, 0, 40, 70), right = box("b", 40, 0, 96, 80);
  const auto run = [&](int threads) {
    const base::ThreadLimit limit(threads);
    const AttributionInput inputs[] = {pictures.of(left), pictures.of(right)};
    std::vector<double> flips;
    for (const Attribution& each : attributeTerms({pictures.reference}, inputs)) {
      flips.push_back(each.flip);
      for (const TermEffect& effect : each.terms) flips.push_back(effect.flip);
    }
    return flips;
  };
  EXPECT_EQ(run(1), run(2));
  EXPECT_EQ(run(1).size(), 6u);
}

TEST(Attribution, PicturesThatDoNotFitAreRefused) {
  const AttributedPictures pictures;
  const base::PixelList list = box("m", 8, 8, 80, 70), other = box("m", 8, 8, 20, 20),
                        outside{"outside", {kAttributedWidth * kAttributedHeight}, {}};
  const auto run = [&](const AttributionInput& input) {
    return test::codeOf([&] { attributeTerms({pictures.reference}, {&input, 1}); });
  };
  EXPECT_EQ(run(pictures.of(list)), base::ExitCode::withinBudget);
  AttributionInput unlike = pictures.of(list);
  unlike.terms[1].swap.displayed = swapOf(other, pictures.sky).displayed;
  EXPECT_EQ(run(unlike), base::ExitCode::notComparable);
  AttributionInput malformed = pictures.of(list);
  malformed.swap.list = &outside;
  malformed.swap.displayed = swapOf(other, pictures.sky).displayed;
  EXPECT_EQ(run(malformed), base::ExitCode::failed);
  const AttributionInput sound = pictures.of(list);
  EXPECT_EQ(test::codeOf([&] { attributeTerms({PixelView()}, {&sound, 1}); }), base::ExitCode::notComparable);
}

} // namespace
} // namespace parity::compare
