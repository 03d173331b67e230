// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/skeleton.h"
#include "cslam/assets/blend_file_contents.h"

#include <filesystem>
#include <string_view>

namespace cslam {

// Our joints in the rest pose of a MakeHuman armature (arms spread, elbows bent), scaled about the
// floor's origin. Heel and toes are left for whoever knows the shoes. Throws Error naming the file
// and the bone that is missing.
Skeleton SkeletonOfRig(const BlendContents& rig, const Eigen::Vector3d& scale, double floor_m,
                       const std::filesystem::path& file);

// The joint that moves a MakeHuman vertex group.
Joint JointOfGroup(std::string_view group);

}  // namespace cslam
