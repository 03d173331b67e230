// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/truth_files.h"
#include "cslam/io/truth_json.h"

#include <fmt/format.h>

#include <limits>

namespace cslam {
namespace {

constexpr char kFormat[] = "detections";
constexpr int kMaxSidePx = 16384;  // as for cameras

Box ReadBox(const JsonValue& value) {
  const std::vector<JsonValue> items = value.Items(4);
  const Box box{items[0].Number(), items[1].Number(), items[2].Number(), items[3].Number()};
  if (box.empty()) value.Fail("expected [x_min, y_min, x_max, y_max] with max above min");
  return box;
}

RecordedDetection ReadDetection(const JsonValue& value) {
  value.RequireKeys({"instance", "class_id", "score", "box_px", "visible_px"});
  RecordedDetection detection;
  detection.instance = value.At("instance").IntegerIn(0, kMaxInstance);
  detection.class_id = value.At("class_id").IntegerIn(0, kMaxClass);
  detection.score = value.At("score").NumberIn(0.0, 1.0);
  detection.box = ReadBox(value.At("box_px"));
  detection.visible_px = value.At("visible_px").IntegerIn(0, std::numeric_limits<int>::max());
  return detection;
}

RecordedFrame ReadFrame(const JsonValue& value) {
  value.RequireKeys({"stamp", "detections"});
  RecordedFrame frame;
  frame.stamp = ReadStamp(value.At("stamp"));
  for (const JsonValue& detection : value.At("detections").Items())
    frame.detections.push_back(ReadDetection(detection));
  return frame;
}

// One detection a line: such files are looked at and compared by people, too. Numbers are exact, so
// that a run on what was recorded is the run that it was recorded from.
std::string FormatDetection(const RecordedDetection& d) {
  return fmt::format(
      "{{\"instance\": {}, \"class_id\": {}, \"score\": {}, \"box_px\": [{}, {}, {}, {}], "
      "\"visible_px\": {}}}",
      d.instance, d.class_id, JsonExact(d.score), JsonExact(d.box.x_min), JsonExact(d.box.y_min),
      JsonExact(d.box.x_max), JsonExact(d.box.y_max), d.visible_px);
}

std::string FormatFrame(const RecordedFrame& frame) {
  std::string text = fmt::format("    {{\"stamp\": {}, \"detections\": [", JsonStamp(frame.stamp));
  for (std::size_t i = 0; i < frame.detections.size(); ++i)
    text += fmt::format("{}\n      {}", i == 0 ? "" : ",", FormatDetection(frame.detections[i]));
  return text + "]}";
}

}  // namespace

DetectionRecord ReadDetections(const std::filesystem::path& file) {
  const JsonFile json(file);
  const JsonValue root = json.root();
  RequireFormat(root, kFormat);
  root.RequireKeys({"format", "version", "sequence", "width_px", "height_px", "frames"});
  DetectionRecord record;
  record.sequence = root.At("sequence").Text();
  record.width_px = root.At("width_px").IntegerIn(1, kMaxSidePx);
  record.height_px = root.At("height_px").IntegerIn(1, kMaxSidePx);
  for (const JsonValue& value : root.At("frames").Items()) {
    record.frames.push_back(ReadFrame(value));
    const std::size_t count = record.frames.size();
    if (count > 1 && record.frames[count - 1].stamp <= record.frames[count - 2].stamp)
      value.At("stamp").Fail("does not come after the frame before");
  }
  return record;
}

void WriteDetections(const std::filesystem::path& file, const DetectionRecord& record) {
  const std::string fields =
      fmt::format("  \"width_px\": {},\n  \"height_px\": {},\n", record.width_px, record.height_px);
  const ListFileHead head{
      .format = kFormat, .sequence = record.sequence, .fields = fields, .list = "frames"};
  WriteListFile(file, head, record.frames, FormatFrame);
}

}  // namespace cslam
