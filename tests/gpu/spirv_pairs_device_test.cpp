// Buffers that are accessed by pairs hold and give the same bits.
#include "gpu/spirv/spirv_pairs.h"

#include <array>
#include <bit>
#include <cstring>
#include <random>

#include "gpu/run_words.h"
#include "gpu/spirv/spirv_specialize.h"
#include "gpu_shaders/pairs.comp.h"
#include "support/device.h"

namespace parity::gpu {
namespace {

// As in pairs.comp.
struct Part {
  glm::vec4 rows[3];
  glm::uvec4 word;
};
struct Thing {
  glm::vec4 first;
  glm::ivec4 second;
  Part parts[2];
};
struct Indexed {
  glm::vec4 title;
  Part parts[16];
};

constexpr std::uint32_t kInvocations = 128;
constexpr std::size_t kPairResults = 8; // of each

struct Content {
  std::array<glm::vec4, kInvocations + 2> vectors;
  std::array<Thing, 17> things; // the first is the head
  std::array<std::uint32_t, kInvocations + 1> numbers;
  Indexed indexed;
  std::array<glm::vec4, 16> fixed;
};

glm::vec4 sumOf(const Part& part) {
  return part.rows[0] + 2.f * part.rows[1] + 4.f * part.rows[2] + glm::vec4(part.word);
}

// What the shader computes.
std::array<glm::vec4, kPairResults> resultsOf(const Content& c, std::uint32_t i) {
  const auto& v = c.vectors;
  const std::uint32_t n = c.numbers[i] % 16;
  const Thing &head = c.things[0], *things = &c.things[1];
  const glm::vec4 end = head.parts[1].rows[2];
  std::array<glm::vec4, kPairResults> r;
  r[0] = v[i];
  r[1] = {v[i + 1].w, v[i + 2].x, v[n].z, v[3].y};
  r[2] = glm::vec4(head.second) + things[n].first + glm::vec4(things[n].second.y, things[n].second.x, end.z, end.w);
  r[3] = sumOf(things[n].parts[i & 1]);
  r[4] = things[2].parts[c.numbers[i + 1] & 1].rows[1];
  for (int k = 0; k < 4; ++k) r[4][k] += std::bit_cast<float>(things[n].parts[1].word[k]);
  r[5] = sumOf(c.indexed.parts[n]) + c.indexed.title;
  r[6] = {c.indexed.parts[n].rows[i % 3].y, c.indexed.parts[7].word.w, c.fixed[3].x, c.fixed[15].z};
  r[7] = r[0] * 2.f;
  return r;
}

// Small whole numbers, whose sums are exact; or any bits.
Content makeContent(bool anyBits) {
  std::mt19937 random(3);
  Content content;
  std::array<std::uint32_t, sizeof(Content) / sizeof(std::uint32_t)> words;
  for (std::uint32_t& word : words)
    word = anyBits ? static_cast<std::uint32_t>(random()) : std::bit_cast<std::uint32_t>(1.f + random() % 100);
  std::memcpy(&content, words.data(), sizeof(content));
  if (!anyBits) {
    for (Part& part : content.indexed.parts) part.word = {random() % 100, random() % 100, 7, 8};
    for (Thing& thing : content.things) {
      thing.second = {static_cast<int>(random() % 100) - 50, 5, -6, 7};
      for (Part& part : thing.parts) part.word = {3, random() % 100, 4, random() % 100};
    }
  }
  for (std::uint32_t& number : content.numbers) number = static_cast<std::uint32_t>(random());
  return content;
}

class SpirvPairsTest : public tests::DeviceTest {
protected:
  std::vector<std::uint32_t> run(const std::vector<std::uint32_t>& words, const Content& c) const {
    const std::vector<glm::vec4> unwritten(kPairResults * kInvocations, glm::vec4(-1));
    const Buffer vectors(device(), std::span<const glm::vec4>(c.vectors)),
        things(device(), std::span<const Thing>(c.things)),
        numbers(device(), std::span<const std::uint32_t>(c.numbers)),
        results(device(), std::span<const glm::vec4>(unwritten)), copies(device(), sizeof(c.vectors)),
        together(device(), sizeof(c.vectors)), parts(device(), (kInvocations + 1) * sizeof(Part)),
        indexed(device(), std::span(&c.indexed, 1)), fixed(device(), std::span<const glm::vec4>(c.fixed));
    runWords(device(), words,
             {storage(vectors), storage(things), storage(numbers), storage(results), uniform(indexed), uniform(fixed),
              storage(copies), storage(together), storage(parts)},
             kInvocations / 64);
    std::vector<std::uint32_t> all = results.downloadAs<std::uint32_t>(4 * kPairResults * kInvocations);
    for (const Buffer* copied : {&copies, &together}) {
      const auto values = copied->downloadAs<std::uint32_t>(4 * kInvocations);
      all.insert(all.end(), values.begin(), values.end());
    }
    for (const Part& part : parts.downloadAs<Part>(kInvocations))
      for (int k = 0; k < 4; ++k) all.push_back(std::bit_cast<std::uint32_t>(part.rows[1][k]));
    return all;
  }
};

TEST_F(SpirvPairsTest, ShadersReadAndWriteWhatBuffersHold) {
  if (!device().accessesByPairs()) GTEST_SKIP() << "the device is given no pairs";
  for (const Spirv spirv : {Spirv(kPairsComp), Spirv(kPairsCompWritten)}) {
    const std::vector<std::uint32_t> plain = specializeSpirv(spirv, std::array{0u}),
                                     byPairs = accessBuffersByPairs(plain);
    ASSERT_NE(byPairs, plain);
    const Content exact = makeContent(false);
    const std::vector<std::uint32_t> found = run(byPairs, exact);
    for (std::uint32_t i = 0; i < kInvocations; ++i) {
      const auto wanted = resultsOf(exact, i);
      for (std::size_t k = 0; k < 4 * kPairResults; ++k)
        ASSERT_EQ(std::bit_cast<float>(found[4 * kPairResults * i + k]), wanted[k / 4][static_cast<int>(k % 4)])
            << "invocation " << i << ", result " << k / 4 << ", component " << k % 4;
    }
    for (std::size_t k = 4 * kPairResults * kInvocations; k < found.size(); ++k) // three copies
      ASSERT_EQ(std::bit_cast<float>(found[k]), exact.vectors[k / 4 % kInvocations][static_cast<int>(k % 4)]) << k;
    EXPECT_EQ(found.size(), 4 * (kPairResults + 3) * kInvocations);
    const Content bits = makeContent(true);
    EXPECT_EQ(run(byPairs, bits), run(plain, bits));
  }
}

} // namespace
} // namespace parity::gpu
