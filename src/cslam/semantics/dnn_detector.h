// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/detector.h"
#include "cslam/semantics/model_description.h"

#include <cstddef>
#include <memory>

namespace cslam {

// A network run on the CPU by OpenCV. Equal frames give equal detections.
class DnnDetector final : public Detector {
 public:
  // Loads the network and runs it once. num_threads: of OpenCV, for the whole process. Throws Error
  // if the network cannot be read or does not fit its description.
  explicit DnnDetector(ModelDescription model, int num_threads = 1);
  ~DnnDetector() override;

  // The frame's colour image, or its grey one where that is empty.
  Detections Detect(const RgbdFrame& frame) override;
  DetectorInfo info() const override;

  // Most detections of one frame; the best are kept.
  static constexpr std::size_t kMaxDetections = 100;

 private:
  struct Network;

  ModelDescription model_;
  std::unique_ptr<Network> network_;
};

}  // namespace cslam
