// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/vision/box.h"

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace cslam {

class OptionList;

// A reduced depth image of a camera without distortion: pixel (u, v) looks along the ray of the
// undistorted full-size pixel in its middle. All regions and their boxes are in such pixels.
struct DepthView {
  cv::Mat depth_mm;  // CV_16UC1; 0 = no reading or beyond 65 m
  int step = 4;      // full-size pixels per thumbnail pixel
  Camera camera;     // of the full-size image

  bool empty() const { return depth_mm.empty(); }
  // Readings in metres; 0 = none. (u, v) in thumbnail pixels, inside.
  float DepthM(int u, int v) const {
    return 0.001F * static_cast<float>(depth_mm.at<std::uint16_t>(v, u));
  }
  Eigen::Vector3d PointAt(int u, int v, double depth_m) const;  // camera frame, m
};

// Makes depth views of one camera's images.
class DepthViewMaker {
 public:
  explicit DepthViewMaker(const Camera& camera);

  // depth_m: H x W, CV_32FC1, as recorded (empty: the view is, too).
  DepthView Make(const cv::Mat& depth_m) const;

  // Boxes around what a box covers, from recorded to undistorted pixels and back.
  Box Undistorted(const Box& raw) const;
  Box Distorted(const Box& undistorted) const;

 private:
  Camera camera_;
  int step_;
  cv::Mat sources_;  // CV_32SC2: recorded pixel (u, v) of each thumbnail pixel; -1: outside
};

// The part of a depth view that one thing covers.
struct DepthRegion {
  cv::Mat mask;  // CV_8UC1 of the view's size, 255 inside; empty for no region
  int num_pixels = 0;
  Box box;                                                  // full-size px
  float median_m = 0.0F;                                    // of the readings inside
  Eigen::Vector3d centre_camera = Eigen::Vector3d::Zero();  // median of the points, m
  bool is_flat = false;     // of a box: nothing stands out from the floor or wall around ...
  bool is_on_wall = false;  // ... and that is a wall
  double support = 0.0;     // carried regions: share of the expected pixels whose depth agrees

  bool empty() const { return num_pixels == 0; }
};

// A detector's box is tight, so what continues from around it into it is not the thing: the floor
// it stands on, the wall behind it.
struct BoxBackgroundOptions {
  bool enabled = true;
  double ring_share = 0.15;         // width of the ring around the box, as share of its size
  double min_support = 0.15;        // of the ring's readings, for a plane
  double tolerance_m = 0.02;        // of a plane, at least ...
  double tolerance_per_m2 = 0.010;  // ... and with the depth squared
  double min_foreground = 0.1;      // share of the box that must be left for this to be believed
};
void Describe(OptionList& list, BoxBackgroundOptions& options);

// What hides part of the thing goes on beyond the box, too: the arm of the chair on which it sits.
struct BoxOccluderOptions {
  bool enabled = true;
  double max_share = 0.75;  // of the box's width that it covers; more, and it is the thing itself
};
void Describe(OptionList& list, BoxOccluderOptions& options);

struct RegionOptions {
  double person_band_m = 0.33;    // surface depth of a person around the box's main depth
  double movable_band_m = 0.25;   // the same of other things
  double person_reach_m = 0.80;   // a person's arms and legs reach so far in depth
  double movable_reach_m = 0.80;  // other things, at most; less if their box is smaller
  double step_ratio = 0.03;       // depth step, as share of the depth, that parts two surfaces
  double box_margin = 0.08;       // how far a region may leave its box, as share of its size
  double carry_tolerance_m = 0.15;
  double carry_speed_mps = 1.5;
  double min_support = 0.25;
  BoxBackgroundOptions background;  // of things other than people
  BoxOccluderOptions occluder;      // the same
};
void Describe(OptionList& list, RegionOptions& options);

// What belongs to the thing inside box: the connected surface around the main depth of the box's
// middle. is_person chooses band and reach. Pixels set in excluded (of the view's size, or empty)
// are taken by things in front and left out. Empty where depth shows nothing.
DepthRegion SegmentBox(const DepthView& view, const Box& box, bool is_person,
                       const cv::Mat& excluded, const RegionOptions& options);

// What a detector's mask covers (CV_8UC1, non-zero inside, stretched over box), as far as excluded
// and the depth do not speak against it: for networks that give masks beside boxes.
DepthRegion SegmentMask(const DepthView& view, const Box& box, const cv::Mat& mask, bool is_person,
                        const cv::Mat& excluded, const RegionOptions& options);

// Where a region of an earlier view is now: its points are moved by the camera's motion and the
// thing's own shift (m, in the new camera's frame), those whose depth agrees are kept, and the
// region is grown again over the surface they lie on, up to margin_px beyond. Empty if fewer than
// min_support agree.
DepthRegion CarryRegion(const DepthView& from, const DepthRegion& region, const DepthView& to,
                        const Se3& T_to_from, const Eigen::Vector3d& shift_m, double margin_px,
                        bool is_person, const RegionOptions& options);

// The connected surfaces in reach that contain seeds (CV_8UC1, non-zero): grown from pixel to
// neighbour where depth is continuous, only where allowed (CV_8UC1 or empty: everywhere) and
// within reach_m of the seeds' median depth.
DepthRegion GrowRegion(const DepthView& view, const cv::Mat& seeds, const cv::Mat& allowed,
                       double reach_m, double step_ratio);

}  // namespace cslam
