// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/render_record.h"
#include "cslam/dataset/sequence_folder.h"
#include "cslam/sim/simulated_sequence.h"

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>

namespace cslam {

struct WriteSequenceOptions {
  int jobs = 1;  // threads; the files do not depend on it
  ExistingFolder existing = ExistingFolder::kRefuse;
  // Called with the frames that are there already (0 unless resumed) and all of them, then after
  // each further frame; from any thread but one call at a time.
  std::function<void(int done, int total)> progress = {};
  std::stop_token stop = {};  // asks to end early
};

enum class WriteOutcome { kComplete, kStopped };

// Renders a sequence into folder in TUM's layout, with the truth about it (docs/formats.md).
// render.json is written first, the lists and truth files after all images and camera.yaml last of
// all, so a folder that has camera.yaml is complete. What was stopped, killed or met a full disk
// goes on with ExistingFolder::kResume and ends with the same bytes. record: must be of sequence
// (DescribeSequence()). Throws Error if the folder cannot be used.
WriteOutcome WriteSequence(const SimulatedSequence& sequence, const RenderRecord& record,
                           const std::filesystem::path& folder,
                           const WriteSequenceOptions& options);

// Bytes of a frame's images on disk, the mean of `count` frames evenly spread over the sequence.
// Renders those that folder, which PrepareSequenceFolder() has made ready, does not hold yet.
double MeasureFrameBytes(const SimulatedSequence& sequence, const std::filesystem::path& folder,
                         int count);

// Time of one core for a frame, written to the disk, in s: that of one in the middle whose scene
// has been made for the one before. Renders both into folder, as MeasureFrameBytes() does.
double MeasureFrameSeconds(const SimulatedSequence& sequence, const std::filesystem::path& folder);

// WriteSequence() for a sequence of no name.
WriteOutcome WriteSequence(const SimulatedSequence& sequence, const std::filesystem::path& folder,
                           const WriteSequenceOptions& options);

}  // namespace cslam
