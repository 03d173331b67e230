// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/best_first_matching.h"
#include "cslam/objects/followed_object.h"
#include "cslam/objects/object_sighting.h"
#include "cslam/objects/object_tracker_options.h"
#include "cslam/objects/object_uses.h"
#include "cslam/semantics/detection.h"
#include "cslam/util/id.h"
#include "cslam/util/stamp.h"

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cslam {

// A thing followed from frame to frame, as others may see it.
struct TrackedObject {
  TrackId track;
  int class_id = -1;  // COCO; -1: moves, but no detector named it
  double score = 0.0;
  Box box;  // in the newest frame as recorded, full-size px
  ObjectMotion motion = ObjectMotion::kUnknown;
  KeypointLabel label = KeypointLabel::kDynamic;           // of its keypoints
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();       // m
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();  // world
  bool is_detected = false;  // by the detector in this very frame; otherwise carried on
};

// Follows detected things through the frames (Algorithm 2 and the object filter of the paper), and
// says which keypoints are theirs. Detections may be late: they are matched in the frame they
// belong to and carried forward. Synchronous; one call of each of Observe() and Settle() a frame.
class ObjectTracker {
 public:
  ObjectTracker(const Camera& camera, const ObjectTrackerOptions& options);

  // Before the frame's pose is known. T_world_predicted: where the camera probably is;
  // T_world_last: where it was in the last settled frame, in the world as it is now.
  void Observe(FrameId frame, Stamp stamp, const cv::Mat& depth_m, const Se3& T_world_predicted,
               const Se3& T_world_last, const Detections* detections);

  // Labels for keypoints of the frame observed.
  std::vector<KeypointSemantics> Label(std::span<const Keypoint> keypoints) const;

  // Thumbnail mask (undistorted) of what keypoints must not come from; empty if nothing.
  cv::Mat DynamicMask() const;

  // Looks for things that move though no detector named them, given a good first guess of the
  // pose and its inliers; they become objects without a class. Returns how many were found; labels
  // and mask know them from then on.
  int FindUnknown(const Se3& T_world_camera, int num_inliers);

  // Once the pose is known: the filters take in what was seen.
  void Settle(const Se3& T_world_camera, const Eigen::Matrix3d& position_covariance_m2);
  // Instead, where the frame's pose was not found: objects are carried on, no filter learns.
  void SettleLost();

  // The objects of the newest frame, by id.
  std::vector<TrackedObject> objects() const;

  // Those of them that have a name, a surface in this frame and do not move.
  std::vector<ObjectSighting> Sightings() const;

  // The newest frame's depth.
  const DepthView& view() const { return now_.view; }

  // From here on poses are in another world: positions are forgotten, things in view are not.
  void StartWorld();

  // Forgets everything but the ids handed out.
  void Clear();

 private:
  using Object = FollowedObject;
  struct PastObject {
    TrackId id;
    Box box;
  };
  struct Frame {
    FrameId id;
    Stamp stamp;
    DepthView view;
    Se3 T_world_camera;  // predicted until settled
    bool is_settled = false;
    double turn_rate_dps = 0.0;  // since the frame before
    std::vector<PastObject> objects;
  };

  void MoveWorld(const Se3& T_world_last);
  void Remember();
  DepthRegion Carried(const Frame& from, const DepthRegion& region, const Object& object) const;
  void NoteTravel(Object& object) const;
  SurfaceMotion SurfaceMotionOf(const Object& object) const;
  void TakeIn(const Detections& detections);
  void Associate(const Frame& frame, const std::vector<Detection>& detections);
  std::vector<BoxOverlap> Overlaps(const Frame& frame, const Detection& detection,
                                   std::size_t index, const DepthRegion& region_now) const;
  void ForgetPiecesOf(TrackId whole);
  void Renew(std::optional<TrackId> id, const Detection& detection, DepthRegion region,
             const Frame& frame);
  void Forget();
  void AddUnknown(const DepthRegion& region, const Se3& T_world_camera);
  const Frame* SettledBefore(double age_s) const;
  double TurnRateDps(const Se3& T_world_camera) const;
  KeypointLabel LabelOf(const Object& object) const { return uses_.LabelOf(object); }
  double AreaM2(const DepthRegion& region) const;

  const Camera camera_;
  const DepthViewMaker views_;
  const ObjectTrackerOptions options_;
  const ObjectUses uses_;
  std::vector<Object> objects_;  // by id
  std::deque<Frame> history_;    // settled frames, oldest first
  Frame now_;
  std::uint32_t next_track_ = 0;
  std::optional<FrameId> newest_taken_;
};

}  // namespace cslam
