// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/sim/camera_motion.h"
#include "cslam/sim/camera_path.h"
#include "cslam/sim/renderer.h"
#include "cslam/sim/scene.h"
#include "cslam/sim/world.h"
#include "cslam/util/stamp.h"
#include "cslam/vision/rgbd_frame.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace cslam {

enum class SensorNoise {
  kOff,     // exact depth, clean and sharp colour
  kKinect,  // structured light
  kD435i,   // active stereo
};

struct SequenceOptions {
  int width = 640;     // px; 4:3 keeps the usual field of view
  int height = 480;    // px
  double fps = 30.0;   // frames per second of the story; a lower rate resamples it
  int num_frames = 0;  // 0: the whole story; otherwise it ends (or the camera rests) there
  SensorNoise noise = SensorNoise::kKinect;
  std::uint64_t seed = 1;  // of noise (and, in the demo, of room and wobble)
  // None: MakeSimulatedCamera(width, height); otherwise it decides about the size, too.
  std::optional<Camera> camera = std::nullopt;
  // Factor on the light that reaches the sensor, by time of the story (s); empty: always 1. A dark
  // picture is as noisy as a bright one, so relatively more.
  std::function<double(double time_s)> exposure = {};
  // Time the shutter is open (s): how much motion blurs the colour, unless noise is off.
  double shutter_s = 0.0;
};

// Exposure times as these cameras choose them in a lit room.
constexpr double kUsualShutterS = 0.008;
constexpr double kD435iShutterS = 0.012;

// A sequence that is rendered when asked for, frame by frame, in any order, from any thread:
//
//   const SimulatedSequence sequence = MakeDemoSequence({.width = 320, .height = 240});
//   for (int i = 0; i < sequence.size(); ++i)
//     tracker.Process(std::make_shared<const RgbdFrame>(sequence.Frame(i)), ...);
//
// Frame i is the same bytes whatever else was asked for. Copies share scene and light.
class SimulatedSequence {
 public:
  SimulatedSequence(World world, CameraMotion camera, const SequenceOptions& options);
  // A scene in which nothing happens.
  SimulatedSequence(Scene scene, const CameraPath& path, const SequenceOptions& options);

  int size() const { return num_frames_; }
  const Camera& camera() const { return renderer_->camera(); }
  const World& world() const { return renderer_->world(); }
  const Scene& scene() const { return world().scene; }
  const SequenceOptions& options() const { return options_; }

  // Stamp of time 0 of the story.
  static Stamp start();

  // 0 <= i < size() in all of these.
  Stamp stamp(int i) const;
  double time_s(int i) const;  // since the story's start
  Se3 T_world_camera(int i) const;
  RgbdFrame Frame(int i) const;                               // as the sensor sees it
  RenderedView Truth(int i) const;                            // without noise
  RgbdFrame Observe(int i, const RenderedView& truth) const;  // Frame(i), if Truth(i) is at hand

 private:
  cv::Mat ObserveColor(int i, const RenderedView& truth) const;
  cv::Mat ObserveDepth(int i, const RenderedView& truth) const;

  std::shared_ptr<const Renderer> renderer_;
  CameraMotion motion_;
  SequenceOptions options_;
  int num_frames_ = 0;
};

// A hand-held tour of a furnished room (MakeRoom): 20 s, 600 frames at 30 Hz, about 8 m, a bit
// more than a full turn, ending where it began. Tests take 320 x 240: four times as fast.
SimulatedSequence MakeDemoSequence(const SequenceOptions& options);

// The tour's path.
CameraPath MakeDemoPath(std::uint64_t seed);

// A pinhole camera of the given size with the field of view of a Kinect (fx 525 at 640 px).
Camera MakeSimulatedCamera(int width, int height);

// The colour camera of a RealSense D435i (fx 615 at 640 px).
Camera MakeD435iCamera(int width, int height);

}  // namespace cslam
