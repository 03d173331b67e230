// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/simulated_sequence.h"

#include "cslam/sim/color_noise.h"
#include "cslam/sim/motion_blur.h"
#include "cslam/sim/room.h"
#include "cslam/sim/sensor_noise.h"
#include "cslam/util/check.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr double kKinectFocalPerWidth = 525.0 / 640.0;
constexpr double kD435iFocalPerWidth = 615.0 / 640.0;
constexpr double kDemoDurationS = 20.0;
constexpr std::int64_t kFirstStampNs = 1'000'000'000;

Camera MakePinhole(int width, int height, double focal_per_width) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = focal_per_width * width;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

Camera CameraOf(const SequenceOptions& options) {
  return options.camera ? *options.camera : MakeSimulatedCamera(options.width, options.height);
}

int CountFrames(const SequenceOptions& options, double duration_s) {
  if (options.num_frames > 0) return options.num_frames;
  return std::max(1, static_cast<int>(std::floor(duration_s * options.fps + 1e-9)));
}

}  // namespace

SimulatedSequence::SimulatedSequence(World world, CameraMotion camera,
                                     const SequenceOptions& options)
    : renderer_(std::make_shared<const Renderer>(std::move(world), CameraOf(options))),
      motion_(std::move(camera)),
      options_(options),
      num_frames_(CountFrames(options, motion_.duration_s)) {
  options_.width = this->camera().width;
  options_.height = this->camera().height;
}

SimulatedSequence::SimulatedSequence(Scene scene, const CameraPath& path,
                                     const SequenceOptions& options)
    : SimulatedSequence(World{std::move(scene), {}, {}}, path.Motion(), options) {}

Stamp SimulatedSequence::start() {
  return Stamp{kFirstStampNs};
}

Stamp SimulatedSequence::stamp(int i) const {
  CSLAM_CHECK(i >= 0 && i < num_frames_, "frame {} of {}", i, num_frames_);
  // Whole microseconds: what six decimals in a list file can say.
  return Stamp{kFirstStampNs + 1000 * std::llround(1e6 * i / options_.fps)};
}

double SimulatedSequence::time_s(int i) const {
  return SecondsBetween(stamp(i), start());
}

Se3 SimulatedSequence::T_world_camera(int i) const {
  return motion_.T_world_camera(time_s(i));
}

RenderedView SimulatedSequence::Truth(int i) const {
  return renderer_->Render(T_world_camera(i), time_s(i));
}

RgbdFrame SimulatedSequence::Frame(int i) const {
  return Observe(i, Truth(i));
}

cv::Mat SimulatedSequence::ObserveColor(int i, const RenderedView& truth) const {
  const double exposure = options_.exposure ? options_.exposure(time_s(i)) : 1.0;
  if (options_.noise == SensorNoise::kOff) return Expose(truth.bgr, exposure);
  cv::Mat bgr = truth.bgr;
  if (options_.shutter_s > 0.0) {
    const double half_s = 0.5 * options_.shutter_s;
    const ShutterMotion motion{motion_.T_world_camera(time_s(i) - half_s),
                               motion_.T_world_camera(time_s(i) + half_s), options_.shutter_s};
    bgr = BlurMotion(bgr, FlowOf(truth, camera(), motion));
  }
  ColorNoiseOptions noise =
      options_.noise == SensorNoise::kD435i ? D435iColorNoise() : ColorNoiseOptions{};
  noise.exposure = exposure;
  return AddColorNoise(bgr, noise, options_.seed, static_cast<std::uint64_t>(i));
}

cv::Mat SimulatedSequence::ObserveDepth(int i, const RenderedView& truth) const {
  if (options_.noise == SensorNoise::kOff) return truth.depth_m;
  const DepthNoiseOptions noise =
      options_.noise == SensorNoise::kD435i ? D435iDepthNoise() : DepthNoiseOptions{};
  return AddDepthNoise(truth.depth_m, camera(), noise, options_.seed,
                       static_cast<std::uint64_t>(i));
}

RgbdFrame SimulatedSequence::Observe(int i, const RenderedView& truth) const {
  RgbdFrame frame;
  frame.id = FrameId(static_cast<std::uint32_t>(i));
  frame.stamp = stamp(i);
  frame.bgr = ObserveColor(i, truth);
  frame.depth_m = ObserveDepth(i, truth);
  cv::cvtColor(frame.bgr, frame.gray, cv::COLOR_BGR2GRAY);
  return frame;
}

SimulatedSequence MakeDemoSequence(const SequenceOptions& options) {
  RoomOptions room;
  room.seed = options.seed;
  room.texels_per_m = std::clamp(options.width * 1.25, 240.0, 1000.0);
  return SimulatedSequence(MakeRoom(room), MakeDemoPath(options.seed), options);
}

CameraPath MakeDemoPath(std::uint64_t seed) {
  // Around the table in the middle, looking outwards: near the desks, then across the room.
  struct Stop {
    double x, y, z, yaw_deg, pitch_deg;
  };
  const std::vector<Stop> stops{
      {2.90, 1.60, 1.35, 60, -14},  {3.35, 1.65, 1.35, 72, -16},  {3.80, 1.85, 1.30, 76, -18},
      {4.15, 2.20, 1.30, 66, -20},  {4.20, 2.65, 1.30, 74, -18},  {3.95, 3.05, 1.38, 98, -16},
      {3.50, 3.30, 1.40, 124, -16}, {3.00, 3.40, 1.38, 146, -18}, {2.50, 3.35, 1.32, 164, -18},
      {2.10, 3.10, 1.30, 182, -17}, {1.80, 2.70, 1.30, 200, -18}, {1.75, 2.25, 1.35, 220, -19},
      {1.95, 1.85, 1.40, 244, -19}, {2.35, 1.60, 1.40, 270, -18}, {2.80, 1.55, 1.35, 296, -18},
      {3.25, 1.65, 1.30, 322, -18}, {3.60, 1.90, 1.30, 348, -16}, {3.65, 2.10, 1.30, 374, -14},
      {3.40, 2.00, 1.32, 398, -14}, {3.10, 1.75, 1.35, 415, -14}, {2.90, 1.60, 1.35, 424, -14}};
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  std::vector<PathKey> keys;
  keys.reserve(stops.size());
  for (const Stop& s : stops)
    keys.push_back({{s.x, s.y, s.z}, s.yaw_deg * kRadPerDeg, s.pitch_deg * kRadPerDeg});
  return {keys, kDemoDurationS, HandWobble{.seed = seed}};
}

Camera MakeSimulatedCamera(int width, int height) {
  return MakePinhole(width, height, kKinectFocalPerWidth);
}

Camera MakeD435iCamera(int width, int height) {
  return MakePinhole(width, height, kD435iFocalPerWidth);
}

}  // namespace cslam
