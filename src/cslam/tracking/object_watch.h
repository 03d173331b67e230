// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"
#include "cslam/messages/messages.h"
#include "cslam/objects/expected_view.h"
#include "cslam/objects/object_classes.h"
#include "cslam/objects/persistence.h"

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace cslam {

class OptionList;

struct ObjectWatchOptions {
  bool enabled = true;
  double view_interval_s = 0.2;      // views closer in time are no news
  double max_turn_rate_dps = 100.0;  // faster, colour and depth do not belong together
  double pose_sigma_m = 0.15;        // of a pose with one inlier; falls with their square root
  double max_miss_depth_m = 3.0;     // farther, a missing detection says nothing
  double force_log_ratio = 2.0;      // so much evidence against what the map says is told at once
  double new_after_s = 0.4;          // a thing detected for so long that is not in the map as well

  // What the mapper goes by too: Slam takes them from mapping.objects.
  ObjectClassOptions classes;
  PersistenceOptions belief;
  ExpectedViewOptions view;
};
void Describe(OptionList& list, ObjectWatchOptions& options);

// What one frame offers to the watch.
struct WatchedFrame {
  Stamp stamp;
  MapId map;
  Se3 T_world_camera;
  int num_inliers = 0;
  const DepthView* view = nullptr;
  std::span<const ObjectSighting> sightings;
  std::optional<Stamp> detections;  // the frame of the newest detections there are
};

// Compares every frame with the objects of the map and gathers evidence for and against them
// until a proposal takes it along. Never changes a belief: that is the mapper's.
class ObjectWatch {
 public:
  explicit ObjectWatch(const ObjectWatchOptions& options);

  void Look(const WatchedFrame& frame, const MapView& map);

  // Whether something was seen that the map should know though the camera may stand still.
  bool HasNews(const MapView& map) const;

  std::vector<ObjectEvidence> Take();

  void Clear();

 private:
  struct Watched {
    ObjectEvidence evidence;
    std::optional<Stamp> last_view;       // that told something
    std::optional<Stamp> last_detection;  // taken in
  };

  // What one frame shows of one object of the map.
  struct ViewedObject {
    const MapObject* object = nullptr;
    Se3 T_camera_object;
    Eigen::Vector3d centroid_camera = Eigen::Vector3d::Zero();  // m
    ExpectedView expected;
    const ObjectSighting* sighting = nullptr;  // of it, and of no other object

    bool MayBeThere() const;
  };

  std::vector<ViewedObject> ViewObjects(const WatchedFrame& frame, const MapView& map) const;
  void ShareSightings(const WatchedFrame& frame, std::vector<ViewedObject>& viewed) const;
  void Judge(const ViewedObject& viewed, const WatchedFrame& frame);
  void LookForNew(const WatchedFrame& frame, const MapView& map);

  const ObjectWatchOptions options_;
  const ObjectClasses classes_;

  std::map<ObjectId, Watched> watched_;
  std::map<TrackId, bool> told_;  // new things; true once a proposal has taken them along
  std::optional<Stamp> newest_detections_;
  bool has_new_detections_ = false;
  std::optional<Se3> T_world_last_;
  Stamp last_stamp_;
};

}  // namespace cslam
