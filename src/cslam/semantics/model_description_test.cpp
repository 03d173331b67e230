// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/model_description.h"

#include "cslam/semantics/detection.h"
#include "cslam/semantics/detector_options.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ReadModelDescription, FillsInWhatADecodersModelsShare) {
  const TestFolder folder;
  const auto file =
      folder.Write("m.yaml",
                   "decoder: nanodet-plus\nwidth: 416\nheight: 320\n"
                   "thresholds:\n  default: 0.5\n  person: 0.3\n  dining_table: 0.6\n");
  const ModelDescription model = ReadModelDescription(folder / "m.onnx");
  EXPECT_EQ(model.name, "m");
  EXPECT_EQ(model.description_file, file);
  EXPECT_EQ(model.onnx_file, folder / "m.onnx");
  EXPECT_EQ(model.decoder, DecoderKind::kNanoDetPlus);
  EXPECT_EQ(model.width_px, 416);
  EXPECT_EQ(model.height_px, 320);
  EXPECT_THAT(model.strides, ElementsAre(8, 16, 32, 64));
  EXPECT_EQ(model.num_bins, 8);
  EXPECT_EQ(model.cell_offset, 0.0);
  EXPECT_TRUE(model.is_logits);
  EXPECT_EQ(model.mean[0], 103.53);
  EXPECT_EQ(model.thresholds[kPersonClass], 0.3);
  EXPECT_EQ(model.thresholds[kChairClass], 0.5);
  EXPECT_EQ(model.thresholds[60], 0.6);
}

TEST(ReadModelDescription, ReadsEveryKey) {
  const TestFolder folder;
  folder.Write("m.yaml", R"(name: my model
model: weights/net.onnx
source: "somewhere"
licence: "MIT"
decoder: yolox
width: 640
height: 480
resize: letterbox-centered
pad_value: 0
channels: rgb
mean: {first: 1, second: 2, third: 3}
deviation: {first: 4, second: 5, third: 6}
strides: "8, 16"
scores: logits
decoded: true
bins: 9
cell_offset: 0.25
nms_iou: 0.5
)");
  const ModelDescription model = ReadModelDescription(folder / "m.yaml");
  EXPECT_EQ(model.name, "my model");
  EXPECT_EQ(model.onnx_file, folder / "weights/net.onnx");
  EXPECT_EQ(model.source, "somewhere");
  EXPECT_EQ(model.licence, "MIT");
  EXPECT_EQ(model.resize, ResizeMode::kLetterboxCentered);
  EXPECT_EQ(model.pad_value, 0.0);
  EXPECT_TRUE(model.is_rgb);
  EXPECT_THAT(model.mean, ElementsAre(1, 2, 3));
  EXPECT_THAT(model.deviation, ElementsAre(4, 5, 6));
  EXPECT_THAT(model.strides, ElementsAre(8, 16));
  EXPECT_TRUE(model.is_logits);
  EXPECT_TRUE(model.is_decoded);
  EXPECT_EQ(model.num_bins, 9);
  EXPECT_EQ(model.cell_offset, 0.25);
  EXPECT_EQ(model.nms_iou, 0.5);
}

std::string ErrorFor(const std::string& yaml) {
  const TestFolder folder;
  const auto file = folder.Write("m.yaml", yaml);
  return MessageOf([&] { ReadModelDescription(file); });
}

TEST(ReadModelDescription, NamesWhatIsWrong) {
  EXPECT_THAT(ErrorFor("width: 416\nheight: 320\n"), HasSubstr("m.yaml: 'decoder' is missing"));
  EXPECT_THAT(ErrorFor("decoder: yolo\nwidth: 416\nheight: 320\n"),
              HasSubstr("m.yaml: decoder 'yolo' is none of nanodet, nanodet-plus, yolox, yolov8"));
  EXPECT_THAT(ErrorFor("decoder: yolox\nheight: 320\n"),
              HasSubstr("'width' of the network's input is missing"));
  EXPECT_THAT(ErrorFor("decoder: yolox\nwidth: 410\nheight: 320\n"),
              HasSubstr("width 410 is not a multiple of 32 px"));
  EXPECT_THAT(ErrorFor("decoder: yolox\nwidht: 416\n"), HasSubstr("m.yaml:2: unknown option"));
  EXPECT_THAT(ErrorFor("decoder: [\n"), HasSubstr("broken YAML"));
  const std::string good = "decoder: yolox\nwidth: 416\nheight: 320\n";
  EXPECT_THAT(ErrorFor(good + "strides: \"8 x\"\n"), HasSubstr("strides '8 x'"));
  EXPECT_THAT(ErrorFor(good + "strides: \"\"\n"), HasSubstr("strides ''"));
  EXPECT_THAT(ErrorFor(good + "scores: maybe\n"), HasSubstr("neither logits nor probabilities"));
  EXPECT_THAT(ErrorFor(good + "channels: gbr\n"), HasSubstr("neither rgb nor bgr"));
  EXPECT_THAT(ErrorFor(good + "resize: crop\n"), HasSubstr("resize 'crop' is none of stretch"));
  EXPECT_THAT(ErrorFor(good + "deviation: {second: 0}\n"), HasSubstr("deviation of 0"));
  EXPECT_THAT(ErrorFor(good + "thresholds: {persn: 0.3}\n"), HasSubstr("'thresholds.person'"));
  EXPECT_THAT(ErrorFor(good + "thresholds: {person: 30}\n"), HasSubstr("m.yaml:4:"));
}

TEST(ReadModelDescription, SaysHowToMakeAMissingFile) {
  const TestFolder folder;
  EXPECT_THAT(MessageOf([&] { ReadModelDescription(folder / "net.onnx"); }),
              HasSubstr("changing-slam model install --from"));
}

TEST(SetThresholds, AppliesItemsFromLeftToRight) {
  ClassThresholds thresholds{};
  SetThresholds(thresholds, "person=0.9,default=0.4,tvmonitor=0.3,potted plant=0.2");
  EXPECT_EQ(thresholds[0], 0.4);
  EXPECT_EQ(thresholds[kTvClass], 0.3);
  EXPECT_EQ(thresholds[58], 0.2);
  SetThresholds(thresholds, "");
  EXPECT_EQ(thresholds[0], 0.4);
}

TEST(SetThresholds, RefusesWhatItCannotRead) {
  ClassThresholds thresholds{};
  EXPECT_THAT(MessageOf([&] { SetThresholds(thresholds, "box=0.3"); }),
              HasSubstr("no COCO class 'box'"));
  for (const char* text : {"person", "person=", "person=x", "person=0.3x", "person=-1",
                           "person=nan", "person=3", ",", "=0.3,person"}) {
    EXPECT_NE(MessageOf([&] { SetThresholds(thresholds, text); }), "(nothing thrown)") << text;
  }
}

TEST(ApplyOptions, SetsPeopleAndThingsApart) {
  ModelDescription model = DefaultDescription(DecoderKind::kNanoDet);
  model.thresholds[kPersonClass] = 0.25;
  ApplyOptions({}, model);
  EXPECT_EQ(model.thresholds[kPersonClass], 0.25);
  EXPECT_EQ(model.thresholds[kChairClass], 0.4);
  DetectorOptions options;
  options.object_threshold = 0.5;
  options.class_thresholds = "tv=0.6";
  options.nms_iou = 0.45;
  ApplyOptions(options, model);
  EXPECT_EQ(model.thresholds[kPersonClass], 0.25);
  EXPECT_EQ(model.thresholds[kChairClass], 0.5);
  EXPECT_EQ(model.thresholds[kTvClass], 0.6);
  EXPECT_EQ(model.nms_iou, 0.45);
  options.person_threshold = 0.1;
  ApplyOptions(options, model);
  EXPECT_EQ(model.thresholds[kPersonClass], 0.1);
}

TEST(DetectorOptions, AreWithinTheirRanges) {
  DetectorOptions options;
  OptionList list;
  Describe(list, options);
  EXPECT_NO_THROW(list.CheckRanges());
  list.Set("degrade.drop", "0.5");
  EXPECT_EQ(options.degrade.drop_probability, 0.5);
}

}  // namespace
}  // namespace cslam
