// What FLIP is made of, each against the standard library or its definition: roots and powers, decoding, filters.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/simd_level.h"
#include "compare/flip/flip.h"
#include "compare/flip/flip_constants.h"
#include "compare/flip/flip_filters.h"
#include "compare/flip/flip_hdr.h"
#include "compare/flip/flip_simd.h"
#include "flip_oracle_hdr.h"
#include "random_images.h"

namespace parity::compare {
namespace {

TEST(FlipParts, TheLargestColorDifferenceIsGreenAgainstBlue) {
  EXPECT_NEAR(static_cast<double>(flip_constants::kMaxColorDifference), oracle::largestColorDifference(), 1e-5);
}

TEST(FlipParts, FiltersSumToWhatTheyMust) {
  const auto sum = [](const std::vector<float>& half) {
    double total = static_cast<double>(half[0]);
    for (std::size_t i = 1; i < half.size(); ++i) total += 2 * static_cast<double>(half[i]);
    return total;
  };
  for (float ppd : {1.f, 10.f, 67.0206451f, 200.f, 1000.f}) {
    const FlipFilters f = makeFlipFilters(ppd);
    EXPECT_NEAR(sum(f.luma), 1, 1e-6) << ppd;
    EXPECT_NEAR(sum(f.redGreen), 1, 1e-6) << ppd;
    EXPECT_NEAR(std::pow(sum(f.blueYellowA), 2) + std::pow(sum(f.blueYellowB), 2), 1, 1e-6) << ppd;
    EXPECT_NEAR(sum(f.gauss), 1, 1e-6) << ppd;
    EXPECT_NEAR(sum(f.point), 0, 1e-6) << ppd;
    double edge = 0;
    for (float w : f.edge) edge += static_cast<double>(w);
    EXPECT_NEAR(edge, -1, 1e-6) << ppd;
    for (const std::vector<float>* half :
         {&f.luma, &f.redGreen, &f.blueYellowA, &f.blueYellowB, &f.gauss, &f.edge, &f.point}) {
      EXPECT_GE(half->size(), 2u) << ppd;
      EXPECT_LE(half->size(), static_cast<std::size_t>(f.radius) + 1) << ppd;
    }
    EXPECT_LE(f.luma.size(), f.gauss.size()) << ppd;
  }
}

TEST(FlipParts, TheFilterRadiusIsTenAtTheDefaultDistance) {
  EXPECT_EQ(flipFilterRadius({}), 10);
  EXPECT_EQ(makeFlipFilters(kDefaultPixelsPerDegree).gauss.size(), 10u); // radius 9
  EXPECT_EQ(flipFilterRadius({.ppd = 120}), 17);                         // ceil(0.13505 * 120 = 16.2)
}

TEST(FlipParts, PixelsPerDegreeOfTheDefaultScreen) {
  EXPECT_FLOAT_EQ(pixelsPerDegree(0.7f, 3840.f, 0.7f), kDefaultPixelsPerDegree);
}

class FlipDecoding : public ::testing::TestWithParam<std::string> {
protected:
  void SetUp() override { base::useSimdLevel(GetParam()); }
  void TearDown() override { base::useSimdLevel(""); }

  // Rows of every length around a vector's, decoded, against the exact planes.
  template <typename Exact>
  static void expectPlanes(const base::Image& image, const RowDecoder& decoder, double tolerance, Exact exact) {
    for (int count : {1, 3, 7, 8, 9, 16, 63, 64, 65, image.width}) {
      std::vector<float> planes[3];
      for (auto& plane : planes) plane.assign(static_cast<std::size_t>(image.width + kMaxSimdStep), 0.f);
      decodeRow(decoder, image.pixels.data(), 3, count, {planes[0].data(), planes[1].data(), planes[2].data()});
      for (int x = 0; x < count; ++x) {
        const float* rgb = image.at(x, 0);
        const oracle::Pixel linear =
            exact({static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2])});
        const oracle::Pixel c = oracle::toYCxCz(linear);
        const double want[] = {(c[0] + 16) / 116, c[1] / 500, c[2] / 200};
        for (std::size_t p = 0; p < 3; ++p)
          ASSERT_NEAR(static_cast<double>(planes[p][static_cast<std::size_t>(x)]), want[p], tolerance)
              << "column " << x << " of " << count << ", plane " << p;
      }
    }
  }
};

TEST_P(FlipDecoding, SrgbIsTheStandardsTransferFunction) {
  const base::Image ramp = [] {
    base::Image image(1000, 1, 3);
    for (int x = 0; x < 1000; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, 0)[c] = static_cast<float>((x * (c + 1)) % 1000) / 999.f;
    return image;
  }();
  expectPlanes(ramp, {}, 4e-7, [](const oracle::Pixel& c) {
    return oracle::Pixel{oracle::decodeSrgb(c[0]), oracle::decodeSrgb(c[1]), oracle::decodeSrgb(c[2])};
  });
}

TEST_P(FlipDecoding, BytesAndTheirFloatsAreDecodedToTheSameBits) {
  base::Image8 bytes(300, 1, 3);
  for (std::size_t i = 0; i < bytes.pixels.size(); ++i) bytes.pixels[i] = static_cast<std::uint8_t>(i * 7);
  base::Image floats(300, 1, 3);
  for (std::size_t i = 0; i < bytes.pixels.size(); ++i)
    floats.pixels[i] = static_cast<float>(bytes.pixels[i]) * (1.f / 255.f);
  std::vector<float> a(3 * 400), b(3 * 400);
  decodeRow(bytes.pixels.data(), 3, 300, {a.data(), a.data() + 400, a.data() + 800});
  decodeRow(RowDecoder{}, floats.pixels.data(), 3, 300, {b.data(), b.data() + 400, b.data() + 800});
  for (std::size_t i = 0; i < 300; ++i)
    for (std::size_t p = 0; p < 3; ++p) ASSERT_EQ(a[400 * p + i], b[400 * p + i]) << i;
}

// Each row has its own memory, which a sanitizer guards. Only a row that is shorter than a vector is written beyond its
// end, by less than a vector.
TEST_P(FlipDecoding, RowsOfEveryLengthStayWithinTheirMemory) {
  constexpr std::size_t kBefore = 16, kBehind = 48, kMostLanes = 16; // values around a plane; of a vector
  const auto check = [&](const auto& pixels, std::size_t channels, const auto& decode) {
    std::vector<float> whole(3 * 128);
    decode(pixels.data(), static_cast<int>(channels), 64,
           ColorPlanes{whole.data(), whole.data() + 128, whole.data() + 256});
    for (std::size_t count = 1; count <= 64; ++count) {
      const std::vector row(pixels.begin(), pixels.begin() + static_cast<std::ptrdiff_t>(count * channels));
      std::vector<float> planes[3];
      for (auto& plane : planes) plane.assign(kBefore + count + kBehind, -7.f);
      decode(row.data(), static_cast<int>(channels), static_cast<int>(count),
             ColorPlanes{planes[0].data() + kBefore, planes[1].data() + kBefore, planes[2].data() + kBefore});
      for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t i = 0; i < planes[p].size(); ++i) {
          const bool isPixel = i >= kBefore && i < kBefore + count;
          if (!isPixel && i >= kBefore && i < kBefore + kMostLanes) continue; // of a row that is shorter
          ASSERT_EQ(planes[p][i], isPixel ? whole[128 * p + i - kBefore] : -7.f)
              << "column " << i << " - 16 of " << count << ", " << channels << " channels";
        }
    }
  };
  for (const std::size_t channels : {3u, 4u}) {
    std::vector<std::uint8_t> bytes(64 * channels);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 37 + 11);
    check(bytes, channels, [](const std::uint8_t* from, int each, int count, const ColorPlanes& out) {
      decodeRow(from, each, count, out);
    });
    const std::vector<float> floats = [&] {
      std::vector<float> values(bytes.size());
      std::ranges::transform(bytes, values.begin(), [](std::uint8_t byte) { return static_cast<float>(byte) / 255.f; });
      return values;
    }();
    for (const RowDecoder& decoder : {RowDecoder{}, RowDecoder{.decoding = Decoding::linear},
                                      makeRowDecoder(Tonemapper::aces), makeRowDecoder(Tonemapper::reinhard)})
      check(floats, channels, [&](const float* from, int each, int count, const ColorPlanes& out) {
        decodeRow(decoder, from, each, count, out);
      });
  }
}

TEST_P(FlipDecoding, ToneCurvesAreTheDefinitions) {
  const base::Image image = test::makeHdrImage(500, 1, 3);
  for (Tonemapper tonemapper : {Tonemapper::aces, Tonemapper::hable, Tonemapper::reinhard})
    for (float exposure : {0.01f, 1.f, 40.f}) {
      RowDecoder decoder = makeRowDecoder(tonemapper);
      decoder.exposure = exposure;
      expectPlanes(image, decoder, 1e-6, [&](oracle::Pixel c) {
        for (double& v : c) v *= static_cast<double>(exposure);
        oracle::Pixel shown = oracle::tonemap(tonemapper, c);
        for (double& v : shown) v = std::clamp(v, 0., 1.);
        return shown;
      });
    }
}

// Where a value overflows when exposed, or is negative: still numbers; and black stays black.
TEST_P(FlipDecoding, NoValueBecomesNanAtAnyExposure) {
  base::Image image(64, 1, 3);
  const float values[] = {0, -0.f, 1e-40f, 3e38f, -3e38f, -1, 1e10f};
  for (std::size_t i = 3; i < image.pixels.size(); ++i) image.pixels[i] = values[(i * i + i / 3) % 7];
  for (Tonemapper tonemapper : {Tonemapper::aces, Tonemapper::hable, Tonemapper::reinhard})
    for (float ev : {-kMaxExposureEv, 0.f, 17.f, kMaxExposureEv}) {
      RowDecoder decoder = makeRowDecoder(tonemapper);
      decoder.exposure = std::exp2(ev);
      std::vector<float> planes(3 * 192);
      decodeRow(decoder, image.pixels.data(), 3, 64, {planes.data(), planes.data() + 192, planes.data() + 384});
      for (float v : planes) ASSERT_TRUE(std::isfinite(v)) << ev;
      for (std::size_t p = 0; p < 3; ++p) ASSERT_EQ(planes[192 * p], 0.f) << ev; // the first pixel
    }
}

class FlipRows : public ::testing::TestWithParam<std::string> {
protected:
  void SetUp() override { base::useSimdLevel(GetParam()); }
  void TearDown() override { base::useSimdLevel(""); }
};

// Against the sums in double, of every row that was asked for, in columns that no vector divides.
TEST_P(FlipRows, FiltersAreTheirDefinition) {
  const FlipFilters f = makeFlipFilters(30.f);
  constexpr int kColumns = 37, kPlaneRows = 64;
  constexpr std::size_t kStride = 128;
  const int margin = 16;
  ASSERT_LE(f.radius, margin);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(0, 1);
  std::vector<float> source(kSourcePlanes * kStride * kPlaneRows);
  for (float& v : source) v = value(random);
  std::vector<const float*> rows;
  for (int i = 0; i < kPlaneRows; ++i) rows.push_back(&source[kSourcePlanes * kStride * static_cast<std::size_t>(i)]);
  // Of both directions: weights of the half kernels, -1 times those of the negative side for the antisymmetric one.
  const auto filtered = [&](SourcePlane plane, int x, int row, const std::vector<float>& alongY, double signY,
                            const std::vector<float>& alongX, double signX) {
    const auto weight = [](const std::vector<float>& half, double sign, int k) {
      const auto i = static_cast<std::size_t>(std::abs(k));
      return i < half.size() ? static_cast<double>(half[i]) * (k < 0 ? sign : 1) : 0.;
    };
    double sum = 0;
    for (int dy = -f.radius; dy <= f.radius; ++dy)
      for (int dx = -f.radius; dx <= f.radius; ++dx)
        sum += weight(alongY, signY, dy) * weight(alongX, signX, dx) *
               static_cast<double>(rows[static_cast<std::size_t>(f.radius + row + dy)][plane * kStride + x + dx]);
    return sum;
  };
  std::vector<float> planes(kFilteredPlanes * kStride * kBatchRows);
  std::vector<float> out[5];
  for (auto& plane : out) plane.resize((kColumns + 3) * kBatchRows);
  for (int rowCount : {1, 6, kBatchRows})
    for (const FilterInput& input : {kReferenceInput, kTestInput}) {
      filterAcrossRows(f, input, rows.data(), kStride, 0, margin + kColumns + f.radius, rowCount, planes.data());
      filterAlongRows(f, planes.data(), kStride, margin, kColumns, rowCount,
                      {out[0].data(), out[1].data(), out[2].data(), out[3].data(), out[4].data()});
      for (int x : {0, 1, 2, 3, 17, kColumns - 1})
        for (int row = 0; row < rowCount; ++row) {
          const auto expected = [&](SourcePlane plane, const std::vector<float>& half) {
            return filtered(plane, margin + x, row, half, 1, half, 1);
          };
          const auto squared = [&](const std::vector<float>& half, double sign) {
            return std::pow(filtered(input.featureY, margin + x, row, f.gauss, 1, half, sign), 2) +
                   std::pow(filtered(input.featureY, margin + x, row, half, sign, f.gauss, 1), 2);
          };
          const double want[] = {expected(input.y, f.luma), expected(input.xMinusY, f.redGreen),
                                 expected(input.yMinusZ, f.blueYellowA) + expected(input.yMinusZ, f.blueYellowB),
                                 squared(f.edge, -1), squared(f.point, 1)};
          for (std::size_t p = 0; p < 5; ++p)
            ASSERT_NEAR(static_cast<double>(out[p][static_cast<std::size_t>(x * kBatchRows + row)]), want[p], 2e-6)
                << "plane " << p << ", column " << x << ", row " << row << " of " << rowCount;
        }
    }
}

TEST_P(FlipRows, ColumnsBecomeRows) {
  std::vector<float> columns(24 * kBatchRows);
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = static_cast<float>(i);
  for (int count : {1, 4, 13, 24}) {
    std::vector<float> rows(kBatchRows * 30, -1.f);
    rowsOfColumns(columns.data(), count, kBatchRows, rows.data(), 30);
    for (int r = 0; r < kBatchRows; ++r)
      for (int x = 0; x < 30; ++x) {
        const float found = rows[static_cast<std::size_t>(r * 30 + x)];
        if (x < count || x >= (count + 3) / 4 * 4) {
          ASSERT_EQ(found, x < count ? static_cast<float>(x * kBatchRows + r) : -1.f) << x << ", " << r;
        }
      }
  }
}

TEST_P(FlipRows, TheLargestIsKeptWithItsMarkAndTheFirstOfEqualOnes) {
  std::vector<float> largest(37, 0.5f), marks(37, 0.25f), values(37);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 3) * 0.5f; // below, equal, above
  keepLargest(values.data(), 35, 0.75f, largest.data(), marks.data());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool isLarger = i % 3 == 2 && i < 35;
    ASSERT_EQ(largest[i], isLarger ? 1.f : 0.5f) << i;
    ASSERT_EQ(marks[i], isLarger ? 0.75f : 0.25f) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(SimdLevels, FlipRows, ::testing::ValuesIn(base::simdLevels()),
                         [](const auto& instance) { return instance.param; });

// At each place of two cells and a shorter one.
TEST(FlipParts, CellsThatDifferInAnyByteAreMarked) {
  constexpr std::size_t kCell = 24, kCount = 2 * kCell + 5;
  const std::vector<std::uint8_t> a(kCount, 7);
  for (std::size_t place = 0; place < kCount; ++place) {
    std::vector<std::uint8_t> b = a;
    b[place] = 8;
    std::uint64_t bits = 0;
    markDifferences(a.data(), b.data(), kCount, kCell, &bits);
    ASSERT_EQ(bits, std::uint64_t{1} << (place / kCell)) << place;
  }
}

INSTANTIATE_TEST_SUITE_P(SimdLevels, FlipDecoding, ::testing::ValuesIn(base::simdLevels()),
                         [](const auto& instance) { return instance.param; });

TEST(FlipParts, AnUnknownSimdLevelIsAUsageError) {
  EXPECT_THROW(base::useSimdLevel("AVX9"), base::Error);
  EXPECT_FALSE(base::simdLevels().empty());
}

} // namespace
} // namespace parity::compare
