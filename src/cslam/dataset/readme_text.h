// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/render_record.h"
#include "cslam/geometry/camera.h"
#include "cslam/io/truth_files.h"

#include <string>

namespace cslam {

// README.txt of a rendered sequence: what it is, how to render it again, what its files hold, and
// what happens in it.
std::string FormatReadme(const RenderRecord& record, const Camera& camera,
                         const TrueObjects& objects, const TrueChanges& changes);

}  // namespace cslam
