// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/check_frames.h"
#include "cslam/io/truth_files.h"
#include "cslam/vision/box.h"

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// What a sequence's truth files say; absent ones are not checked.
struct SequenceTruth {
  std::optional<DetectionRecord> detections;
  std::optional<TrueObjects> objects;
  std::optional<TrueChanges> changes;
};

// A contradiction, told in one line; long series of a kind end with "... and N more".
using Findings = std::vector<std::string>;

struct TruthCheckOptions {
  std::optional<std::size_t> num_samples =
      {};                         // frames whose images are looked at; all unless told
  DepthTolerance tolerance = {};  // of depth, for the boxes of objects
  // Share of an object's pixels that may lie outside its box: noisy depth bleeds at edges.
  double max_outside_share = 0.001;
};

struct TruthCheckResult {
  Findings errors;
  std::size_t num_frames = 0;      // frames whose instance image was looked at
  std::size_t num_regions = 0;     // instances seen in them
  std::size_t num_posed = 0;       // of those: compared with their oriented boxes
  double max_outside_share = 0.0;  // of pixels outside an object's box, of one instance and frame
};

// What an instance image shows of one instance.
struct VisibleRegion {
  Box box;  // exact
  int num_px = 0;
};

// By instance id, the room (0) not among them.
std::map<int, VisibleRegion> VisibleRegions(const cv::Mat& instances);

// Holds instance images, detections.json and objects.json against each other, frame by frame:
// ids, boxes, visible pixels, classes, presence, and whether the pixels of resting and moving
// objects lie in their oriented boxes.
TruthCheckResult CheckTruth(const CheckFrames& frames, const SequenceTruth& truth,
                            const TruthCheckOptions& options);

// Holds changes.json against objects.json: each change has the intervals that say so, and each
// coming, going and displacement of an object has its change.
Findings CheckChanges(const TrueObjects& objects, const TrueChanges& changes);

// The first few of a series, and how many there are besides.
void AppendShortened(Findings& to, const Findings& series, const std::string& what);

}  // namespace cslam
