// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/benchmark/report_text.h"

#include "cslam/benchmark/test_result.h"
#include "cslam/benchmark/top_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cslam {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(FormatMarkdown, ShowsMediansWithTheirSpreadAndOtherSystems) {
  const std::string text = FormatMarkdown(test::TwoSeeds());
  EXPECT_THAT(text, HasSubstr("| onechair | 12.0 (10.0 to 14.0) | 60.0 (50.0 to 70.0) | 0.20 |"));
  EXPECT_THAT(text, HasSubstr("| ORB <3> |"));
  EXPECT_THAT(text, HasSubstr("| 100.0 |"));
  EXPECT_THAT(text, Not(HasSubstr("What failed")));
}

TEST(FormatMarkdown, NamesWhatFailed) {
  BenchmarkResult result = test::TwoSeeds();
  result.runs[1].figures.reset();
  result.runs[1].problem = "ended with exit code 1";
  EXPECT_THAT(FormatMarkdown(result),
              HasSubstr("| onechair-short-1-objects_off-1 | ended with exit code 1 |"));
}

TEST(FormatHtml, HoldsItsDrawingsAndEscapesText) {
  const std::string drawing = "<?xml version=\"1.0\"?>\n<svg>drawn</svg>\n";
  const std::string html = FormatHtml(test::TwoSeeds(), {{"a & b", drawing, ""}});
  EXPECT_THAT(html, HasSubstr("<svg>drawn</svg>"));
  EXPECT_THAT(html, Not(HasSubstr("<?xml")));
  EXPECT_THAT(html, HasSubstr("a &amp; b"));
  EXPECT_THAT(html, HasSubstr("ORB &lt;3&gt;"));
}

TEST(FormatJson, HasEveryRunAndNullForWhatWasNotMeasured) {
  const auto json = nlohmann::json::parse(FormatJson(test::TwoSeeds()));
  EXPECT_EQ(json.at("runs").size(), 4U);
  EXPECT_DOUBLE_EQ(json.at("runs").at(1).at("figures").at("ate_m").get<double>(), 0.05);
  EXPECT_TRUE(json.at("runs").at(0).at("figures").at("object_f1").is_null());
  EXPECT_EQ(json.at("sequences").at(0).at("objects_on").at("ate_m").at("count"), 2);
}

TEST(FormatTopViewSvg, DrawsBoxesByTheirOutlineAndCountsGhosts) {
  TopView view;
  view.title = "onechair";
  view.path = {{0.0, 0.0, 1.0}, {2.0, 1.0, 1.0}};
  view.ghosts = {{1.0, 0.5, 0.5}};
  view.present = {{{.T_world_box = {}, .size_m = {1.0, 1.0, 1.0}}, "chair"}};
  const std::string svg = FormatTopViewSvg(view);
  EXPECT_THAT(svg, HasSubstr("ghost (1)"));
  EXPECT_THAT(svg, HasSubstr(">chair<"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(FormatTopViewSvg({}), HasSubstr("</svg>"));
}

}  // namespace
}  // namespace cslam
