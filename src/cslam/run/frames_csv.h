// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/messages/messages.h"

#include <string>
#include <vector>

namespace cslam {

// One line per frame (RFC 4180, but lines end with a bare newline); docs/formats.md names the
// columns. Each stage that ran in any frame has a column; where it did not run the field is empty.
std::string FormatFramesCsv(const std::vector<TrackingResult>& frames);

}  // namespace cslam
