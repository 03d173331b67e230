// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/reprojection_check.h"
#include "cslam/dataset/story_check.h"
#include "cslam/dataset/truth_check.h"
#include "cslam/io/camera_file.h"
#include "cslam/io/dataset_check.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

struct SequenceCheckOptions {
  CameraChoice camera = {};
  std::optional<std::size_t> num_samples = {};  // frames to decode; all unless told
};

// What `changing-slam dataset check` found. Errors make a sequence unfit for use, warnings are
// things to know; skipped tells what could not be checked, and why.
struct SequenceCheck {
  Findings errors;
  Findings warnings;
  Findings skipped;
  DatasetCheck files;
  std::string pose_file;  // empty if there is none
  std::optional<ReprojectionResult> reprojection;
  std::optional<DepthTolerance> tolerance;  // depth was judged by; absent for recordings
  std::optional<TruthCheckResult> truth;
  std::optional<StoryEvidence> story;
};

// Checks files, depth against poses, truth files against each other, and the story, as far as the
// folder has them. Broken files are findings; throws Error only if folder is no data set at all.
SequenceCheck CheckSequence(const std::filesystem::path& folder,
                            const SequenceCheckOptions& options = {});

}  // namespace cslam
