// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/messages/loop_messages.h"

#include <span>
#include <string>

namespace cslam {

// The text of loops.json: every candidate for a loop or a merge, with evidence, verdict and reason
// (docs/formats.md).
std::string FormatLoopsJson(std::span<const LoopRecord> records);

}  // namespace cslam
