// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/render_record.h"
#include "cslam/sim/simulated_sequence.h"

#include <filesystem>

namespace cslam {

constexpr double kDepthUnitsPerM = 5000.0;  // of the depth images: TUM's

// Writes all that is not images beside the images of a rendering, which must be there: lists,
// trajectory, truth files, contact sheet, README.txt and, last of all, camera.yaml. The bytes
// depend on the sequence and the images alone.
void WriteSequenceSummary(const SimulatedSequence& sequence, const RenderRecord& record,
                          const std::filesystem::path& folder);

}  // namespace cslam
