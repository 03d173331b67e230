// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/io/truth_files.h"
#include "cslam/sim/simulated_sequence.h"
#include "cslam/sim/world.h"

#include <opencv2/core/mat.hpp>

#include <numbers>
#include <string>
#include <vector>

namespace cslam {

// Poses of people are stored so often; poses of things that are carried as the story gives them.
constexpr double kBodyRateHz = 10.0;
// Between resting places nearer than this (and turned less) nothing has changed.
constexpr double kMinMoveM = 0.01;
constexpr double kMinTurnRad = std::numbers::pi / 180.0;
// A removal and an addition of another class at most so far apart are one replacement.
constexpr double kReplaceDistanceM = 0.5;

// What is where from time 0 until duration_s (not included). An object is there at time t if an
// interval has from_s <= t < to_s. The box of a rigid object is that of its mesh, the box of a body
// holds it in all its poses. Objects that are never there have no intervals.
std::vector<TrueObject> BuildTrueObjects(const World& world, double duration_s);

struct View {
  double time_s = 0.0;
  Se3 T_world_camera;
};

// Who looks: tells what was in view between two times.
struct Observer {
  Camera camera;
  std::vector<View> views;  // in order of time
};

// What changed among the things at rest before duration_s, in order of time (then of instances):
//   moved      from one resting place to another, at once or carried without being away
//   removed    rested and is away afterwards
//   added      was away (or only ever moved), then rests
//   replaced   a removal and an addition of another class within kReplaceDistanceM, if the place
//              is in the observer's field of view in no view between the two
// Things that come, move and go without ever resting, people above all, change nothing. A thing
// that is being carried when the time is up has not moved yet.
std::vector<TrueChange> BuildTrueChanges(const World& world, const Observer& observer,
                                         double duration_s);

// The objects of known class (>= 0) in an image of instance ids (CV_16UC1), by id, with the exact
// boxes around their pixels.
std::vector<RecordedDetection> BuildDetections(const cv::Mat& instances, const Scene& scene);

// The first two for all frames of a sequence: duration_s = frames / fps.
TrueObjects BuildTrueObjects(const SimulatedSequence& sequence, const std::string& name);
TrueChanges BuildTrueChanges(const SimulatedSequence& sequence, const std::string& name);

}  // namespace cslam
