// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/detection.h"
#include "cslam/vision/rgbd_frame.h"

#include <string>

namespace cslam {

// What run.json says about a detector.
struct DetectorInfo {
  std::string kind;    // "dnn", "recorded" or "none"
  std::string name;    // of the model or of the recorded sequence
  std::string source;  // file
};

// Finds objects in one frame after the other. Synchronous: who wants a thread gives it one; for one
// thread at a time. The result names the frame it belongs to, which may be an older one than was
// given last. Boxes lie inside the image and are not empty.
class Detector {
 public:
  virtual ~Detector() = default;
  Detector() = default;
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;

  virtual Detections Detect(const RgbdFrame& frame) = 0;
  virtual DetectorInfo info() const = 0;
};

// Sees nothing.
class NullDetector final : public Detector {
 public:
  Detections Detect(const RgbdFrame& frame) override { return {frame.id, frame.stamp, {}}; }
  DetectorInfo info() const override { return {.kind = "none", .name = "", .source = ""}; }
};

}  // namespace cslam
