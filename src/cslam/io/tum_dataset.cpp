// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/tum_dataset.h"

#include "cslam/io/image_codec.h"
#include "cslam/util/check.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace cslam {
namespace {

namespace fs = std::filesystem;

LoadResult Refuse(FrameFault fault, std::string problem) {
  return {.frame = std::nullopt, .fault = fault, .problem = std::move(problem)};
}

// Division, not multiplication by the inverse: it rounds correctly, so the metres of a pixel are
// the float nearest to the true quotient with every compiler.
cv::Mat ToMetres(const cv::Mat& raw, double units_per_m) {
  const auto units = static_cast<float>(units_per_m);
  cv::Mat depth_m(raw.rows, raw.cols, CV_32FC1);
  for (int y = 0; y < raw.rows; ++y) {
    const auto* from = raw.ptr<std::uint16_t>(y);
    auto* to = depth_m.ptr<float>(y);
    for (int x = 0; x < raw.cols; ++x)
      to[x] = static_cast<float>(from[x]) / units;
  }
  return depth_m;
}

std::string WrongSize(const char* kind, const fs::path& path, const cv::Mat& image,
                      const CameraConfig& camera) {
  return fmt::format("{} image '{}' is {}x{}, but the camera ({}) is {}x{}", kind, path.string(),
                     image.cols, image.rows, camera.name, camera.camera.width,
                     camera.camera.height);
}

bool HasSize(const cv::Mat& image, const Camera& camera) {
  return image.cols == camera.width && image.rows == camera.height;
}

}  // namespace

LoadResult LoadTumPair(const TumPair& pair, FrameId id, const CameraConfig& camera) {
  for (const fs::path* path : {&pair.color, &pair.depth}) {
    std::error_code ignored;
    if (!fs::exists(*path, ignored)) {
      return Refuse(FrameFault::kMissing, fmt::format("image '{}' does not exist", path->string()));
    }
  }
  cv::Mat bgr;
  cv::Mat raw_depth;
  try {
    bgr = ReadColorImage(pair.color);
    raw_depth = ReadDepthImage(pair.depth);
  } catch (const Error& error) {
    return Refuse(FrameFault::kUnreadable, error.what());
  }
  if (!HasSize(bgr, camera.camera)) {
    return Refuse(FrameFault::kWrongSize, WrongSize("colour", pair.color, bgr, camera));
  }
  if (!HasSize(raw_depth, camera.camera)) {
    return Refuse(FrameFault::kWrongSize, WrongSize("depth", pair.depth, raw_depth, camera));
  }
  RgbdFrame frame;
  frame.id = id;
  frame.stamp = pair.color_stamp;
  cv::cvtColor(bgr, frame.gray, cv::COLOR_BGR2GRAY);
  frame.bgr = std::move(bgr);
  frame.depth_m = ToMetres(raw_depth, camera.depth_units_per_m);
  return {.frame = std::move(frame), .fault = FrameFault::kNone, .problem = {}};
}

TumDataset::TumDataset(TumIndex index, CameraConfig camera, const DatasetOptions& options)
    : index_(std::move(index)),
      camera_(std::move(camera)),
      from_(options.from),
      is_strict_(options.is_strict) {
  const std::size_t total = index_.pairs.size();
  CSLAM_CHECK(total < std::numeric_limits<std::uint32_t>::max(), "{} frames", total);
  if (from_ >= total) {
    throw Error("'{}' has {} frames (0 to {}); there is nothing from frame {} on",
                index_.folder.string(), total, total - 1, from_);
  }
  count_ = std::min(options.frames.value_or(total), total - from_);
  if (count_ == 0) throw Error("'{}': 0 frames were asked for", index_.folder.string());
}

const TumPair& TumDataset::pair(std::size_t index) const {
  CSLAM_CHECK(index < count_, "frame {} of {}", index, count_);
  return index_.pairs[from_ + index];
}

Stamp TumDataset::stamp(std::size_t index) const {
  return pair(index).color_stamp;
}

LoadResult TumDataset::Load(std::size_t index) const {
  const FrameId id(static_cast<std::uint32_t>(from_ + index));
  LoadResult result = LoadTumPair(pair(index), id, camera_);
  if (!result.frame && is_strict_) {
    throw Error("frame {}: {} (without --strict it would be skipped)", id.value(), result.problem);
  }
  return result;
}

std::optional<fs::path> TumDataset::ground_truth() const {
  return index_.ground_truth ? index_.ground_truth : index_.ground_truth_camera;
}

}  // namespace cslam
