// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/map/keyframe.h"
#include "cslam/util/id.h"

#include <memory>
#include <string>

namespace cslam {

// tracker -> places: a frame whose pose was not found.
struct LostFrame {
  std::shared_ptr<const KeyframeData> data;
};

// places -> tracker: where such a frame was taken, or that nobody knows.
struct PlaceHint {
  FrameId frame;
  Stamp stamp;
  bool is_found = false;
  KeyframeId reference;  // sees the same place
  Se3 T_reference_camera;
  std::string reason;
};

}  // namespace cslam
