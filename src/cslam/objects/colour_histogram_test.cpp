// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/colour_histogram.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <numeric>

namespace cslam {
namespace {

// The left half of a thumbnail of 160 x 120.
DepthRegion LeftHalf() {
  DepthRegion region;
  region.mask = cv::Mat::zeros(120, 160, CV_8UC1);
  region.mask.colRange(0, 80).setTo(255);
  region.num_pixels = 80 * 120;
  return region;
}

// Full-size, one colour on either side.
cv::Mat Halves(const cv::Scalar& left, const cv::Scalar& right) {
  cv::Mat bgr(480, 640, CV_8UC3, right);
  bgr.colRange(0, 320).setTo(left);
  return bgr;
}

const cv::Scalar kRed(20, 20, 200);
const cv::Scalar kBlue(200, 20, 20);
const cv::Scalar kGrey(120, 120, 120);

TEST(ColoursOf, LooksInsideTheRegionOnly) {
  const ColourHistogram before_blue = ColoursOf(Halves(kRed, kBlue), LeftHalf());
  const ColourHistogram before_grey = ColoursOf(Halves(kRed, kGrey), LeftHalf());
  EXPECT_EQ(before_blue, before_grey);
  EXPECT_NEAR(std::accumulate(before_blue.begin(), before_blue.end(), 0.0F), 3.0F, 1e-4F);
}

TEST(ColoursOf, IsEmptyWithoutColoursOrRegion) {
  EXPECT_EQ(ColoursOf({}, LeftHalf()), ColourHistogram{});
  EXPECT_EQ(ColoursOf(Halves(kRed, kBlue), DepthRegion{}), ColourHistogram{});
}

TEST(ColoursOf, GivesGreyThingsNoHue) {
  const ColourHistogram grey = ColoursOf(Halves(kGrey, kRed), LeftHalf());
  EXPECT_NEAR(std::accumulate(grey.begin(), grey.begin() + 8, 0.0F), 0.0F, 1e-6F);
  EXPECT_NEAR(std::accumulate(grey.begin(), grey.end(), 0.0F), 2.0F, 1e-4F);
}

TEST(ColourLikeness, TellsColoursApartAndIsSymmetric) {
  const ColourHistogram red = ColoursOf(Halves(kRed, kGrey), LeftHalf());
  const ColourHistogram blue = ColoursOf(Halves(kBlue, kGrey), LeftHalf());
  const ColourHistogram grey = ColoursOf(Halves(kGrey, kRed), LeftHalf());
  EXPECT_NEAR(ColourLikeness(red, red), 1.0, 1e-6);
  EXPECT_LT(ColourLikeness(red, blue), 0.7) << "what the map asks for by default";
  EXPECT_LT(ColourLikeness(red, grey), 0.5);
  EXPECT_DOUBLE_EQ(ColourLikeness(red, blue), ColourLikeness(blue, red));
}

TEST(ColourLikeness, IsUndecidedWithoutColours) {
  const ColourHistogram red = ColoursOf(Halves(kRed, kGrey), LeftHalf());
  EXPECT_DOUBLE_EQ(ColourLikeness(red, {}), 0.5);
  EXPECT_DOUBLE_EQ(ColourLikeness({}, {}), 0.5);
}

TEST(PixelsOfColours, FindsThoseOfTheThing) {
  const ColourHistogram red = ColoursOf(Halves(kRed, kGrey), LeftHalf());
  const cv::Mat found = PixelsOfColours(Halves(kBlue, kRed), red, 0.15F);
  EXPECT_EQ(cv::countNonZero(found.colRange(0, 320)), 0);
  EXPECT_EQ(cv::countNonZero(found.colRange(320, 640)), 320 * 480);
  EXPECT_EQ(cv::countNonZero(PixelsOfColours(Halves(kGrey, kBlue), red, 0.15F)), 0);
}

TEST(PixelsOfColours, LeavesOutWhatIsRareInTheThing) {
  cv::Mat picture = Halves(kRed, kGrey);
  picture.colRange(0, 32).setTo(kBlue);  // a tenth of the region
  const ColourHistogram colours = ColoursOf(picture, LeftHalf());
  const cv::Mat blue = Halves(kBlue, kBlue);
  EXPECT_EQ(cv::countNonZero(PixelsOfColours(blue, colours, 0.15F)), 0);
  EXPECT_EQ(cv::countNonZero(PixelsOfColours(blue, colours, 0.05F)), 640 * 480);
}

}  // namespace
}  // namespace cslam
