// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/config.h"

#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace cslam {
namespace {

struct KeyframeOptions {
  int min_inliers = 30;
  double ratio = 0.75;
};

void Describe(OptionList& list, KeyframeOptions& o) {
  list.Add("min_inliers", o.min_inliers, {1, 10'000}, "matches", "fewest inliers to trust");
  list.Add("ratio", o.ratio, {0.0, 1.0}, "", "share of matches | kept");
}

struct TrackingOptions {
  KeyframeOptions keyframe;
  double search_radius_px = 2.0;
  bool enabled = false;
};

void Describe(OptionList& list, TrackingOptions& o) {
  list.Group("keyframe", o.keyframe);
  list.Add("search_radius_px", o.search_radius_px, {1.0, 3.0}, "px", "radius of the search");
  list.Add("enabled", o.enabled, "whether it runs");
}

struct TestOptions {
  TrackingOptions tracking;
  std::string camera = "tum_fr1";
};

void Describe(OptionList& list, TestOptions& o) {
  list.Group("tracking", o.tracking);
  list.Add("camera", o.camera, "name of a preset");
}

OptionList ListOf(TestOptions& options) {
  OptionList list;
  Describe(list, options);
  return list;
}

class ConfigTest : public testing::Test {
 protected:
  ConfigTest() {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) /
            fmt::format("cslam_config_{}.yaml", info->name());
  }
  ~ConfigTest() override { std::filesystem::remove(path_); }

  void Write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

  TestOptions Load(const std::string& text) const {
    Write(text);
    TestOptions options;
    OptionList list = ListOf(options);
    LoadYaml(path_, list);
    return options;
  }

  // What LoadYaml() says to the text, without the path in front: ":line: message".
  std::string ErrorOf(const std::string& text) const {
    try {
      Load(text);
    } catch (const Error& error) {
      const std::string message = error.what();
      if (!message.starts_with(path_.string())) return "does not name the file: " + message;
      return message.substr(path_.string().size());
    }
    return "no error";
  }

  std::filesystem::path path_;
};

TEST_F(ConfigTest, LoadYamlSetsWhatTheFileNamesAndKeepsTheRest) {
  const TestOptions options = Load(
      "# a comment\n"
      "tracking:\n"
      "  keyframe: {min_inliers: 40}\n"
      "  enabled: yes\n"
      "camera: 'my camera.yaml'\n");
  EXPECT_EQ(options.tracking.keyframe.min_inliers, 40);
  EXPECT_EQ(options.tracking.keyframe.ratio, 0.75);
  EXPECT_TRUE(options.tracking.enabled);
  EXPECT_EQ(options.camera, "my camera.yaml");
}

TEST_F(ConfigTest, LoadYamlAcceptsDottedKeys) {
  EXPECT_EQ(Load("tracking.keyframe.min_inliers: 41\n").tracking.keyframe.min_inliers, 41);
}

TEST_F(ConfigTest, LoadYamlAcceptsAnEmptyFileAndAnEmptyGroup) {
  EXPECT_NO_THROW(Load(""));
  EXPECT_NO_THROW(Load("# nothing\n"));
  EXPECT_NO_THROW(Load("tracking:\n#  enabled: true\n"));
}

TEST_F(ConfigTest, LoadYamlNamesTheLineAndTheNearestKeyWhenAKeyIsUnknown) {
  EXPECT_EQ(ErrorOf("tracking:\n  keyframe:\n    min_inlier: 40\n"),
            ":3: unknown option 'tracking.keyframe.min_inlier'; did you mean "
            "'tracking.keyframe.min_inliers'?");
  EXPECT_EQ(ErrorOf("\ntraking:\n  enabled: true\n"),
            ":2: unknown option 'traking'; did you mean 'tracking'?");
}

TEST_F(ConfigTest, LoadYamlNamesTheLineWhenAValueIsOfTheWrongTypeOrOutsideItsRange) {
  EXPECT_EQ(ErrorOf("tracking:\n  keyframe:\n    min_inliers: many\n"),
            ":3: tracking.keyframe.min_inliers = 'many' is not a whole number");
  EXPECT_EQ(ErrorOf("tracking:\n  enabled: true\n  search_radius_px: 5\n"),
            ":3: tracking.search_radius_px = 5 is outside 1 to 3 (px)");
  EXPECT_EQ(ErrorOf("tracking:\n  search_radius_px: .nan\n"),
            ":2: tracking.search_radius_px = '.nan' is not a finite number");
}

TEST_F(ConfigTest, LoadYamlRefusesAKeyThatIsSetTwice) {
  EXPECT_EQ(ErrorOf("camera: a\ntracking:\n  enabled: true\ncamera: b\n"),
            ":4: 'camera' is set again; the first time in line 1");
  EXPECT_EQ(ErrorOf("tracking: {enabled: true}\ntracking.enabled: false\n"),
            ":2: 'tracking.enabled' is set again; the first time in line 1");
}

TEST_F(ConfigTest, LoadYamlRefusesTheWrongKindOfNode) {
  EXPECT_EQ(ErrorOf("tracking: 5\n"), ":1: 'tracking' is a group, not a value");
  EXPECT_EQ(ErrorOf("camera: [a, b]\n"), ":1: 'camera' takes one plain value");
  EXPECT_EQ(ErrorOf("camera: {a: b}\n"), ":1: 'camera' takes one plain value");
  EXPECT_EQ(ErrorOf("camera:\n"), ":1: 'camera' has no value");
  EXPECT_EQ(ErrorOf("? [a]\n: b\n"), ":1: a key must be a plain name");
  EXPECT_THAT(ErrorOf("- a\n- b\n"), testing::StartsWith(":1: expected 'name: value' lines"));
  EXPECT_THAT(ErrorOf("camera: a\n---\ncamera: b\n"), testing::HasSubstr("second YAML document"));
}

TEST_F(ConfigTest, LoadYamlSaysOneLineWhenTheYamlIsBroken) {
  const std::string error = ErrorOf("camera: a\ntracking: {enabled: true\n");
  EXPECT_THAT(error, testing::ContainsRegex("^:[0-9]+: broken YAML: "));
  EXPECT_THAT(error, testing::Not(testing::HasSubstr("\n")));
}

TEST_F(ConfigTest, LoadYamlSurvivesAnAliasThatContainsItself) {
  EXPECT_EQ(ErrorOf("tracking: &x\n  keyframe: *x\n"),
            ":2: unknown option 'tracking.keyframe.keyframe'; did you mean 'tracking.keyframe'?");
}

TEST_F(ConfigTest, LoadYamlNamesTheFileThatIsMissingOrAFolder) {
  TestOptions options;
  OptionList list = ListOf(options);
  EXPECT_THAT([&] { LoadYaml("/no/such.yaml", list); },
              testing::ThrowsMessage<Error>(testing::AllOf(testing::HasSubstr("/no/such.yaml"),
                                                           testing::HasSubstr("No such file"))));
  EXPECT_THAT([&] { LoadYaml(testing::TempDir(), list); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("is a folder")));
}

TEST_F(ConfigTest, DumpYamlIsReadBackWithoutLoss) {
  TestOptions options;
  options.tracking.keyframe = {77, 1.0 / 3.0};
  options.tracking.search_radius_px = 1.0 + 0x1p-52;
  options.tracking.enabled = true;
  options.camera = "a \"quoted\" \\ name: # with\ttab, \n line and \xC3\xA9";
  const std::string text = DumpYaml(ListOf(options));
  TestOptions loaded = Load(text);
  EXPECT_EQ(loaded.tracking.keyframe.min_inliers, 77);
  EXPECT_EQ(loaded.tracking.keyframe.ratio, options.tracking.keyframe.ratio);
  EXPECT_EQ(loaded.tracking.search_radius_px, options.tracking.search_radius_px);
  EXPECT_TRUE(loaded.tracking.enabled);
  EXPECT_EQ(loaded.camera, options.camera);
  EXPECT_EQ(DumpYaml(ListOf(loaded)), text);
}

TEST_F(ConfigTest, DumpYamlNestsGroupsAndTellsMeaningRangeAndUnit) {
  TestOptions options;
  EXPECT_EQ(DumpYaml(ListOf(options)),
            "tracking:\n"
            "  keyframe:\n"
            "    min_inliers: 30  # fewest inliers to trust (1 to 10000 matches)\n"
            "    ratio: 0.75  # share of matches | kept (0 to 1)\n"
            "  search_radius_px: 2  # radius of the search (1 to 3 px)\n"
            "  enabled: false  # whether it runs\n"
            "camera: \"tum_fr1\"  # name of a preset\n");
}

TEST_F(ConfigTest, DumpYamlJoinsAGroupThatIsDescribedInTwoPlaces) {
  TrackingOptions first;
  KeyframeOptions second;
  std::string camera;
  OptionList list;
  list.Group("tracking", first);
  list.Add("camera", camera, "name of a preset");
  list.Group("tracking.more", second);
  const std::string text = DumpYaml(list);
  Write(text);
  EXPECT_NO_THROW(LoadYaml(path_, list)) << text;
}

TEST(ApplyOverrides, SetsInOrderSoThatTheLastOneWins) {
  TestOptions options;
  OptionList list = ListOf(options);
  ApplyOverrides({"tracking.enabled=true", "camera=a", "camera=b=c", "tracking.enabled=false"},
                 list);
  EXPECT_EQ(options.camera, "b=c");
  EXPECT_FALSE(options.tracking.enabled);
}

TEST(ApplyOverrides, SaysWhatIsExpectedWhenThereIsNoEqualsSign) {
  TestOptions options;
  OptionList list = ListOf(options);
  EXPECT_THAT([&] { ApplyOverrides({"camera"}, list); },
              testing::ThrowsMessage<Error>("cannot set 'camera': expected key=value"));
  EXPECT_THROW(ApplyOverrides({"=5"}, list), Error);
  EXPECT_THROW(ApplyOverrides({""}, list), Error);
}

TEST(DumpTable, ShowsTheDefaultBesideAChangedValueOnly) {
  TestOptions options;
  TestOptions defaults;
  options.tracking.search_radius_px = 2.5;
  const std::string table = DumpTable(ListOf(options), ListOf(defaults));
  EXPECT_THAT(table, testing::StartsWith("option "));
  EXPECT_THAT(table, testing::HasSubstr("2.5 (default 2)"));
  EXPECT_THAT(table, testing::Not(testing::HasSubstr("(default 30)")));
  EXPECT_THAT(table, testing::HasSubstr("1 to 10000"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7);  // titles, a rule and five options
}

TEST(DumpMarkdown, ListsEveryOptionOnceAndEscapesBars) {
  TestOptions options;
  const OptionList list = ListOf(options);
  const std::string page = DumpMarkdown(list);
  for (const OptionEntry& entry : list.entries()) {
    const std::size_t first = page.find("| `" + entry.key + "` |");
    ASSERT_NE(first, std::string::npos) << entry.key;
    EXPECT_EQ(page.find("| `" + entry.key + "` |", first + 1), std::string::npos) << entry.key;
  }
  EXPECT_THAT(page, testing::HasSubstr("share of matches \\| kept"));
}

}  // namespace
}  // namespace cslam
