// What a ground truth adds to index.html, and that nothing of it is there without one.
#include "compare/html_reader.h"
#include "compare/report.h"
#include "compare/sample_report.h"

namespace parity::compare {
namespace {

std::string page(const Report& report) { return toHtml(report, makeSampleRun()); }

TEST(HtmlTruth, AddsPicturesFiguresAndTerms) {
  const auto document = parse(page(makeSampleReportWithTruth()));
  const auto rows = select(document, "//section[@id='scene-1-view-1']//article[@data-name='Rough metal']");
  ASSERT_EQ(rows.size(), 1u);
  const pugi::xml_node row = rows[0].node();
  const auto textsOf = [&](const char* path) {
    std::vector<std::string> texts;
    for (const auto& node : row.select_nodes(path)) texts.emplace_back(node.node().text().get());
    return texts;
  };
  const std::vector<std::string> captions = {"Truth",
                                             "High-end",
                                             "Mobile",
                                             "FLIP, mobile against high-end",
                                             "FLIP, high-end against truth",
                                             "FLIP, mobile against truth"};
  EXPECT_EQ(textsOf(".//figcaption"), captions);
  std::vector<std::string> files;
  for (const auto& node : row.select_nodes(".//figure/a")) files.emplace_back(node.node().attribute("href").value());
  const std::vector<std::string> expected = {"images/t.png",          "images/metal_ref.png", "images/metal_test.png",
                                             "images/metal_flip.png", "images/h.png",         "images/m.png"};
  EXPECT_EQ(files, expected);

  EXPECT_EQ(textsOf(".//div[@class='truth']/table/thead/tr/th"),
            (std::vector<std::string>{"interior", "high-end", "mobile"}));
  EXPECT_EQ(textsOf(".//div[@class='truth']//tr[th='flip.mean']/td"), (std::vector<std::string>{"0.090", "0.270"}));
  EXPECT_EQ(textsOf(".//div[@class='truth']//tr[th='relmse']/td"), (std::vector<std::string>{"0.013", "0.04"}));
  EXPECT_EQ(textsOf(".//div[@class='truth']/p[@class='aside']"),
            (std::vector<std::string>{
                "The truth's luma is 0.420; its standard error 1.1 % in the median, 2 % at worst, which "
                "alone gives relMSE 0.0001; 420 samples a pixel in each way."}));
  EXPECT_EQ(row.select_nodes(".//details[contains(@class,'terms')]").size(), 1u) << "not also the plain terms";
  EXPECT_EQ(textsOf(".//details//tr[th='skySpecular']/td"),
            (std::vector<std::string>{"0.3000", "0.2700", "0.1500", "-6.0 %", "-30.0 %", "0.120", "0.340", "0.012",
                                      "0.034"}));
  EXPECT_EQ(textsOf(".//details/p"),
            (std::vector<std::string>{"Black in all three: sunDiffuse, localDiffuse, localSpecular, "
                                      "lightmap, skyDiffuse, emissive, fog."}));
  EXPECT_STREQ(row.attribute("data-truth").value(), "0.090000");
  EXPECT_EQ(select(document, "//select[@id='sort']/option[@value='truth']").size(), 1u);
  EXPECT_EQ(select(document, "//table[@class='overview']//th").size(), 9u);
  EXPECT_EQ(select(document, "//table[@class='overview']//tr[td/@colspan='7']").size(), 1u);
  EXPECT_EQ(select(document, "//article[@data-name='Glass']//ul[@class='warnings']/li").size(), 2u) << "a note a view";
  EXPECT_EQ(select(document, "//article[@data-name='Screw']//div[@class='truth']").size(), 0u) << "not seen";
  EXPECT_NE(page(makeSampleReportWithTruth()).find("Truth: exact integrals, multiple scattering</p>"),
            std::string::npos);
  for (const char* word : {"Truth:", "gainst the truth", "against truth", "data-truth"})
    EXPECT_EQ(page(makeSampleReport()).find(word), std::string::npos) << word;
}

} // namespace
} // namespace parity::compare
