// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/benchmark/run_figures.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace cslam {

// A box with a word about it.
struct LabelledBox {
  PlacedBox box;
  std::string label;
};

// A run and the truth from above; all in the truth's world (z up, m).
struct TopView {
  std::string title;
  std::vector<Eigen::Vector3d> path;    // of the camera
  std::vector<Eigen::Vector3d> points;  // active ones of the map
  std::vector<Eigen::Vector3d> ghosts;
  std::vector<LabelledBox> present;  // true ones at the end
  std::vector<LabelledBox> former;   // where something was
  std::vector<LabelledBox> found;    // as the run says, present
  std::vector<LabelledBox> absent;   // as the run says, gone
};

TopView MakeTopView(std::string title, const SceneTruth& truth, const SceneRun& run,
                    const RunEvaluation& evaluation);

// An SVG document.
std::string FormatTopViewSvg(const TopView& view);

}  // namespace cslam
