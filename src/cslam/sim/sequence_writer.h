// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/simulated_sequence.h"

#include <filesystem>
#include <functional>
#include <stop_token>

namespace cslam {

enum class ExistingFolder {
  kRefuse,     // a folder that holds anything is an error
  kOverwrite,  // files of the same names are replaced, others stay
};

struct WriteSequenceOptions {
  int jobs = 1;  // threads; the files do not depend on it
  ExistingFolder existing = ExistingFolder::kRefuse;
  // Called after each frame with the frames done so far and all of them, from any thread but one
  // call at a time.
  std::function<void(int done, int total)> progress = {};
  std::stop_token stop = {};  // asks to end early
};

enum class WriteOutcome { kComplete, kStopped };

// Renders a sequence into folder in TUM's layout: rgb/ (8-bit PNG), depth/ (16-bit PNG, 5000 units
// per metre), rgb.txt, depth.txt, associations.txt, groundtruth.txt and camera.yaml. The lists are
// written after all images and camera.yaml last of all, so a folder that has it is complete.
// Throws Error if the folder cannot be used.
WriteOutcome WriteSequence(const SimulatedSequence& sequence, const std::filesystem::path& folder,
                           const WriteSequenceOptions& options);

}  // namespace cslam
