// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "disk_space.h"

#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>

namespace cslam {
namespace {

namespace fs = std::filesystem;

// Free space where folder is or will be; nothing if the system does not tell.
std::optional<double> FreeBytes(const fs::path& folder) {
  std::error_code error;
  fs::path existing = fs::absolute(folder, error);
  while (!existing.empty() && !fs::exists(existing, error) && existing != existing.root_path())
    existing = existing.parent_path();
  const fs::space_info space = fs::space(existing, error);
  if (error) return std::nullopt;
  return static_cast<double>(space.available);
}

}  // namespace

std::string FormatBytes(double bytes) {
  constexpr double kMega = 1e6;
  constexpr double kGiga = 1e9;
  if (bytes >= kGiga) return fmt::format("{:.1f} GB", bytes / kGiga);
  if (bytes >= kMega) return fmt::format("{:.0f} MB", bytes / kMega);
  return fmt::format("{:.0f} kB", std::max(1.0, bytes / 1e3));
}

void CheckFreeSpace(const fs::path& folder, double needed_bytes) {
  const std::optional<double> free_bytes = FreeBytes(folder);
  if (free_bytes && *free_bytes < needed_bytes) {
    throw Error(
        "'{}' has {} free, and about {} more are needed; choose another folder, or fewer or "
        "smaller frames",
        folder.string(), FormatBytes(*free_bytes), FormatBytes(needed_bytes));
  }
}

double BytesIn(const fs::path& folder) {
  std::error_code error;
  double bytes = 0.0;
  for (fs::recursive_directory_iterator entry(folder, error), end; entry != end && !error;
       entry.increment(error)) {
    std::error_code none;
    const auto size = entry->is_regular_file(none) ? entry->file_size(none) : 0;
    if (!none) bytes += static_cast<double>(size);
  }
  return bytes;
}

}  // namespace cslam
