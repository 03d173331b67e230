// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/model_store.h"

#include "cslam/io/truth_files.h"
#include "cslam/semantics/make_detector.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace cslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kYaml = "decoder: nanodet-plus\nwidth: 416\nheight: 320\n";

std::vector<std::filesystem::path> FoldersFor(const std::map<std::string, std::string>& set) {
  return ModelFolders([&](const char* name) -> const char* {
    const auto found = set.find(name);
    return found == set.end() ? nullptr : found->second.c_str();
  });
}

void AddModel(const TestFolder& folder, const std::string& name) {
  folder.Write(name + ".yaml", kYaml);
  folder.Write(name + ".onnx", "");
}

TEST(ModelFolders, FollowTheXdgVariables) {
  EXPECT_THAT(FoldersFor({{"HOME", "/home/me"}, {"XDG_DATA_DIRS", "/a::/b"}}),
              ElementsAre("/home/me/.local/share/changing-slam/models", "/a/changing-slam/models",
                          "/b/changing-slam/models"));
  EXPECT_THAT(FoldersFor({{"HOME", "/home/me"}, {"XDG_DATA_HOME", "/data"}}),
              ElementsAre("/data/changing-slam/models", "/usr/local/share/changing-slam/models",
                          "/usr/share/changing-slam/models"));
  EXPECT_EQ(FoldersFor({}).size(), 2U);
}

TEST(FindModel, FindsByNameInTheFirstFolderThatHasIt) {
  const TestFolder folder;
  folder.Write("a/x.yaml", kYaml);
  folder.Write("a/x.onnx", "");
  folder.Write("b/x.yaml", kYaml);
  folder.Write("b/y.yaml", kYaml);
  folder.Write("b/y.onnx", "");
  const std::vector<std::filesystem::path> folders = {folder / "none", folder / "a", folder / "b"};
  EXPECT_EQ(FindModel("x", folders).description_file, folder / "a/x.yaml");
  EXPECT_EQ(FindModel("y", folders).onnx_file, folder / "b/y.onnx");
  EXPECT_EQ(ListModels(folders).size(), 2U);
}

TEST(FindModel, FindsByPathOfEitherFile) {
  const TestFolder folder;
  AddModel(folder, "x");
  EXPECT_EQ(FindModel((folder / "x.onnx").string(), {}).name, "x");
  EXPECT_EQ(FindModel((folder / "x.yaml").string(), {}).name, "x");
  EXPECT_THAT(MessageOf([&] { FindModel((folder / "z.onnx").string(), {}); }),
              HasSubstr("there is no model file"));
}

TEST(FindModel, SaysHowToGetAModel) {
  const TestFolder folder;
  EXPECT_THAT(MessageOf([&] { FindModel("nanodet-g", {folder.path()}); }),
              HasSubstr("'changing-slam model install'"));
  AddModel(folder, "x");
  EXPECT_THAT(MessageOf([&] { FindModel("nanodet-g", {folder.path()}); }),
              HasSubstr("installed: x"));
  folder.Write("half.yaml", kYaml);
  EXPECT_THAT(MessageOf([&] { FindModel("half", {folder.path()}); }), HasSubstr("half.onnx"));
}

TEST(FindBestModel, PrefersTheBetterKnownModel) {
  const TestFolder folder;
  EXPECT_FALSE(FindBestModel({folder.path()}));
  AddModel(folder, "another");
  EXPECT_EQ(FindBestModel({folder.path()})->name, "another");
  AddModel(folder, "nanodet-g");
  EXPECT_EQ(FindBestModel({folder.path()})->name, "nanodet-g");
  AddModel(folder, "nanodet-plus-m");
  EXPECT_EQ(FindBestModel({folder.path()})->name, "nanodet-plus-m");
  folder.Write("nanodet-plus-m.yaml", "decoder: nothing\n");
  EXPECT_EQ(FindBestModel({folder.path()})->name, "nanodet-g");
}

TEST(ListModels, SaysWhatIsWrongWithAModel) {
  const TestFolder folder;
  folder.Write("bad.yaml", "decoder: nothing\n");
  const auto models = ListModels({folder.path()});
  ASSERT_EQ(models.size(), 1U);
  EXPECT_FALSE(models[0].description);
  EXPECT_THAT(models[0].problem, HasSubstr("decoder 'nothing'"));
}

TEST(MakeDetector, RefusesWhatItDoesNotKnowOrCannotCombine) {
  DetectorOptions options;
  options.kind = "magic";
  EXPECT_THAT(MessageOf([&] { MakeDetector(options); }), HasSubstr("unknown detector 'magic'"));
  options.kind = "recorded";
  EXPECT_THAT(MessageOf([&] { MakeDetector(options); }), HasSubstr("--detections FILE"));
  options.kind = "none";
  EXPECT_EQ(MakeDetector(options).detector->info().kind, "none");
  options.detections = "d.json";
  EXPECT_THAT(MessageOf([&] { MakeDetector(options); }), HasSubstr("is for detector 'recorded'"));
}

TEST(MakeDetector, ReadsRecordedDetectionsFromTheirFile) {
  const TestFolder folder;
  DetectionRecord record{.sequence = "walking", .width_px = 64, .height_px = 48, .frames = {}};
  record.frames.push_back({Stamp{1'000'000'000}, {}});
  record.frames[0].detections.push_back(
      {.instance = 1, .class_id = 0, .score = 1.0, .box = {10, 10, 20, 40}, .visible_px = 300});
  WriteDetections(folder / "detections.json", record);
  DetectorOptions options;
  options.kind = "recorded";
  options.detections = (folder / "detections.json").string();
  const MadeDetector made = MakeDetector(options);
  EXPECT_EQ(made.warning, "");
  EXPECT_EQ(made.detector->info().source, options.detections);
  RgbdFrame frame;
  frame.stamp = Stamp{1'000'000'000};
  frame.gray = cv::Mat(48, 64, CV_8UC1);
  const Detections found = made.detector->Detect(frame);
  ASSERT_EQ(found.objects.size(), 1U);
  EXPECT_EQ(found.objects[0].box, (Box{10, 10, 20, 40}));
  options.person_threshold = 0.95;
  EXPECT_EQ(MakeDetector(options).detector->Detect(frame).objects.size(), 1U);
  options.class_thresholds = "person=1.5";
  EXPECT_TRUE(MakeDetector(options).detector->Detect(frame).objects.empty());
  options.detections = (folder / "none.json").string();
  EXPECT_THAT(MessageOf([&] { MakeDetector(options); }), HasSubstr("none.json"));
}

}  // namespace
}  // namespace cslam
