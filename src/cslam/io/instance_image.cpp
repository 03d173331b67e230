// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/instance_image.h"

#include "cslam/io/image_codec.h"
#include "cslam/io/png_stream.h"
#include "cslam/io/text_lines.h"
#include "cslam/util/check.h"

#include <opencv2/core.hpp>

#include <string>

namespace cslam {
namespace {

constexpr int kMaxSidePx = 16384;       // as for other images
constexpr int kMax8BitInstances = 256;  // the room and 255 objects
constexpr int kCompression = 6;         // large even areas: small files, and still fast

}  // namespace

cv::Mat ReadInstanceImage(const std::filesystem::path& path) {
  const std::string bytes = ReadBytes(path, "image");
  PngReader reader(bytes);
  if (!reader.ReadHeader(kMaxSidePx))
    throw Error("cannot decode instance image '{}': {}", path.string(), reader.problem());
  const PngHeader header = reader.header();
  const bool is_known = header.channels == 1 && !header.is_palette &&
                        (header.bit_depth == 8 || header.bit_depth == 16);
  if (!is_known) {
    throw Error("instance image '{}' is a {}-bit PNG with {}, expected 8 or 16 bits and 1 channel",
                path.string(), header.bit_depth,
                header.is_palette ? "a palette" : fmt::format("{} channel(s)", header.channels));
  }
  if (header.bit_depth == 16) reader.RequestHostByteOrder();
  cv::Mat stored(header.height, header.width, header.bit_depth == 16 ? CV_16UC1 : CV_8UC1);
  if (!reader.ReadPixels(stored.data, stored.step[0]))
    throw Error("cannot decode instance image '{}': {}", path.string(), reader.problem());
  cv::Mat instances;
  stored.convertTo(instances, CV_16U);
  return instances;
}

void WriteInstanceImage(const std::filesystem::path& path, const cv::Mat& instances,
                        int num_instances) {
  CSLAM_CHECK(instances.type() == CV_16UC1, "type {}", instances.type());
  cv::Mat stored = instances;
  if (num_instances <= kMax8BitInstances) instances.convertTo(stored, CV_8U);
  WritePng(path, stored, kCompression);
}

}  // namespace cslam
