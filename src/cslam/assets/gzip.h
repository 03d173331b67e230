// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace cslam {

bool IsGzip(std::string_view bytes);

// The unpacked bytes. Throws Error that names the file if they are damaged or too many.
std::string Gunzip(std::string_view bytes, std::string_view file);

}  // namespace cslam
