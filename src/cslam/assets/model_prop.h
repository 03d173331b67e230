// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/furniture_catalogue.h"
#include "cslam/assets/obj_model.h"
#include "cslam/assets/package_models.h"
#include "cslam/assets/prop_brush.h"

#include <Eigen/Core>

namespace cslam {

// How a model is brought to a prop's frame and size.
struct ModelFit {
  Eigen::Matrix3d R_prop_model = Eigen::Matrix3d::Identity();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  // of the prop made of it
  double top_m = 0.0;                                // see PropLibrary::TopM
};

ModelFit FitModel(const PackageModel& choice, const CatalogueEntry& entry);

// The model's mesh, upright, at its size, standing on z = 0: fronts outwards, with normals, cut for
// light, and with texture coordinates for the materials that PaintModel makes. Glass is left out.
Mesh PrepareModel(ObjModel model, const PackageModel& choice, const ModelFit& fit);

// Puts the model's materials into the brush's scene; the result is parallel to `materials`. round:
// 0 keeps the model's colours, others change them where that makes sense.
std::vector<int> PaintModel(const std::vector<ObjMaterial>& materials, const PackageModel& choice,
                            int round, PropBrush& brush);

}  // namespace cslam
