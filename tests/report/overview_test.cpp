// The list of index.html, unpacked: its rows are the report's.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "report/again.h"
#include "report/causes.h"
#include "report/column.h"
#include "report/overview.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

using nlohmann::json;

json parseOverview(const Report& report) {
  std::string text;
  writeOverview(report, {}, [&](std::string_view piece) { text += piece; });
  EXPECT_EQ(text.find('\n'), text.size() - 1) << "one line";
  return json::parse(text);
}

std::vector<std::uint8_t> bytesFromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    if ((count += 6) >= 8) bytes.push_back(static_cast<std::uint8_t>(bits >> (count -= 8)));
  }
  return bytes;
}

template <typename T> std::vector<double> packedValues(const std::vector<std::uint8_t>& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T)); // little-endian, as the tests' machines are
  return {values.begin(), values.end()};
}

std::vector<double> unpackColumn(const json& column, std::size_t count) {
  if (column.is_null()) return std::vector<double>(count, NAN);
  if (column.is_number()) return std::vector<double>(count, column.get<double>());
  const std::vector<std::uint8_t> bytes = bytesFromBase64(column.begin().value());
  if (column.contains("u8")) return packedValues<std::uint8_t>(bytes);
  if (column.contains("u16")) return packedValues<std::uint16_t>(bytes);
  return column.contains("u32") ? packedValues<std::uint32_t>(bytes) : packedValues<float>(bytes);
}

template <typename T> json writtenColumn(const std::vector<T>& values) {
  base::JsonWriter writer(base::JsonLayout::compact);
  writeColumn(writer, values);
  return json::parse(writer.finish());
}

TEST(Column, HoldsItsValuesInTheSmallestKind) {
  const auto expect = [](const std::vector<std::uint32_t>& values, const char* kind) {
    const json column = writtenColumn(values);
    EXPECT_TRUE(column.contains(kind)) << column;
    EXPECT_EQ(unpackColumn(column, values.size()), std::vector<double>(values.begin(), values.end()));
  };
  expect({0, 255}, "u8");
  expect({256, 3, 65535}, "u16");
  expect({65536, 0}, "u32");
  EXPECT_EQ(unpackColumn(writtenColumn(std::vector<float>{0.25f, -3}), 2), (std::vector<double>{0.25, -3}));
}

TEST(Column, OfOneValueIsThatValue) {
  EXPECT_EQ(writtenColumn(std::vector<std::uint32_t>{7, 7, 7}), 7);
  EXPECT_EQ(writtenColumn(std::vector<std::uint32_t>{}), 0);
  EXPECT_EQ(writtenColumn(std::vector<float>{0.5f, 0.5f}), 0.5);
  EXPECT_EQ(writtenColumn(std::vector<float>{NAN, INFINITY}), nullptr);
}

// A table of the overview, and what its columns mean.
class OverviewTable {
public:
  OverviewTable(const json& overview, const char* name) : m_overview(overview), m_table(overview.at(name)) {}
  std::size_t count() const { return m_table["count"]; }
  std::vector<double> column(const std::string& name) const {
    return unpackColumn(m_table["columns"].at(name), count());
  }
  std::vector<double> figure(const std::string& name) const {
    return unpackColumn(m_table["figures"].at(name), count());
  }
  std::vector<std::string> texts(const std::string& name) const {
    std::vector<std::string> texts;
    for (const double place : column(name)) texts.push_back(m_overview["texts"].at(static_cast<std::size_t>(place)));
    return texts;
  }
  json list(const std::string& name, std::size_t row) const {
    json texts = json::array();
    for (const json& place : m_overview["lists"].at(static_cast<std::size_t>(column(name)[row])))
      texts.push_back(m_overview["texts"].at(place.get<std::size_t>()));
    return texts;
  }

private:
  const json& m_overview;
  const json& m_table;
};

TEST(Overview, HasARowForEachMaterialAndWholeImage) {
  const Report report = makeSampleReport();
  const json overview = parseOverview(report);
  const OverviewTable scenes(overview, "scenes"), views(overview, "views"), rows(overview, "rows");
  EXPECT_EQ(scenes.texts("name"), (std::vector<std::string>{"Lamp", "Broken"}));
  EXPECT_EQ(scenes.texts("error")[1], report.scenes[1].error);
  EXPECT_EQ(overview["verdicts"][static_cast<std::size_t>(scenes.column("verdict")[1])], "error");
  EXPECT_EQ(scenes.list("warnings", 0), json(report.scenes[0].warnings));
  EXPECT_EQ(scenes.column("views"), (std::vector<double>{2, 0}));
  ASSERT_EQ(views.count(), 2u);
  std::size_t row = 0;
  for (std::size_t v = 0; v < 2; ++v) {
    const ViewResult& view = report.scenes[0].views[v];
    EXPECT_EQ(views.texts("name")[v], view.name);
    EXPECT_EQ(views.column("materials")[v], static_cast<double>(view.materials.size()));
    for (const MaterialResult& material : view.materials) {
      EXPECT_EQ(rows.texts("name")[row], material.name);
      EXPECT_EQ(rows.texts("reason")[row], material.reason);
      EXPECT_EQ(rows.texts("preset")[row], material.rule.preset);
      EXPECT_EQ(rows.column("pixels")[row], static_cast<double>(material.figures.pixels));
      EXPECT_EQ(rows.column("seenElsewhere")[row], material.seenElsewhere ? 1 : 0);
      EXPECT_EQ(rows.list("notModelled", row), json(material.notModelled));
      EXPECT_EQ(overview["verdicts"][static_cast<std::size_t>(rows.column("verdict")[row])], nameOf(material.verdict));
      for (const char* name : {"flip.mean", "bias.ev", "psnr"}) {
        const std::optional<double> figure =
            material.figures.pixels > 0 ? material.figures.find(name) : std::optional<double>();
        if (figure && std::isfinite(*figure))
          EXPECT_FLOAT_EQ(static_cast<float>(rows.figure(name)[row]), static_cast<float>(*figure)) << name;
        else
          EXPECT_TRUE(std::isnan(rows.figure(name)[row])) << name << ", also an infinite psnr";
      }
      ++row;
    }
    EXPECT_EQ(rows.texts("name")[row++], "") << "the whole image";
  }
  EXPECT_EQ(rows.count(), row);
}

TEST(Overview, NamesPicturesByWhatTheirPathsBeginWithAndTheRest) {
  const Report report = makeSampleReport();
  const json overview = parseOverview(report);
  const OverviewTable views(overview, "views"), rows(overview, "rows");
  const std::string prefix = views.texts("prefix")[0];
  EXPECT_EQ(prefix, "images/");
  const ViewResult& view = report.scenes[0].views[0];
  const auto paths = [&](std::size_t row) {
    json list = rows.list("images", row);
    for (json& each : list)
      if (each != "") each = prefix + each.get<std::string>();
    return list;
  };
  for (std::size_t m = 0; m < view.materials.size(); ++m) {
    const ImageSet& crops = view.materials[m].crops;
    EXPECT_EQ(paths(m), json({crops.reference, crops.test, crops.flip}));
  }
  EXPECT_EQ(paths(view.materials.size()), json({view.images.reference, view.images.test, view.images.flip}));
  Report one = report; // whose paths begin with nothing less than the whole of one
  one.scenes.resize(1);
  one.scenes[0].views.resize(1);
  one.scenes[0].views[0].images = {"a.png", "a.png", ""};
  for (MaterialResult& material : one.scenes[0].views[0].materials) material.crops = {};
  const json alone = parseOverview(one);
  const OverviewTable only(alone, "rows");
  EXPECT_EQ(OverviewTable(alone, "views").texts("prefix")[0], "a.pn");
  EXPECT_EQ(only.list("images", only.count() - 1), json({"g", "g", ""}));
}

TEST(Overview, HasTheCauseTheLimitsAndWhatWouldHelp) {
  Report report = makeSampleReport();
  MaterialResult& metal = report.scenes[0].views[0].materials[1];
  metal.whatIf = {makeWhatIf("refit", 0.02)};
  metal.whatIf[0].verdict = compare::Verdict::pass;
  const json overview = parseOverview(report);
  const OverviewTable rows(overview, "rows");
  EXPECT_EQ(rows.texts("cause")[1], "skySpecular");
  EXPECT_FLOAT_EQ(static_cast<float>(rows.column("causeBefore")[1]), 0.27f);
  EXPECT_FLOAT_EQ(static_cast<float>(rows.column("causeAfter")[1]), 0.061f);
  EXPECT_EQ(rows.texts("noCause")[1], "");
  EXPECT_EQ(rows.texts("cause")[0], "");
  for (const CauseTotal& total : totalsByCause(report)) // the terminal and the page say the same of each
    if (!causeOf(*total.worst)) {
      const std::vector<std::string> texts = rows.texts("noCause");
      EXPECT_NE(std::ranges::find(texts, total.words), texts.end()) << total.words;
    }
  EXPECT_EQ(rows.texts("better")[1], "refit");
  EXPECT_FLOAT_EQ(static_cast<float>(rows.column("betterFlip")[1]), 0.02f);
  const json& limits = overview["limits"][static_cast<std::size_t>(rows.column("limits")[1])];
  EXPECT_EQ(limits[0], json::parse(R"({"metric": "flip.mean", "warn": 0.1, "fail": 0.2, "verdict": "fail"})"));
}

TEST(Overview, SaysWhatHasChangedSinceTheBaseline) {
  const json overview = parseOverview(makeSampleReportSince());
  const OverviewTable rows(overview, "rows");
  const std::vector<double> before = rows.column("before");
  const auto verdict = static_cast<std::size_t>(before[1]) - 2;
  EXPECT_EQ(overview["verdicts"][verdict], "fail") << "Rough metal";
  EXPECT_NEAR(rows.column("change")[1], 0.07, 1e-6);
  EXPECT_EQ(before[4], 1) << "Bulb is new";
  EXPECT_TRUE(std::isnan(rows.column("change")[4]));
  EXPECT_NE(rows.texts("notComparable").back().find("field of view"), std::string::npos);
}

TEST(Overview, OfNothingIsEmpty) {
  const json overview = parseOverview(Report());
  for (const char* name : {"scenes", "views", "rows"}) EXPECT_EQ(overview[name]["count"], 0);
}

TEST(AgainCommands, AreFoundBySceneAndViewAndByThePathBehindIt) {
  RunInfo run;
  run.again = {{"a", "bc", "first"}, {"ab", "c", "second"}, {"a", "bc", "third"}, {"a", "d (mobile)", "own"}};
  SceneResult scene;
  ViewResult view;
  const AgainCommands again(run);
  const auto find = [&](const char* sceneName, const char* viewName, const MaterialResult* material = nullptr) {
    scene.name = sceneName;
    view.name = viewName;
    return again.of(scene, view, material);
  };
  EXPECT_EQ(find("a", "bc"), "first");
  EXPECT_EQ(find("ab", "c"), "second");
  EXPECT_EQ(find("a", "bc (mobile)"), "first");
  EXPECT_EQ(find("a", "d (mobile)"), "own");
  EXPECT_EQ(find("a", "bc (highend)"), "");
  MaterialResult material;
  material.name = "two words";
  EXPECT_EQ(find("a", "bc", &material), "first --material 'two words'");
}

} // namespace
} // namespace parity::report
