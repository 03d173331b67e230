// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/sequence_check.h"

#include <string>

namespace cslam {

// What `dataset check` prints: findings, figures and a verdict.
std::string FormatCheck(const SequenceCheck& check);

// The same as JSON.
std::string FormatCheckJson(const SequenceCheck& check);

}  // namespace cslam
