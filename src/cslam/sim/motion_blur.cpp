// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/motion_blur.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr float kMinFlowPx = 0.34F;
constexpr float kMaxFlowPx = 24.0F;  // things right before the lens would smear over everything
constexpr float kTapSpacingPx = 1.0F;
constexpr float kInfinityM = 1e4F;  // where nothing is seen, only rotation counts

// Bilinear, borders repeated.
Eigen::Array3f ColorAt(const cv::Mat& bgr, float x, float y) {
  const float u = std::clamp(x, 0.0F, static_cast<float>(bgr.cols - 1));
  const float v = std::clamp(y, 0.0F, static_cast<float>(bgr.rows - 1));
  const int left = std::min(static_cast<int>(u), std::max(0, bgr.cols - 2));
  const int top = std::min(static_cast<int>(v), std::max(0, bgr.rows - 2));
  const int right = std::min(left + 1, bgr.cols - 1);
  const int bottom = std::min(top + 1, bgr.rows - 1);
  const float a = u - static_cast<float>(left);
  const float b = v - static_cast<float>(top);
  const auto at = [&](int row, int column) {
    const auto& p = bgr.ptr<cv::Vec3b>(row)[column];
    return Eigen::Array3f(p[0], p[1], p[2]);
  };
  return (1.0F - b) * ((1.0F - a) * at(top, left) + a * at(top, right)) +
         b * ((1.0F - a) * at(bottom, left) + a * at(bottom, right));
}

cv::Vec3b Smear(const cv::Mat& bgr, int u, int v, const Eigen::Vector2f& flow_px, float length_px) {
  const int taps = 1 + std::max(1, static_cast<int>(std::ceil(length_px / kTapSpacingPx)));
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (int i = 0; i < taps; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(taps - 1) - 0.5F;
    sum += ColorAt(bgr, static_cast<float>(u) + share * flow_px.x(),
                   static_cast<float>(v) + share * flow_px.y());
  }
  const Eigen::Array3f mean = sum / static_cast<float>(taps) + 0.5F;
  const auto byte = [](float value) { return static_cast<unsigned char>(value); };
  return {byte(mean[0]), byte(mean[1]), byte(mean[2])};
}

}  // namespace

cv::Mat FlowOf(const RenderedView& view, const Camera& camera, const ShutterMotion& motion) {
  cv::Mat flow_px(view.depth_m.size(), CV_32FC2);
  const Se3 T_last_first = motion.T_world_last.Inverse() * motion.T_world_first;
  const Eigen::Matrix3f R = T_last_first.R().cast<float>();
  const Eigen::Vector3f t = T_last_first.translation.cast<float>();
  const Eigen::Matrix3f R_last_world =
      motion.T_world_last.R().transpose().cast<float>() * static_cast<float>(motion.open_s);
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  for (int v = 0; v < flow_px.rows; ++v) {
    const auto* depths_m = view.depth_m.ptr<float>(v);
    auto* to = flow_px.ptr<cv::Vec2f>(v);
    for (int u = 0; u < flow_px.cols; ++u) {
      const float z = depths_m[u] > 0.0F ? depths_m[u] : kInfinityM;
      const float x = (static_cast<float>(u) - cx) / fx;
      const float y = (static_cast<float>(v) - cy) / fy;
      Eigen::Vector3f p = R * Eigen::Vector3f(x * z, y * z, z) + t;
      if (!view.velocity_m_s.empty()) {
        const auto& velocity = view.velocity_m_s.ptr<cv::Vec3f>(v)[u];
        p += R_last_world * Eigen::Vector3f(velocity[0], velocity[1], velocity[2]);
      }
      const bool is_ahead = p.z() > 0.01F;
      to[u] = is_ahead ? cv::Vec2f(fx * (p.x() / p.z() - x), fy * (p.y() / p.z() - y))
                       : cv::Vec2f(0.0F, 0.0F);
    }
  }
  return flow_px;
}

cv::Mat BlurMotion(const cv::Mat& bgr, const cv::Mat& flow_px) {
  CSLAM_CHECK(bgr.type() == CV_8UC3 && flow_px.type() == CV_32FC2 && bgr.size() == flow_px.size());
  cv::Mat blurred = bgr.clone();
  for (int v = 0; v < bgr.rows; ++v) {
    const auto* flows = flow_px.ptr<cv::Vec2f>(v);
    auto* to = blurred.ptr<cv::Vec3b>(v);
    for (int u = 0; u < bgr.cols; ++u) {
      Eigen::Vector2f flow(flows[u][0], flows[u][1]);
      const float length_px = flow.norm();
      if (length_px < kMinFlowPx) continue;
      if (length_px > kMaxFlowPx) flow *= kMaxFlowPx / length_px;
      to[u] = Smear(bgr, u, v, flow, std::min(length_px, kMaxFlowPx));
    }
  }
  return blurred;
}

}  // namespace cslam
