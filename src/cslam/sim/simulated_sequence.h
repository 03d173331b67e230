// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/sim/camera_path.h"
#include "cslam/sim/renderer.h"
#include "cslam/sim/scene.h"
#include "cslam/sim/sensor_noise.h"
#include "cslam/util/stamp.h"
#include "cslam/vision/rgbd_frame.h"

#include <cstdint>
#include <memory>

namespace cslam {

struct SequenceOptions {
  int width = 640;           // px; 4:3 keeps the usual field of view
  int height = 480;          // px
  double fps = 30.0;         // frames per second of the story; a lower rate resamples it
  int num_frames = 0;        // 0: the whole path; otherwise the story ends (or rests) there
  bool sensor_noise = true;  // off: exact depth, clean colour
  std::uint64_t seed = 1;    // of room, wobble and noise
};

// A sequence that is rendered when asked for, frame by frame, in any order, from any thread:
//
//   const SimulatedSequence sequence = MakeDemoSequence({.width = 320, .height = 240});
//   for (int i = 0; i < sequence.size(); ++i)
//     tracker.Process(std::make_shared<const RgbdFrame>(sequence.Frame(i)), ...);
//
// Frame i is the same bytes whatever else was asked for. Copies share scene and light.
class SimulatedSequence {
 public:
  SimulatedSequence(Scene scene, CameraPath path, const SequenceOptions& options);

  int size() const { return num_frames_; }
  const Camera& camera() const { return renderer_->camera(); }
  const Scene& scene() const { return renderer_->scene(); }
  const SequenceOptions& options() const { return options_; }

  // 0 <= i < size() in all of these.
  Stamp stamp(int i) const;
  Se3 T_world_camera(int i) const;
  RgbdFrame Frame(int i) const;                               // as the sensor sees it
  RenderedView Truth(int i) const;                            // without noise
  RgbdFrame Observe(int i, const RenderedView& truth) const;  // Frame(i), if Truth(i) is at hand

 private:
  std::shared_ptr<const Renderer> renderer_;
  CameraPath path_;
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

}  // namespace cslam
