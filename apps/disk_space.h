// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace cslam {

// "1.2 GB", "35 MB", "7 kB".
std::string FormatBytes(double bytes);

// Throws Error if the disk on which folder is, or will be, has less than so many bytes free. Says
// nothing where the system does not tell.
void CheckFreeSpace(const std::filesystem::path& folder, double needed_bytes);

// Of all files in folder and below; 0 if there is none.
double BytesIn(const std::filesystem::path& folder);

}  // namespace cslam
