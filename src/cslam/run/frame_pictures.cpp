// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/frame_pictures.h"

#include "cslam/io/image_codec.h"
#include "cslam/semantics/coco.h"
#include "cslam/util/check.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <string>
#include <system_error>
#include <utility>

namespace cslam {
namespace {

constexpr int kRadiusPx = 3;
constexpr double kFontScale = 0.45;
constexpr int kPngCompression = 3;
const cv::Scalar kGreen(60, 200, 60);
const cv::Scalar kYellow(0, 215, 255);
const cv::Scalar kRed(40, 40, 230);
const cv::Scalar kWhite(255, 255, 255);
const cv::Scalar kBlack(0, 0, 0);

cv::Scalar ColourOf(KeypointLabel label) {
  switch (label) {
    case KeypointLabel::kStatic:
      return kGreen;
    case KeypointLabel::kMovable:
      return kYellow;
    case KeypointLabel::kDynamic:
      return kRed;
  }
  return kWhite;
}

void Write(cv::Mat& picture, const std::string& text, const cv::Point& at) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, kFontScale, kBlack, 3, cv::LINE_AA);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, kFontScale, kWhite, 1, cv::LINE_AA);
}

std::string TitleOf(const TrackedObject& object) {
  const std::string name =
      object.class_id < 0 ? "mover" : std::string(CocoClassName(object.class_id));
  return fmt::format("{} {} {} {:.1f} m/s", name, object.track.value(), ToString(object.motion),
                     object.velocity_mps.norm());
}

void DrawObject(cv::Mat& picture, const TrackedObject& object) {
  const cv::Rect box(static_cast<int>(object.box.x_min), static_cast<int>(object.box.y_min),
                     static_cast<int>(object.box.width()), static_cast<int>(object.box.height()));
  // Carried on without a detection of this very frame: a thin frame.
  cv::rectangle(picture, box, ColourOf(object.label), object.is_detected ? 2 : 1);
  Write(picture, TitleOf(object), {box.x + 3, std::max(12, box.y + 14)});
}

}  // namespace

cv::Mat DrawFrame(const cv::Mat& bgr, const TrackingResult& result) {
  cv::Mat picture = bgr.clone();
  for (const LabelledKeypoint& keypoint : result.keypoints) {
    const cv::Point at(static_cast<int>(keypoint.raw_px.x()),
                       static_cast<int>(keypoint.raw_px.y()));
    cv::circle(picture, at, kRadiusPx, ColourOf(keypoint.label), 1, cv::LINE_AA);
  }
  for (const TrackedObject& object : result.objects)
    DrawObject(picture, object);
  Write(picture,
        fmt::format("frame {}  {}  {} keypoints, {} dynamic", result.frame.value(), result.reason,
                    result.num_keypoints, result.num_dynamic_keypoints),
        {6, picture.rows - 8});
  return picture;
}

FramePictures::FramePictures(const DatasetReader& dataset, std::filesystem::path folder,
                             std::size_t first_frame, std::size_t stride)
    : dataset_(dataset), folder_(std::move(folder)), first_frame_(first_frame), stride_(stride) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw Error("cannot create '{}': {}", folder_.string(), error.message());
}

void FramePictures::OnFrame(const TrackingResult& result) {
  const std::size_t index = result.frame.value() - first_frame_;
  if (index % stride_ != 0) return;
  const LoadResult loaded = dataset_.Load(index);
  if (!loaded.frame) return;
  WritePng(folder_ / fmt::format("{:06}.png", result.frame.value()),
           DrawFrame(loaded.frame->bgr, result), kPngCompression);
}

}  // namespace cslam
