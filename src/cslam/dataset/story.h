// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/person.h"
#include "cslam/assets/prop_library.h"
#include "cslam/sim/camera_motion.h"
#include "cslam/sim/world.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace cslam {

enum class SensorKind { kKinect, kD435i };

// How much of the picture people fill, as the story promises; checked on the rendered frames.
struct PeopleClaim {
  double min_mean_share = 0.0;  // mean over the frames
  double min_peak_share = 0.0;  // of the fullest frame
  bool leave_view = false;      // in at least one frame nobody is seen after someone was
};

// One sequence, ready to be rendered at any rate. Times are seconds since its start.
struct Story {
  World world;
  CameraMotion camera;
  std::function<double(double time_s)> exposure;  // factor on the light; empty: always 1
  SensorKind sensor = SensorKind::kKinect;
  PeopleClaim people;
};

// What a story is made with.
struct StoryOptions {
  std::uint64_t seed = 1;  // textures, clutter, variants of props, small movements
  bool is_short = false;   // the same story within 40 s
  double texels_per_m = 960.0;
};

struct Stage {
  const PropLibrary& props;
  const AssetFolder* assets;  // for people; null: the plain look
};

// A sequence that can be asked for by name.
struct SequenceEntry {
  std::string_view name;
  std::string_view summary;  // one line
  SensorKind sensor = SensorKind::kKinect;
  double duration_s = 0.0;
  double short_duration_s = 0.0;
  Story (*make)(const Stage& stage, const StoryOptions& options) = nullptr;
};

// In the order of `dataset list`.
std::span<const SequenceEntry> AllSequences();

}  // namespace cslam
