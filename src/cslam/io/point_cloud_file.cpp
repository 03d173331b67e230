// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/point_cloud_file.h"

#include "cslam/util/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace cslam {
namespace {

constexpr std::size_t kBytesPerPoint = 3 * sizeof(float) + 3;
using PointBytes = std::array<char, kBytesPerPoint>;

std::string Header(std::size_t num_points, std::string_view comment) {
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  while (!comment.empty()) {
    const std::size_t end = std::min(comment.find('\n'), comment.size());
    header += fmt::format("comment {}\n", comment.substr(0, end));
    comment.remove_prefix(std::min(end + 1, comment.size()));
  }
  return header + fmt::format(
                      "element vertex {}\n"
                      "property float x\nproperty float y\nproperty float z\n"
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "end_header\n",
                      num_points);
}

PointBytes Pack(const ColoredPoint& point) {
  static_assert(std::endian::native == std::endian::little, "floats are written as they are");
  PointBytes bytes{};
  std::memcpy(bytes.data(), point.position_m.data(), 3 * sizeof(float));
  std::memcpy(bytes.data() + 3 * sizeof(float), point.rgb.data(), 3);
  return bytes;
}

bool IsFinite(const ColoredPoint& point) {
  return point.position_m.allFinite();
}

}  // namespace

void WritePointCloud(const std::filesystem::path& path, std::span<const ColoredPoint> points,
                     std::string_view comment) {
  const auto num_finite =
      static_cast<std::size_t>(std::count_if(points.begin(), points.end(), IsFinite));
  AtomicFile file(path);
  file.Write(Header(num_finite, comment));
  for (const ColoredPoint& point : points) {
    if (!IsFinite(point)) continue;
    const PointBytes bytes = Pack(point);
    file.Write({bytes.data(), bytes.size()});
  }
  file.Commit();
}

}  // namespace cslam
