// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/skinned_body.h"

#include <Eigen/Core>

#include <span>

namespace cslam {

// An oval cross-section of a limb.
struct Ring {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // m, body frame
  double front_m = 0.05;                             // radius along the tube's first axis
  double side_m = 0.05;                              // radius along its second axis
  Joint joint = kPelvis;
  Joint other = kPelvis;
  double other_share = 0.0;  // of the second joint
};

// How a tube's rings lie and what covers it.
struct TubeLook {
  Eigen::Vector3d first_axis = Eigen::Vector3d::UnitX();
  Eigen::Vector3d second_axis = Eigen::Vector3d::UnitY();
  int picture = 0;
  // u runs from behind over the second axis' far side to the front and on; one picture is this wide
  // and high. Zero: the picture is wrapped once around and stretched along.
  double picture_width_m = 0.0;
  double picture_height_m = 0.0;
  double boxiness = 2.0;  // exponent: 2 oval, more: nearer to a rectangle
};

// Adds a closed tube through the rings (from top to bottom or from back to front; the axes and the
// direction of the rings must be left-handed: first x second points against it).
void AddTube(std::span<const Ring> rings, const TubeLook& look, SkinnedBody& body);

}  // namespace cslam
