// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/rendering.h"

#include "cslam/util/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslam {
namespace {

constexpr int kPersonClassId = 0;  // COCO
constexpr double kDemoDurationS = 20.0;
constexpr SequenceEntry kDemo{
    .name = "demo",
    .summary = "hand-held tour of a furnished room: 8 m, a full turn, nothing moves",
    .sensor = SensorKind::kKinect,
    .duration_s = kDemoDurationS,
    .short_duration_s = kDemoDurationS,
    .make = nullptr};

// Finer than a pixel where things are a metre away; coarse textures are made faster.
double TexelsPerM(int width) {
  constexpr double kPerPixel = 1.5;
  return std::clamp(kPerPixel * width, 160.0, 960.0);
}

SequenceOptions OptionsOf(const SequenceEntry& entry, const RenderRequest& request) {
  SequenceOptions options;
  options.width = request.width;
  options.height = request.height;
  options.fps = request.fps;
  options.num_frames = CountFrames(entry, request);
  options.noise = NoiseOf(entry, request);
  options.seed = request.seed;
  return options;
}

SimulatedSequence MakeSequence(Story story, SequenceOptions options) {
  const bool is_d435i = story.sensor == SensorKind::kD435i;
  options.camera = is_d435i ? MakeD435iCamera(options.width, options.height)
                            : MakeSimulatedCamera(options.width, options.height);
  options.exposure = std::move(story.exposure);
  options.shutter_s = is_d435i ? kD435iShutterS : kUsualShutterS;
  return {std::move(story.world), std::move(story.camera), options};
}

int CountWholeFrames(double duration_s, double fps) {
  return std::max(1, static_cast<int>(std::floor(duration_s * fps + 1e-9)));
}

bool IsOneOf(const std::string& name, const std::vector<std::string>& names) {
  return std::ranges::find(names, name) != names.end();
}

void RequireObjects(const World& world, const RenderRequest& request, std::string_view sequence) {
  std::vector<std::string> known;
  for (const SceneObject& object : world.scene.objects)
    known.push_back(object.name);
  for (const std::string& name : request.without) {
    if (IsOneOf(name, known)) continue;
    throw Error("'{}' has no object '{}' to leave out; there are: {}", sequence, name,
                fmt::join(known, ", "));
  }
}

World LeaveOut(World world, const RenderRequest& request, std::string_view sequence) {
  RequireObjects(world, request, sequence);
  return WithoutObjects(std::move(world), [&](const SceneObject& object) {
    const bool is_unwanted_person = request.without_people && object.class_id == kPersonClassId;
    return is_unwanted_person || IsOneOf(object.name, request.without);
  });
}

double DurationS(const SequenceEntry& entry, const RenderRequest& request) {
  return request.is_short ? entry.short_duration_s : entry.duration_s;
}

}  // namespace

std::vector<SequenceEntry> RenderableSequences() {
  std::vector<SequenceEntry> entries{kDemo};
  entries.insert(entries.end(), AllSequences().begin(), AllSequences().end());
  return entries;
}

int CountStoryFrames(const SequenceEntry& entry, const RenderRequest& request) {
  return CountWholeFrames(DurationS(entry, request), request.fps);
}

int CountFrames(const SequenceEntry& entry, const RenderRequest& request) {
  const int num_in_story = CountStoryFrames(entry, request);
  return request.num_frames > 0 ? std::min(request.num_frames, num_in_story) : num_in_story;
}

SensorNoise NoiseOf(const SequenceEntry& entry, const RenderRequest& request) {
  const bool is_kinect = entry.sensor == SensorKind::kKinect;
  return request.noise.value_or(is_kinect ? SensorNoise::kKinect : SensorNoise::kD435i);
}

Rendering MakeRendering(const SequenceEntry& entry, const RenderRequest& request,
                        const Stage& stage) {
  const SequenceOptions options = OptionsOf(entry, request);
  const auto describe = [&](const SimulatedSequence& sequence) {
    RenderRecord record = DescribeSequence(sequence, std::string(entry.name));
    record.summary = entry.summary;
    record.is_short = request.is_short;
    record.without_people = request.without_people;
    record.without = request.without;
    record.story_duration_s = DurationS(entry, request);
    return record;
  };
  if (entry.make == nullptr) {
    if (!request.without.empty()) throw Error("nothing can be left out of '{}'", entry.name);
    SimulatedSequence sequence = MakeDemoSequence(options);
    RenderRecord record = describe(sequence);
    return {std::move(sequence), std::move(record)};
  }
  Story story = entry.make(stage, {.seed = request.seed,
                                   .is_short = request.is_short,
                                   .texels_per_m = TexelsPerM(request.width)});
  const double duration_s = story.camera.duration_s;
  const PeopleClaim people = request.without_people ? PeopleClaim{} : story.people;
  story.world = LeaveOut(std::move(story.world), request, entry.name);
  SimulatedSequence sequence = MakeSequence(std::move(story), options);
  RenderRecord record = describe(sequence);
  record.look = stage.props.look();
  record.story_duration_s = duration_s;
  record.people = people;
  return {std::move(sequence), std::move(record)};
}

std::string CommandOf(const RenderRecord& record) {
  std::string without;
  for (const std::string& name : record.without)
    without += fmt::format(" --without '{}'", name);
  const bool is_whole = record.num_frames == CountWholeFrames(record.story_duration_s, record.fps);
  return fmt::format(
      "changing-slam dataset render {} --out DIR --seed {} --fps {} --size {}x{} --noise {} --look "
      "{}{}{}{}{}",
      record.sequence, record.seed, record.fps, record.width_px, record.height_px,
      NameOf(record.noise), record.look, record.is_short ? " --short" : "",
      record.without_people ? " --without-people" : "", without,
      is_whole ? "" : fmt::format(" --frames {}", record.num_frames));
}

double RoughBytes(const SequenceEntry& entry, const RenderRequest& request) {
  // Measured on changing, walking_xyz and demo from 160x120 to 640x480, with noise and without:
  // small images compress less.
  constexpr double kBytesOfVga = 420e3;
  constexpr double kVgaPixels = 640.0 * 480.0;
  constexpr double kExponent = 0.87;
  const double pixels = static_cast<double>(request.width) * request.height;
  constexpr double kThumbPixels = 320.0 * 240.0;  // of a picture in the contact sheet
  constexpr double kThumbBytes = 110e3;
  const int num_frames = CountFrames(entry, request);
  const double sheet_bytes =
      std::min(num_frames, 12) * kThumbBytes * std::min(1.0, pixels / kThumbPixels);
  return sheet_bytes + num_frames * kBytesOfVga * std::pow(pixels / kVgaPixels, kExponent);
}

}  // namespace cslam
