// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/truth_files.h"
#include "cslam/io/truth_json.h"

#include <fmt/format.h>

namespace cslam {
namespace {

constexpr char kFormat[] = "objects";

TrueInterval::Sample ReadSample(const JsonValue& value) {
  const std::vector<JsonValue> items = value.Items(8);
  return {items[0].Number(), ReadPose(value, items, 1)};
}

TrueInterval ReadInterval(const JsonValue& value) {
  value.RequireKeys({"from_s", "to_s", "is_moving", "poses"});
  TrueInterval interval;
  interval.from_s = value.At("from_s").Number();
  interval.to_s = value.At("to_s").Number();
  if (interval.to_s < interval.from_s) value.Fail("to_s lies before from_s");
  interval.is_moving = value.At("is_moving").Bool();
  for (const JsonValue& item : value.At("poses").Items()) {
    interval.poses.push_back(ReadSample(item));
    const std::size_t count = interval.poses.size();
    if (count > 1 && interval.poses[count - 1].time_s <= interval.poses[count - 2].time_s)
      item.Fail("its time does not come after the pose before");
  }
  if (interval.poses.empty()) value.Fail("no pose at all");
  if (!interval.is_moving && interval.poses.size() > 1)
    value.Fail("an object that rests has one pose");
  return interval;
}

TrueObject ReadObject(const JsonValue& value) {
  value.RequireKeys({"instance", "name", "class_id", "is_deformable", "box", "intervals"});
  TrueObject object;
  object.instance = value.At("instance").IntegerIn(1, kMaxInstance);
  object.name = value.At("name").Text();
  object.class_id = value.At("class_id").IntegerIn(-1, kMaxClass);
  object.is_deformable = value.At("is_deformable").Bool();
  const JsonValue box = value.At("box");
  box.RequireKeys({"center_m", "size_m"});
  object.box_center = ReadVector3(box.At("center_m"));
  object.box_size_m = ReadSize(box.At("size_m"));
  for (const JsonValue& item : value.At("intervals").Items()) {
    object.intervals.push_back(ReadInterval(item));
    const std::size_t count = object.intervals.size();
    if (count > 1 && object.intervals[count - 1].from_s < object.intervals[count - 2].to_s)
      item.Fail("begins before the interval before it has ended");
  }
  return object;
}

std::string FormatInterval(const TrueInterval& interval) {
  std::string text =
      fmt::format("{{\"from_s\": {}, \"to_s\": {}, \"is_moving\": {}, \"poses\": [",
                  JsonNumber(interval.from_s), JsonNumber(interval.to_s), interval.is_moving);
  const bool is_long = interval.poses.size() > 1;
  for (std::size_t i = 0; i < interval.poses.size(); ++i) {
    const TrueInterval::Sample& sample = interval.poses[i];
    const std::string pose = JsonPose(sample.T_world_object);
    text += fmt::format("{}{}[{}, {}", i == 0 ? "" : ",", is_long ? "\n          " : "",
                        JsonNumber(sample.time_s), pose.substr(1));
  }
  return text + "]}";
}

std::string FormatObject(const TrueObject& object) {
  std::string text = fmt::format(
      "    {{\"instance\": {}, \"name\": {}, \"class_id\": {}, \"is_deformable\": {},\n"
      "      \"box\": {{\"center_m\": {}, \"size_m\": {}}},\n      \"intervals\": [",
      object.instance, JsonQuoted(object.name), object.class_id, object.is_deformable,
      JsonArray(object.box_center), JsonArray(object.box_size_m));
  for (std::size_t i = 0; i < object.intervals.size(); ++i)
    text += fmt::format("{}\n        {}", i == 0 ? "" : ",", FormatInterval(object.intervals[i]));
  return text + "]}";
}

}  // namespace

TrueObjects ReadTrueObjects(const std::filesystem::path& file) {
  const JsonFile json(file);
  const JsonValue root = json.root();
  RequireFormat(root, kFormat);
  root.RequireKeys({"format", "version", "sequence", "start", "duration_s", "objects"});
  TrueObjects objects;
  objects.sequence = root.At("sequence").Text();
  objects.start = ReadStamp(root.At("start"));
  objects.duration_s = root.At("duration_s").Number();
  if (objects.duration_s < 0.0) root.At("duration_s").Fail("is negative");
  for (const JsonValue& item : root.At("objects").Items()) {
    objects.objects.push_back(ReadObject(item));
    const std::size_t count = objects.objects.size();
    if (count > 1 && objects.objects[count - 1].instance <= objects.objects[count - 2].instance)
      item.At("instance").Fail("does not come after the object before");
  }
  return objects;
}

void WriteTrueObjects(const std::filesystem::path& file, const TrueObjects& objects) {
  const std::string fields = fmt::format("  \"start\": {},\n  \"duration_s\": {},\n",
                                         JsonStamp(objects.start), JsonNumber(objects.duration_s));
  const ListFileHead head{
      .format = kFormat, .sequence = objects.sequence, .fields = fields, .list = "objects"};
  WriteListFile(file, head, objects.objects, FormatObject);
}

}  // namespace cslam
