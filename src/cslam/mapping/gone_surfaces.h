// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/map/map.h"
#include "cslam/mapping/past_options.h"
#include "cslam/mapping/past_place.h"
#include "cslam/objects/expected_view.h"
#include "cslam/objects/object_classes.h"
#include "cslam/vision/pixel_rays.h"

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <map>
#include <optional>
#include <vector>

namespace cslam {

// Which readings of keyframes were looked through later on: the traces of what has gone, whether or
// not it ever had a name. Kept up keyframe by keyframe; not saved with the map.
class GoneSurfaces {
 public:
  GoneSurfaces(const Camera& camera, const ExpectedViewOptions& view, const PastOptions& options);

  // The keyframe is new: what have earlier ones seen that it looks through? Returns whether there
  // was anything.
  bool LookThrough(const MapView& map, KeyframeId keyframe);

  // What has gone and looks like the object, of before it came, and was no other thing of its kind.
  // up_world: unit vector.
  std::optional<PastPlace> FindPast(const MapView& map, const MapObject& object,
                                    const ObjectClasses& classes,
                                    const Eigen::Vector3d& up_world) const;

  void Reset() { num_looks_.clear(); }

 private:
  struct Trace;
  bool HasThumbnails(const Keyframe& keyframe) const;
  std::vector<KeyframeId> Overlapping(const MapView& map, const Keyframe& keyframe) const;
  std::vector<Trace> TracesIn(const Keyframe& keyframe, const cv::Mat& looks,
                              const MapObject& object) const;
  bool IsAsLarge(const MapView& map, const Trace& trace, const MapObject& object,
                 const Eigen::Vector3d& up_world) const;
  std::vector<Trace> TracesOf(const MapView& map, const MapObject& object,
                              const ObjectClasses& classes) const;
  PastPlace PlaceOf(const Trace& trace, const std::vector<Trace>& all) const;
  bool IsOfOther(const MapView& map, const Trace& trace, const MapObject& object,
                 const ObjectClasses& classes) const;
  void CountLater(const MapView& map, PastPlace& place) const;
  bool Compare(const Keyframe& earlier, const Keyframe& later, cv::Mat& looks) const;
  PointVerdict Look(const Keyframe& earlier, const Se3& T_later_earlier, int u, int v,
                    const DepthSampler& later) const;
  Eigen::Vector3d PointAt(const KeyframeData& data, int u, int v) const;

  const Camera camera_;
  const ExpectedViewOptions view_;
  const PastOptions options_;
  const PixelRays rays_;  // of the depth thumbnail
  // By keyframe, of the size of its colour thumbnail (CV_8UC1): how many later ones looked through
  // a reading without one in between that saw it standing.
  std::map<KeyframeId, cv::Mat> num_looks_;
};

}  // namespace cslam
