// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/dataset.h"
#include "cslam/io/point_cloud_file.h"
#include "cslam/pipeline/run_result.h"

#include <vector>

namespace cslam {

// The usable points of the map that holds most frames, by id. Those of an object have the bright
// colour of its id. All others take theirs from the pixel in
// which its reference keyframe sees it; that image is read from the data set again. Points whose
// image cannot be read are grey.
std::vector<ColoredPoint> ColourMap(const RunResult& result, const DatasetReader& dataset);

}  // namespace cslam
