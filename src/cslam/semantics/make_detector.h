// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/detector.h"
#include "cslam/semantics/detector_options.h"

#include <memory>
#include <string>

namespace cslam {

struct MadeDetector {
  std::unique_ptr<Detector> detector;
  std::string warning;  // one line to show the user; empty: nothing to say
};

// The detector that the options ask for. No model installed and none named: a NullDetector and a
// warning. Throws Error for an unknown kind, a model or file that is not there or not usable, and
// contradicting options.
MadeDetector MakeDetector(const DetectorOptions& options);

}  // namespace cslam
