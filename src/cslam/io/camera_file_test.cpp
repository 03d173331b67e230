// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/camera_file.h"

#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cslam {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

constexpr const char* kGood =
    "width: 320\nheight: 240\nfx: 250.5\nfy: 251\ncx: 160\ncy: 120\ndepth_scale: 1000\n";

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// The complaint about a camera file, without the folder in front of its name.
std::string Complaint(const std::string& content) {
  const TestFolder folder;
  const auto file = folder.Write("camera.yaml", content);
  std::string message = MessageOf([&] { ReadCameraFile(file); });
  const std::size_t name = message.find("camera.yaml");
  return name == std::string::npos ? message : message.substr(name);
}

TEST(CameraPresets, AreValidAndNamedOnce) {
  for (const CameraConfig& preset : CameraPresets()) {
    EXPECT_EQ(WhyInvalid(preset.camera), "") << preset.name;
    EXPECT_EQ(FindCameraPreset(preset.name)->camera, preset.camera);
  }
  EXPECT_EQ(FindCameraPreset("tum_fr4"), std::nullopt);
  EXPECT_EQ(DescribeCameraPresets(), "tum_fr1, tum_fr2, tum_fr3, bonn, d435i (approximate)");
}

TEST(ReadCameraFile, TakesRequiredAndOptionalKeys) {
  const TestFolder folder;
  const auto file = folder.Write("my.yaml", std::string("# mine\n") + kGood + "p2: -1.5e-3\n");
  const CameraConfig config = ReadCameraFile(file);
  EXPECT_EQ(config.camera.width, 320);
  EXPECT_EQ(config.camera.height, 240);
  EXPECT_EQ(config.camera.fx, 250.5);
  EXPECT_EQ(config.camera.p2, -1.5e-3);
  EXPECT_EQ(config.camera.k1, 0.0);
  EXPECT_EQ(config.depth_units_per_m, 1000.0);
  EXPECT_EQ(config.name, "my.yaml");
}

TEST(ReadCameraFile, TakesBackWhatWasWrittenWithoutLoss) {
  const TestFolder folder;
  CameraConfig config = *FindCameraPreset("tum_fr1");
  config.camera.fx = 517.3 + 1e-13;
  config.name = "odd \"name\": #1";
  WriteCameraFile(folder / "camera.yaml", config);
  const CameraConfig back = ReadCameraFile(folder / "camera.yaml");
  EXPECT_EQ(back.camera, config.camera);
  EXPECT_EQ(back.depth_units_per_m, config.depth_units_per_m);
  EXPECT_EQ(back.name, config.name);
}

TEST(ReadCameraFile, NamesTheNearestKeyForAnUnknownOne) {
  EXPECT_EQ(Complaint(Replaced(kGood, "depth_scale", "depthscale")),
            "camera.yaml:7: unknown key 'depthscale'; did you mean 'depth_scale'?");
}

TEST(ReadCameraFile, NamesTheMissingKey) {
  EXPECT_EQ(Complaint(Replaced(kGood, "cy: 120\n", "")), "camera.yaml: 'cy' is missing");
}

TEST(ReadCameraFile, RefusesValuesThatAreNoFiniteNumberWithTheirLine) {
  EXPECT_EQ(Complaint(Replaced(kGood, "250.5", ".nan")),
            "camera.yaml:3: fx must be a finite number, found '.nan'");
  EXPECT_THAT(Complaint(Replaced(kGood, "250.5", "nan")), HasSubstr(":3: fx must be a finite"));
  EXPECT_THAT(Complaint(Replaced(kGood, "250.5", "inf")), HasSubstr(":3: fx must be a finite"));
  EXPECT_THAT(Complaint(Replaced(kGood, "250.5", "250,5")), HasSubstr(":3: fx must be a finite"));
  EXPECT_THAT(Complaint(Replaced(kGood, "250.5", "")), HasSubstr(":3:"));
  EXPECT_THAT(Complaint(Replaced(kGood, "250.5", "[1, 2]")), HasSubstr(":3: 'fx' needs a single"));
}

TEST(ReadCameraFile, RefusesValuesOutOfRange) {
  EXPECT_THAT(Complaint(Replaced(kGood, "250.5", "-250.5")), HasSubstr("must be positive"));
  EXPECT_THAT(Complaint(Replaced(kGood, "320", "320.5")), HasSubstr(":1: width must be a whole"));
  EXPECT_THAT(Complaint(Replaced(kGood, "320", "1e300")), HasSubstr(":1: width must be a whole"));
  EXPECT_THAT(Complaint(Replaced(kGood, "1000", "0")), HasSubstr(":7: depth_scale 0 is outside"));
}

TEST(ReadCameraFile, RefusesAKeyGivenTwice) {
  EXPECT_EQ(Complaint(std::string(kGood) + "fx: 1\n"),
            "camera.yaml:8: 'fx' is already given in line 3");
}

TEST(ReadCameraFile, RefusesWhatIsNoYamlMapWithTheLine) {
  EXPECT_THAT(Complaint("fx: [1\nfy: 2\n"), HasSubstr("camera.yaml:2: "));
  EXPECT_THAT(Complaint("hello"), HasSubstr("expected lines 'key: value'"));
  EXPECT_THAT(Complaint(""), HasSubstr("expected lines 'key: value'"));
}

TEST(ReadCameraFile, SaysWhyTheFileCannotBeRead) {
  const TestFolder folder;
  EXPECT_THAT(MessageOf([&] { ReadCameraFile(folder / "none.yaml"); }),
              AllOf(HasSubstr("cannot read camera file"), EndsWith("No such file or directory")));
}

TEST(ResolveCamera, PrefersTheArgumentToTheFolder) {
  const TestFolder folder;
  folder.Write("fr2/camera.yaml", kGood);
  const auto other = folder.Write("other.yaml", Replaced(kGood, "250.5", "300"));
  EXPECT_EQ(ResolveCamera(folder / "fr2", {.camera = "bonn", .depth_units_per_m = {}}).name,
            "bonn");
  const CameraConfig by_file =
      ResolveCamera(folder / "fr2", {.camera = other.string(), .depth_units_per_m = {}});
  EXPECT_EQ(by_file.camera.fx, 300.0);
  EXPECT_THAT(by_file.source, HasSubstr("--camera"));
}

TEST(ResolveCamera, PrefersTheFoldersFileToItsName) {
  const TestFolder folder;
  folder.Write("fr2/camera.yaml", kGood);
  const CameraConfig config = ResolveCamera(folder / "fr2", {});
  EXPECT_EQ(config.camera.fx, 250.5);
  EXPECT_EQ(config.source, "camera.yaml in the folder");
}

struct NameCase {
  const char* folder;
  const char* preset;  // null: none
};

class ResolveCameraByName : public testing::TestWithParam<NameCase> {};

TEST_P(ResolveCameraByName, FindsThePresetTheNameSpeaksOf) {
  const std::filesystem::path folder(GetParam().folder);
  if (GetParam().preset == nullptr) {
    EXPECT_THROW(ResolveCamera(folder, {}), Error);
  } else {
    EXPECT_EQ(ResolveCamera(folder, {}).name, GetParam().preset);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Names, ResolveCameraByName,
    testing::Values(NameCase{"/d/tum_fr1_desk", "tum_fr1"},
                    NameCase{"/d/rgbd_dataset_freiburg2_xyz/", "tum_fr2"},
                    NameCase{"/d/RGBD_Dataset_Freiburg3_sitting", "tum_fr3"},
                    NameCase{"/d/rgbd_bonn_crowd", "bonn"}, NameCase{"/bonn/crowd", "bonn"},
                    NameCase{"/bonn/a/b", nullptr}, NameCase{"/bonn/fr1", "tum_fr1"},
                    NameCase{"/d/fr1/../fr2/.", "tum_fr2"}, NameCase{"/d/fr1_against_fr2", nullptr},
                    NameCase{"/d/fr10", nullptr}, NameCase{"/d/kitchen", nullptr},
                    NameCase{"/", nullptr}));

TEST(ResolveCamera, ListsThePresetsWhenNoneApplies) {
  EXPECT_THAT(MessageOf([] { ResolveCamera("/d/kitchen", {}); }),
              AllOf(HasSubstr("/d/kitchen"), HasSubstr("--camera"),
                    HasSubstr("tum_fr1, tum_fr2, tum_fr3, bonn, d435i (approximate)")));
  EXPECT_THAT(
      MessageOf([] { ResolveCamera("/d/fr1", {.camera = "tum_fr9", .depth_units_per_m = {}}); }),
      AllOf(HasSubstr("'tum_fr9' is neither a file nor a preset"), HasSubstr("tum_fr1")));
}

TEST(ResolveCamera, OverridesTheDepthScaleWithinReason) {
  EXPECT_EQ(ResolveCamera("/d/fr1", {.camera = "", .depth_units_per_m = 1000.0}).depth_units_per_m,
            1000.0);
  for (const double bad : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(ResolveCamera("/d/fr1", {.camera = "", .depth_units_per_m = bad}), Error) << bad;
  }
}

}  // namespace
}  // namespace cslam
