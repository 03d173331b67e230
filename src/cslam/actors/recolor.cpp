// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/recolor.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace cslam {
namespace {

constexpr double kBlack = 12.0;             // grey level; unused texels are darker
constexpr double kPrint = 0.95;             // of the mean; darker texels of a shirt are print
constexpr int kClothSide_px = 1024;         // a texel of cloth is then about a millimetre
constexpr double kShirtTexelsPerM = 950.0;  // the front, 0.62 m high, is 0.57 of the texture

cv::Mat Smaller(const cv::Mat& image, int side_px) {
  if (image.cols <= side_px) return image;
  cv::Mat small;
  cv::resize(image, small, {side_px, side_px}, 0.0, 0.0, cv::INTER_AREA);
  return small;
}

double Gray(const cv::Vec3b& color) {
  return (color[0] + 2.0 * color[1] + color[2]) / 4.0;
}

cv::Scalar MeanOfUsed(const cv::Mat& image) {
  cv::Scalar sum;
  double count = 0.0;
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const cv::Vec3b& color = image.at<cv::Vec3b>(v, u);
      if (Gray(color) < kBlack) continue;
      for (int c = 0; c < 3; ++c)
        sum[c] += color[c];
      ++count;
    }
  }
  return sum * (1.0 / std::max(1.0, count));
}

double GrayOf(const cv::Scalar& color) {
  return (color[0] + 2.0 * color[1] + color[2]) / 4.0;
}

// A colour times the photograph's light and shade; unused texels get the plain colour, so that no
// black comes in at the seams; nothing gets brighter than `brightest` times the colour.
cv::Mat Dyed(const cv::Mat& image, const cv::Scalar& color, double brightest) {
  const double mean = std::max(1.0, GrayOf(MeanOfUsed(image)));
  cv::Mat result(image.size(), CV_8UC3);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const double gray = Gray(image.at<cv::Vec3b>(v, u));
      const double shade = gray < kBlack ? 1.0 : std::min(gray / mean, brightest);
      for (int c = 0; c < 3; ++c)
        result.at<cv::Vec3b>(v, u)[c] = cv::saturate_cast<unsigned char>(shade * color[c]);
    }
  }
  return result;
}

}  // namespace

cv::Mat RecolorSkin(const cv::Mat& skin, const PersonLook& look) {
  const cv::Scalar mean = MeanOfUsed(skin);
  cv::Mat result(skin.size(), CV_8UC3);
  for (int v = 0; v < skin.rows; ++v) {
    for (int u = 0; u < skin.cols; ++u) {
      const cv::Vec3b& from = skin.at<cv::Vec3b>(v, u);
      cv::Vec3b& to = result.at<cv::Vec3b>(v, u);
      for (int c = 0; c < 3; ++c) {
        const double factor = std::clamp(look.skin[c] / std::max(1.0, mean[c]), 0.3, 1.6);
        to[c] = cv::saturate_cast<unsigned char>(factor * from[c]);
      }
    }
  }
  return result;
}

cv::Mat RecolorHair(const cv::Mat& hair, const PersonLook& look) {
  return Dyed(Smaller(hair, kClothSide_px), look.hair, 1.4);
}

cv::Mat RecolorShoes(const cv::Mat& shoes, const PersonLook& look) {
  return Dyed(Smaller(shoes, kClothSide_px / 2), look.shoes, 1.8);
}

cv::Mat RecolorTrousers(const cv::Mat& jeans, const PersonLook& look) {
  return Dyed(Smaller(jeans, kClothSide_px), look.trousers, 1.8);
}

cv::Mat RecolorShirt(const cv::Mat& shirt, const PersonLook& look) {
  const cv::Mat folds = Smaller(shirt, kClothSide_px);
  cv::Mat cloth = PaintShirt(look, folds.size(), kShirtTexelsPerM);
  const double mean = std::max(1.0, GrayOf(MeanOfUsed(folds)));
  for (int v = 0; v < cloth.rows; ++v) {
    for (int u = 0; u < cloth.cols; ++u) {
      const double gray = Gray(folds.at<cv::Vec3b>(v, u));
      const double shade = gray < kPrint * mean ? 1.0 : std::min(gray / mean, 1.1);
      for (int c = 0; c < 3; ++c) {
        unsigned char& level = cloth.at<cv::Vec3b>(v, u)[c];
        level = cv::saturate_cast<unsigned char>(shade * level);
      }
    }
  }
  return cloth;
}

}  // namespace cslam
