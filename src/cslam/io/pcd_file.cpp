// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/pcd_file.h"

#include "cslam/util/atomic_file.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace cslam {
namespace {

static_assert(std::endian::native == std::endian::little, "floats are written as they are");

using PointBytes = std::array<char, 4 * sizeof(float)>;

PointBytes Pack(const ColoredPoint& point) {
  const auto [red, green, blue] = point.rgb;
  const std::uint32_t rgb = std::uint32_t{red} << 16 | std::uint32_t{green} << 8 | blue;
  PointBytes bytes{};
  std::memcpy(bytes.data(), point.position_m.data(), 3 * sizeof(float));
  std::memcpy(bytes.data() + 3 * sizeof(float), &rgb, sizeof(rgb));
  return bytes;
}

bool IsFinite(const ColoredPoint& point) {
  return point.position_m.allFinite();
}

}  // namespace

void WritePcd(const std::filesystem::path& path, std::span<const ColoredPoint> points) {
  const auto num_finite = std::count_if(points.begin(), points.end(), IsFinite);
  AtomicFile file(path);
  file.Print(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\n"
      "TYPE F F F F\nCOUNT 1 1 1 1\nWIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\n"
      "DATA binary\n",
      num_finite);
  for (const ColoredPoint& point : points) {
    if (!IsFinite(point)) continue;
    const PointBytes bytes = Pack(point);
    file.Write({bytes.data(), bytes.size()});
  }
  file.Commit();
}

}  // namespace cslam
