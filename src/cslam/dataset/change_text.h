// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/truth_files.h"

#include <string>

namespace cslam {

// "chair moved", "chair replaced by umbrella"; an object that is not listed is "object 7".
std::string Describe(const TrueChange& change, const TrueObjects& objects);

// The listed object's name.
std::string NameOfObject(const TrueObjects& objects, int instance);

}  // namespace cslam
