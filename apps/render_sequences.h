// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/asset_fetch.h"
#include "cslam/dataset/rendering.h"
#include "cslam/dataset/sequence_folder.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

struct RenderArguments {
  std::vector<std::string> names;  // of sequences, or "all"
  std::filesystem::path folder;    // of one sequence; of several: one folder each below it
  RenderRequest request;
  Look look = Look::kAuto;
  int jobs = 0;  // 0: one for each core
  ExistingFolder existing = ExistingFolder::kRefuse;
};

// Throws UsageError, with the nearest name, if there is none.
SequenceEntry FindSequence(std::string_view name);

struct RenderEstimate {
  int num_frames = 0;
  double bytes = 0.0;
  double seconds = 0.0;  // on all cores; a few frames tell it to a factor of two
};

// What rendering one sequence into arguments.folder will take. Renders a few of its frames there,
// which the rendering then finds done. Nothing if the user interrupts it. Throws Error if the
// folder cannot be used.
RenderEstimate EstimateRendering(const RenderArguments& arguments);

// Does what `dataset render` was asked to; says on stderr what, how large and how far. Returns the
// exit code. Throws Error, UsageError for unknown names.
int RenderSequences(const RenderArguments& arguments);

}  // namespace cslam
