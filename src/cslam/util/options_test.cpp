// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/options.h"

#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace cslam {
namespace {

struct InnerOptions {
  int min_inliers = 30;
  double ratio = 0.75;
};

void Describe(OptionList& list, InnerOptions& o) {
  list.Add("min_inliers", o.min_inliers, {1, 10'000}, "matches", "fewest inliers to trust");
  list.Add("ratio", o.ratio, {0.0, 1.0}, "", "share of matches kept");
}

struct OuterOptions {
  InnerOptions keyframe;
  double search_radius_px = 2.0;
  bool enabled = false;
  std::string camera = "tum_fr1";
};

void Describe(OptionList& list, OuterOptions& o) {
  list.Group("keyframe", o.keyframe);
  list.Add("search_radius_px", o.search_radius_px, {1.0, 3.0}, "px", "radius of the search");
  list.Add("enabled", o.enabled, "whether it runs");
  list.Add("camera", o.camera, "name of a preset");
}

class OptionListTest : public testing::Test {
 protected:
  OptionListTest() { list_.Group("tracking", options_); }

  std::string ErrorOf(std::string_view key, std::string_view text) {
    try {
      list_.Set(key, text);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  OuterOptions options_;
  OptionList list_;
};

TEST_F(OptionListTest, ListsFullKeysInOrderOfDescription) {
  std::vector<std::string> keys;
  for (const OptionEntry& entry : list_.entries())
    keys.push_back(entry.key);
  EXPECT_THAT(keys, testing::ElementsAre("tracking.keyframe.min_inliers", "tracking.keyframe.ratio",
                                         "tracking.search_radius_px", "tracking.enabled",
                                         "tracking.camera"));
}

TEST_F(OptionListTest, SetWritesThroughToTheStruct) {
  list_.Set("tracking.keyframe.min_inliers", "40");
  list_.Set("tracking.search_radius_px", "2.5e0");
  list_.Set("tracking.camera", "my camera.yaml");
  EXPECT_EQ(options_.keyframe.min_inliers, 40);
  EXPECT_EQ(options_.search_radius_px, 2.5);
  EXPECT_EQ(options_.camera, "my camera.yaml");
}

TEST_F(OptionListTest, SetAcceptsTheUsualSpellingsOfBool) {
  for (const char* text : {"true", "True", "yes", "ON", "1"}) {
    options_.enabled = false;
    list_.Set("tracking.enabled", text);
    EXPECT_TRUE(options_.enabled) << text;
  }
  for (const char* text : {"false", "FALSE", "no", "off", "0"}) {
    options_.enabled = true;
    list_.Set("tracking.enabled", text);
    EXPECT_FALSE(options_.enabled) << text;
  }
  EXPECT_EQ(ErrorOf("tracking.enabled", "maybe"),
            "tracking.enabled = 'maybe' is neither true nor false");
}

TEST_F(OptionListTest, SetAcceptsALeadingPlusButNotTwoSigns) {
  list_.Set("tracking.keyframe.min_inliers", "+7");
  EXPECT_EQ(options_.keyframe.min_inliers, 7);
  EXPECT_THROW(list_.Set("tracking.keyframe.min_inliers", "+-7"), Error);
  EXPECT_THROW(list_.Set("tracking.keyframe.min_inliers", "++7"), Error);
}

TEST_F(OptionListTest, SetRefusesTextOfTheWrongTypeAndKeepsTheValue) {
  for (const char* text : {"", "many", "4 0", "40x", "4.5", " 40", "0x10"}) {
    EXPECT_EQ(ErrorOf("tracking.keyframe.min_inliers", text),
              fmt::format("tracking.keyframe.min_inliers = '{}' is not a whole number", text));
  }
  for (const char* text : {"", "wide", "2.0px", "nan", "inf", "-inf", "1e999"}) {
    EXPECT_EQ(ErrorOf("tracking.search_radius_px", text),
              fmt::format("tracking.search_radius_px = '{}' is not a finite number", text));
  }
  EXPECT_EQ(options_.keyframe.min_inliers, 30);
  EXPECT_EQ(options_.search_radius_px, 2.0);
}

TEST_F(OptionListTest, SetNamesRangeAndUnitWhenTheValueIsOutside) {
  EXPECT_EQ(ErrorOf("tracking.search_radius_px", "5"),
            "tracking.search_radius_px = 5 is outside 1 to 3 (px)");
  EXPECT_EQ(ErrorOf("tracking.keyframe.ratio", "-0.5"),
            "tracking.keyframe.ratio = -0.5 is outside 0 to 1");
  EXPECT_EQ(ErrorOf("tracking.keyframe.min_inliers", "99999999999999"),
            "tracking.keyframe.min_inliers = 99999999999999 is outside 1 to 10000 (matches)");
}

TEST_F(OptionListTest, SetAcceptsBothEndsOfTheRange) {
  list_.Set("tracking.search_radius_px", "1");
  list_.Set("tracking.search_radius_px", "3");
  EXPECT_EQ(options_.search_radius_px, 3.0);
}

TEST_F(OptionListTest, SetNamesTheNearestKeyWhenThereIsNone) {
  EXPECT_EQ(ErrorOf("traking.camera", "x"),
            "unknown option 'traking.camera'; did you mean 'tracking.camera'?");
  EXPECT_EQ(ErrorOf("min_inliers", "1"),
            "unknown option 'min_inliers'; did you mean 'tracking.keyframe.min_inliers'?");
}

TEST(OptionList, SetSaysUnknownWhenTheListIsEmpty) {
  OptionList list;
  EXPECT_THROW(list.Set("a", "b"), Error);
}

TEST_F(OptionListTest, CheckRangesPassesForDefaultsAndNamesTheFirstBadValue) {
  EXPECT_NO_THROW(list_.CheckRanges());
  options_.search_radius_px = 0.5;
  EXPECT_THAT(
      [this] { list_.CheckRanges(); },
      testing::ThrowsMessage<Error>("tracking.search_radius_px = 0.5 is outside 1 to 3 (px)"));
  options_.search_radius_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(list_.CheckRanges(), Error);
}

TEST(OptionList, AddRefusesADoubleKeyAndAnEmptyRange) {
  int value = 1;
  OptionList list;
  list.Add("a", value, {0, 2}, "", "first");
  EXPECT_THROW(list.Add("a", value, {0, 2}, "", "again"), InternalError);
  EXPECT_THROW(list.Add("b", value, {2, 0}, "", "empty"), InternalError);
}

TEST_F(OptionListTest, FormatValueIsReadBackWithoutLoss) {
  const OptionEntry& radius = list_.entries()[2];
  for (const double value : {1.0, 1.1, 1.0 + 0x1p-52, 4.0 / 3.0, 2.9999999999999996}) {
    options_.search_radius_px = value;
    const std::string text = FormatValue(radius);
    options_.search_radius_px = 0.0;
    list_.Set(radius.key, text);
    EXPECT_EQ(options_.search_radius_px, value) << text;
  }
  EXPECT_EQ(FormatValue(list_.entries()[0]), "30");
  EXPECT_EQ(FormatValue(list_.entries()[1]), "0.75");
  EXPECT_EQ(FormatValue(list_.entries()[3]), "false");
  EXPECT_EQ(FormatValue(list_.entries()[4]), "tum_fr1");
}

TEST(NearestName, FindsInsertionsDeletionsSubstitutionsAndSwaps) {
  const std::vector<std::string> names = {"config", "dataset", "eval", "run"};
  EXPECT_EQ(NearestName("confg", names), "config");
  EXPECT_EQ(NearestName("datasets", names), "dataset");
  EXPECT_EQ(NearestName("rum", names), "run");
  EXPECT_EQ(NearestName("eavl", names), "eval");
  EXPECT_EQ(NearestName("run", names), "run");
  EXPECT_EQ(NearestName("run", {}), "");
}

TEST(NearestName, CountsASwapOfNeighboursAsOneEdit) {
  EXPECT_EQ(NearestName("abdc", {"abxy", "abcd"}), "abcd");
  EXPECT_EQ(NearestName("ab", {"a", "ba"}), "a");  // a tie: the first one stands
}

TEST(NearestName, PrefersTheLastComponentOverTheGroup) {
  const std::vector<std::string> keys = {"mapping.min_inliers", "tracking.max_angle_rad",
                                         "tracking.keyframe.min_inliers"};
  EXPECT_EQ(NearestName("tracking.keyframes.min_inliers", keys), "tracking.keyframe.min_inliers");
  EXPECT_EQ(NearestName("max_angle", keys), "tracking.max_angle_rad");
  EXPECT_EQ(NearestName("mapping.min_inlier", keys), "mapping.min_inliers");
}

}  // namespace
}  // namespace cslam
