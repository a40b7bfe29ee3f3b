// What the cache keeps of a scene: every member that is kept comes back, those that judging sets do not, and bytes that
// are not whole are no record.
#include <random>

#include <gtest/gtest.h>

#include "job/scene/scene_record.h"
#include "report/record/archive.h"
#include "report/record/report_records.h"

namespace parity::job {
namespace {

// Gives each kept member a value of its own that is not its default; lists get two elements.
struct Filler {
  int next = 0;
  template <typename T> void operator()(T& value) {
    if constexpr (std::is_same_v<T, bool>)
      value = true;
    else if constexpr (std::is_arithmetic_v<T>)
      value = static_cast<T>(++next);
    else if constexpr (std::is_same_v<T, std::string>)
      value = "text " + std::to_string(++next);
    else if constexpr (std::is_enum_v<T>)
      value = static_cast<T>(1);
    else
      fill(value);
  }
  template <typename T> void fill(std::vector<T>& list) {
    list.resize(2);
    for (T& each : list) (*this)(each);
  }
  template <typename T> void fill(std::optional<T>& value) { (*this)(value.emplace()); }
  template <report::Described T> void fill(T& record) {
    report::forEachKept(record, report::kRecord<T>.rows, [this](auto& member) { (*this)(member); });
  }
};

// The values of the kept members, in order.
struct Flattener {
  std::vector<std::string> values;
  template <typename T> void operator()(const T& value) {
    if constexpr (std::is_arithmetic_v<T>)
      values.push_back(std::to_string(value));
    else if constexpr (std::is_same_v<T, std::string>)
      values.push_back(value);
    else if constexpr (std::is_enum_v<T>)
      values.push_back(std::to_string(static_cast<int>(value)));
    else
      flatten(value);
  }
  template <typename T> void flatten(const std::vector<T>& list) {
    values.push_back("list of " + std::to_string(list.size()));
    for (const T& each : list) (*this)(each);
  }
  template <typename T> void flatten(const std::optional<T>& value) {
    values.push_back(value ? "one" : "none");
    if (value) (*this)(*value);
  }
  template <report::Described T> void flatten(const T& record) {
    report::forEachKept(record, report::kRecord<T>.rows, [this](const auto& member) { (*this)(member); });
  }
};

std::vector<std::string> valuesOf(const report::SceneResult& scene) {
  Flattener flattener;
  flattener(scene);
  return flattener.values;
}

SceneRecord makeRecord() {
  SceneRecord record;
  Filler filler;
  filler(record.result);
  record.prefixes = {"0-front", "1-back"};
  record.pictures = {{"images/0-front_flip.png", std::vector<std::byte>(3, std::byte{7})}, {"pixels/1-back.js", {}}};
  return record;
}

TEST(SceneRecord, EveryMemberThatIsKeptComesBack) {
  const SceneRecord record = makeRecord();
  const std::optional<SceneRecord> read = recordFromBytes(toBytes(record));
  ASSERT_TRUE(read);
  const std::vector<std::string> values = valuesOf(record.result);
  EXPECT_GT(values.size(), 500u) << "two views of two materials with all that they may have";
  EXPECT_EQ(valuesOf(read->result), values);
  EXPECT_EQ(read->result.views[1].materials[1].attribution->terms[1].flip,
            record.result.views[1].materials[1].attribution->terms[1].flip);
  EXPECT_EQ(read->prefixes, record.prefixes);
  ASSERT_EQ(read->pictures.size(), 2u);
  EXPECT_EQ(read->pictures[0].file, "images/0-front_flip.png");
  EXPECT_EQ(read->pictures[0].bytes, record.pictures[0].bytes);
}

TEST(SceneRecord, FiguresComeBackBitForBit) {
  SceneRecord record = makeRecord();
  compare::Figures& figures = record.result.views[0].whole;
  figures.values = {{"psnr", INFINITY}, {"flip.mean", 0.1 + 0.2}, {"rmse", -0.0}};
  const std::vector<std::byte> bytes = toBytes(record);
  EXPECT_EQ(toBytes(*recordFromBytes(bytes)), bytes);
}

TEST(SceneRecord, WhatJudgingSetsIsNotKept) {
  SceneRecord record = makeRecord();
  report::MaterialResult& material = record.result.views[0].materials[0];
  material.verdict = compare::Verdict::fail;
  material.reason = "over budget";
  material.checks.resize(3);
  material.baseline.emplace();
  record.result.conditions.resize(2);
  const std::optional<SceneRecord> read = recordFromBytes(toBytes(record));
  ASSERT_TRUE(read);
  const report::MaterialResult& kept = read->result.views[0].materials[0];
  EXPECT_EQ(kept.verdict, compare::Verdict::pass);
  EXPECT_EQ(kept.reason, "");
  EXPECT_TRUE(kept.checks.empty());
  EXPECT_FALSE(kept.baseline);
  EXPECT_TRUE(read->result.conditions.empty());
}

TEST(SceneRecord, AStageThatNobodyNamedIsKept) {
  SceneRecord record = makeRecord();
  record.result.views[0].stages.push_back({"upscaling", "a bicubic of half size", {}});
  const std::optional<SceneRecord> read = recordFromBytes(toBytes(record));
  ASSERT_TRUE(read);
  ASSERT_EQ(read->result.views[0].stages.size(), 3u);
  EXPECT_EQ(read->result.views[0].stages[2].stage, "upscaling");
}

TEST(SceneRecord, BytesThatAreNotWholeAreNone) {
  std::vector<std::byte> bytes = toBytes(makeRecord());
  for (std::size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_FALSE(recordFromBytes(std::span(bytes).first(size))) << size;
  bytes.push_back({});
  EXPECT_FALSE(recordFromBytes(bytes)) << "a byte too many";
}

// Neither a crash nor memory beyond what the bytes can hold.
TEST(SceneRecord, DamagedBytesAreReadWithoutHarm) {
  const std::vector<std::byte> whole = toBytes(makeRecord());
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> bytes = whole;
    for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] = static_cast<std::byte>(random() % 256);
    recordFromBytes(bytes);
  }
}

} // namespace
} // namespace parity::job
