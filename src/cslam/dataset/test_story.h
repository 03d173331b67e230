// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/check_frames.h"
#include "cslam/dataset/truth_check.h"
#include "cslam/sim/scene_builder.h"
#include "cslam/sim/simulated_sequence.h"
#include "cslam/sim/world.h"

#include <opencv2/core.hpp>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace cslam::test {

// Frames in memory, to be spoilt by a test.
class MemoryFrames : public CheckFrames {
 public:
  explicit MemoryFrames(const SimulatedSequence& sequence) : camera_(sequence.camera()) {
    for (int i = 0; i < sequence.size(); ++i) {
      const RenderedView view = sequence.Truth(i);
      stamps.push_back(sequence.stamp(i));
      poses.emplace_back(sequence.T_world_camera(i));
      depths_m.push_back(sequence.Observe(i, view).depth_m);
      instances.push_back(view.instances);
    }
  }

  std::size_t size() const override { return stamps.size(); }
  const Camera& camera() const override { return camera_; }
  Stamp stamp(std::size_t i) const override { return stamps[i]; }
  std::optional<Se3> T_world_camera(std::size_t i) const override { return poses[i]; }
  cv::Mat DepthM(std::size_t i) const override { return depths_m[i]; }
  bool has_instances() const override { return !instances.empty(); }
  cv::Mat Instances(std::size_t i) const override { return instances[i]; }

  MemoryFrames Copy() const {
    MemoryFrames copy = *this;
    for (cv::Mat& image : copy.depths_m)
      image = image.clone();
    for (cv::Mat& image : copy.instances)
      image = image.clone();
    return copy;
  }

  std::vector<Stamp> stamps;
  std::vector<std::optional<Se3>> poses;
  std::vector<cv::Mat> depths_m;
  std::vector<cv::Mat> instances;  // clear() to have none

 private:
  Camera camera_;
};

// Instance ids of what stands in the room of MakeStory().
enum StoryObject { kChair = 1, kBear, kBox, kUmbrella, kSuitcase, kTv, kPerson };

constexpr double kStoryChangeS = 3.0;    // the camera looks away
constexpr double kStoryDurationS = 6.0;  // 60 frames at 10 Hz

// A room in which the camera looks at the north wall for 2 s, at the south wall from 2.6 s to
// 3.4 s, and at the north wall again. When it looks away, the chair moves 0.6 m, the bear goes, an
// umbrella comes, and the suitcase is replaced by a tv. A person crosses the view at the start; a
// box without a class stands still.
inline World MakeStoryWorld() {
  SceneBuilder builder(1, 1.0);
  const int grey = builder.AddPicture(cv::Mat(4, 4, CV_8UC3, cv::Scalar(150, 150, 150)), 1.0F);
  const int red = builder.AddPicture(cv::Mat(4, 4, CV_8UC3, cv::Scalar(0, 0, 200)), 1.0F);
  builder.AddObject("room", kNoClass, Se3(), [&](MeshBuilder& mesh) {
    mesh.AddRectangle({-3, 3, 2.5}, {6, 0, 0}, {0, 0, -2.5}, grey);   // north
    mesh.AddRectangle({3, -3, 2.5}, {-6, 0, 0}, {0, 0, -2.5}, grey);  // south
    mesh.AddRectangle({3, 3, 2.5}, {0, -6, 0}, {0, 0, -2.5}, grey);   // east
    mesh.AddRectangle({-3, -3, 2.5}, {0, 6, 0}, {0, 0, -2.5}, grey);  // west
    mesh.AddRectangle({-3, 3, 0}, {6, 0, 0}, {0, -6, 0}, grey);       // floor
  });
  const auto add = [&](const char* name, int class_id, const Se3& pose, Eigen::Vector3d size_m) {
    return builder.AddBox(name, class_id, pose, size_m, Uniform(red));
  };
  add("chair", 56, Standing(-0.8, 2.0, 0.0), {0.4, 0.4, 0.8});
  add("bear", 77, Standing(0.9, 2.2, 0.0), {0.4, 0.3, 0.5});
  add("box", kNoClass, Standing(-0.2, 2.5, 0.0), {0.3, 0.3, 0.3});
  add("umbrella", 25, Standing(0.2, 2.0, 0.0), {0.3, 0.3, 0.5});
  add("suitcase", 28, Standing(1.3, 1.9, 0.0), {0.3, 0.2, 0.5});
  add("tv", 62, Standing(1.4, 2.0, 0.0), {0.5, 0.2, 0.5});
  add("person", 0, Standing(-1.5, 1.2, 0.0), {0.4, 0.4, 1.7});

  const double t = kStoryChangeS;
  World world{.scene = builder.Take(Lighting{}), .timelines = {}, .animations = {}};
  world.timelines[kChair].stays = {{.to_s = t, .T_world_object = Standing(-0.8, 2.0, 0.0)},
                                   {.from_s = t, .T_world_object = Standing(-1.4, 2.0, 0.0, 0.4)}};
  world.timelines[kBear].stays = {{.to_s = t, .T_world_object = Standing(0.9, 2.2, 0.0)}};
  world.timelines[kUmbrella].stays = {{.from_s = t, .T_world_object = Standing(0.2, 2.0, 0.0)}};
  world.timelines[kSuitcase].stays = {{.to_s = t, .T_world_object = Standing(1.3, 1.9, 0.0)}};
  world.timelines[kTv].stays = {{.from_s = t, .T_world_object = Standing(1.4, 2.0, 0.0)}};
  world.timelines[kPerson].carries = {
      {{0.0, Standing(-1.5, 1.2, 0.0)}, {1.5, Standing(1.5, 1.2, 0.0)}}};
  return world;
}

inline Se3 StoryCamera(double time_s) {
  const auto smooth = [](double x) { return x <= 0 ? 0.0 : x >= 1 ? 1.0 : x * x * (3 - 2 * x); };
  const double turn = smooth((time_s - 2.0) / 0.6) - smooth((time_s - 3.4) / 0.6);
  return PoseAt({.position = {0.1 * std::sin(time_s), -0.6 + 0.05 * time_s, 1.0},
                 .yaw_rad = std::numbers::pi * (0.5 + turn) + 0.1 * std::sin(2.0 * time_s),
                 .pitch_rad = -0.15});
}

inline SimulatedSequence MakeStory(SensorNoise noise = SensorNoise::kOff, double fps = 10.0) {
  return {MakeStoryWorld(),
          {.duration_s = kStoryDurationS, .T_world_camera = StoryCamera},
          {.width = 160, .height = 120, .fps = fps, .noise = noise}};
}

inline TrueInterval Rest(double from_s, double to_s, const Se3& T_world_object) {
  return {.from_s = from_s, .to_s = to_s, .is_moving = false, .poses = {{from_s, T_world_object}}};
}

// objects.json, changes.json and detections.json of the story, written by hand.
inline TrueObjects StoryObjects(const World& world) {
  TrueObjects truth{.sequence = "story",
                    .duration_s = kStoryDurationS,
                    .start = SimulatedSequence::start(),
                    .objects = {}};
  const std::vector<Eigen::Vector3d> sizes_m{{0.4, 0.4, 0.8}, {0.4, 0.3, 0.5}, {0.3, 0.3, 0.3},
                                             {0.3, 0.3, 0.5}, {0.3, 0.2, 0.5}, {0.5, 0.2, 0.5},
                                             {0.4, 0.4, 1.7}};
  for (int id = kChair; id <= kPerson; ++id) {
    const SceneObject& from = world.scene.objects[static_cast<std::size_t>(id)];
    const Eigen::Vector3d size_m = sizes_m[static_cast<std::size_t>(id - 1)];
    TrueObject object{.instance = id,
                      .name = from.name,
                      .class_id = from.class_id,
                      .is_deformable = from.class_id == 0,
                      .box_center = {0.0, 0.0, 0.5 * size_m.z()},
                      .box_size_m = size_m,
                      .intervals = {}};
    if (!world.timelines.contains(id)) {
      object.intervals.push_back(Rest(0.0, kStoryDurationS, from.T_world_object));
    } else {
      for (const Stay& stay : world.timelines.at(id).stays)
        object.intervals.push_back(Rest(std::max(0.0, stay.from_s),
                                        std::min(kStoryDurationS, stay.to_s), stay.T_world_object));
      for (const Carry& carry : world.timelines.at(id).carries) {
        TrueInterval moving{carry.front().time_s, carry.back().time_s, true, {}};
        for (const TimedPose& pose : carry)
          moving.poses.push_back({pose.time_s, pose.T_world_object});
        object.intervals.push_back(moving);
      }
    }
    truth.objects.push_back(object);
  }
  return truth;
}

inline TrueChange Change(ChangeKind kind, int instance, int class_id, std::optional<Se3> from,
                         std::optional<Se3> to) {
  TrueChange change;
  change.kind = kind;
  change.time_s = kStoryChangeS;
  change.instance = instance;
  change.class_id = class_id;
  change.from = from;
  change.to = to;
  return change;
}

inline TrueChanges StoryChanges() {
  TrueChange replaced = Change(ChangeKind::kReplaced, kSuitcase, 28, Standing(1.3, 1.9, 0.0),
                               Standing(1.4, 2.0, 0.0));
  replaced.new_instance = kTv;
  replaced.new_class_id = 62;
  return {.sequence = "story",
          .changes = {Change(ChangeKind::kMoved, kChair, 56, Standing(-0.8, 2.0, 0.0),
                             Standing(-1.4, 2.0, 0.0, 0.4)),
                      Change(ChangeKind::kRemoved, kBear, 77, Standing(0.9, 2.2, 0.0), {}),
                      Change(ChangeKind::kAdded, kUmbrella, 25, {}, Standing(0.2, 2.0, 0.0)),
                      replaced}};
}

inline DetectionRecord StoryDetections(const MemoryFrames& frames, const TrueObjects& objects) {
  DetectionRecord record{.sequence = "story", .width_px = 160, .height_px = 120, .frames = {}};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    RecordedFrame frame{.stamp = frames.stamps[i], .detections = {}};
    for (const auto& [id, region] : VisibleRegions(frames.instances[i])) {
      const int class_id = objects.objects[static_cast<std::size_t>(id - 1)].class_id;
      if (class_id < 0) continue;
      frame.detections.push_back({.instance = id,
                                  .class_id = class_id,
                                  .score = 1.0,
                                  .box = region.box,
                                  .visible_px = region.num_px});
    }
    record.frames.push_back(frame);
  }
  return record;
}

// The story, rendered once for all tests of a program.
struct RenderedStory {
  MemoryFrames frames;
  SequenceTruth truth;
};

inline RenderedStory RenderStory(SensorNoise noise) {
  const SimulatedSequence sequence = MakeStory(noise);
  RenderedStory story{.frames = MemoryFrames(sequence), .truth = {}};
  story.truth.objects = StoryObjects(sequence.world());
  story.truth.changes = StoryChanges();
  story.truth.detections = StoryDetections(story.frames, *story.truth.objects);
  return story;
}

inline const RenderedStory& ExactStory() {
  static const RenderedStory story = RenderStory(SensorNoise::kOff);
  return story;
}

}  // namespace cslam::test
