// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/eval/ate.h"
#include "cslam/geometry/trajectory.h"

#include <filesystem>
#include <optional>
#include <string>

namespace cslam {

struct TrajectoryPlot {
  std::string title;             // the sequence
  Trajectory estimate;           // in its own world
  Trajectory reference;          // drawn only together with ate, which brings both into one frame
  std::optional<AteResult> ate;  // of this estimate against this reference
};

// An SVG image: the path from above, and below it the error over time. With a reference, "above"
// is the plane of the two axes along which the reference extends most, and the estimate is aligned
// and coloured by its error. Without one it is the x-z plane of the first camera, and the lower
// panel shows the height. Both directions have the same scale. Equal input gives equal bytes.
std::string FormatTrajectorySvg(const TrajectoryPlot& plot);

// The file appears under its name only when complete.
void WriteTrajectorySvg(const std::filesystem::path& path, const TrajectoryPlot& plot);

}  // namespace cslam
