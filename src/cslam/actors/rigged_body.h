// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/person_look.h"
#include "cslam/actors/skinned_body.h"
#include "cslam/assets/blend_file_contents.h"

#include <filesystem>

namespace cslam {

// The clothed man of morse-simulator-data's human_rig.blend (made with MakeHuman), his clothes,
// skin and hair recoloured, his size changed. `file` stands in errors: the rig must have the bones
// and parts this was written for.
SkinnedBody MakeRiggedBody(const BlendContents& rig, const PersonLook& look,
                           const std::filesystem::path& file);

}  // namespace cslam
