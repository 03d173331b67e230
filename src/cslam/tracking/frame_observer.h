// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/messages/messages.h"
#include "cslam/objects/object_tracker.h"
#include "cslam/tracking/pose_history.h"
#include "cslam/tracking/tracker_options.h"
#include "cslam/vision/orb.h"

#include <memory>
#include <optional>
#include <vector>

namespace cslam {

// Turns a frame into the features that the room can be recognised by: extracts, measures, labels,
// leaves out what belongs to people and moving things, and takes more from the background where
// too few remain.
class FrameObserver {
 public:
  FrameObserver(const Camera& camera, const TrackerOptions& options);

  // detections: the newest there are, of this frame or an earlier one; null: none yet.
  // Fills the result's times and counts.
  std::shared_ptr<KeyframeData> Observe(const RgbdFrame& frame,
                                        const std::optional<PosePrediction>& prediction,
                                        const Detections* detections, TrackingResult& result);

  // Given a good first guess of the pose: leaves out what moves though no detector named it.
  // Returns one entry per keypoint of data, non-zero where it now counts as dynamic; empty if
  // nothing was found.
  std::vector<std::uint8_t> FindUnknown(const Se3& T_world_camera, int num_inliers,
                                        const KeyframeData& data);

  // The reduced depth image a keyframe keeps: without people and what moves.
  cv::Mat RestingDepth(const cv::Mat& depth_m) const;

  // The tracked things of the frame.
  const ObjectTracker& objects() const { return objects_; }

  // Closes the frame. T_world_camera: its pose, or nothing if it was not found.
  void Settle(const std::optional<Se3>& T_world_camera, TrackingResult& result);

  // From here on poses are in another world: positions are forgotten, things in view are not.
  void StartWorld();

  // Forgets everything but the ids handed out.
  void Clear();

 private:
  FrameFeatures Measure(const RgbdFrame& frame, const cv::Mat& mask);
  std::vector<std::uint8_t> Label(FrameFeatures& features) const;

  const Camera camera_;
  const ImageBounds bounds_;
  const TrackerOptions& options_;
  OrbExtractor extractor_;
  ObjectTracker objects_;
};

// Takes the keypoints with a non-zero entry in is_dropped out of features.
FrameFeatures WithoutKeypoints(const FrameFeatures& features,
                               const std::vector<std::uint8_t>& is_dropped,
                               const ImageBounds& bounds);

}  // namespace cslam
