// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/image_codec.h"

#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <png.h>
#include <turbojpeg.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

cv::Mat RandomImage(int rows, int cols, int type) {
  cv::Mat image(rows, cols, type);
  cv::RNG rng(7);
  rng.fill(image, cv::RNG::UNIFORM, 0, image.depth() == CV_16U ? 65536 : 256);
  return image;
}

bool Same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

// Writes pixels with libpng's simplified interface, which knows alpha and palettes.
void WriteWithLibpng(const std::filesystem::path& path, png_uint_32 format, int width, int height,
                     const std::vector<std::uint8_t>& pixels,
                     const std::vector<std::uint8_t>& colormap = {}) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  image.colormap_entries = static_cast<png_uint_32>(colormap.size() / 3);
  ASSERT_NE(png_image_write_to_file(&image, path.c_str(), 0, pixels.data(), 0,
                                    colormap.empty() ? nullptr : colormap.data()),
            0)
      << image.message;
}

std::string EncodeJpeg(const cv::Mat& bgr, int quality) {
  tjhandle handle = tjInitCompress();
  unsigned char* bytes = nullptr;
  std::size_t size = 0;
  tjCompress2(handle, bgr.data, bgr.cols, static_cast<int>(bgr.step[0]), bgr.rows, TJPF_BGR, &bytes,
              &size, TJSAMP_444, quality, 0);
  std::string result(reinterpret_cast<const char*>(bytes), size);
  tjFree(bytes);
  tjDestroy(handle);
  return result;
}

TEST(WritePng, RoundTripsColour) {
  const TestFolder folder;
  const cv::Mat image = RandomImage(13, 7, CV_8UC3);
  WritePng(folder / "a.png", image);
  EXPECT_TRUE(Same(ReadColorImage(folder / "a.png"), image));
}

TEST(WritePng, RoundTripsSixteenBitDepthAtEveryCompression) {
  const TestFolder folder;
  const cv::Mat depth = RandomImage(9, 11, CV_16UC1);
  for (int level = 0; level <= 9; ++level) {
    WritePng(folder / "d.png", depth, level);
    EXPECT_TRUE(Same(ReadDepthImage(folder / "d.png"), depth)) << "level " << level;
  }
}

TEST(WritePng, WritesAViewIntoALargerImage) {
  const TestFolder folder;
  const cv::Mat image = RandomImage(20, 20, CV_16UC1);
  const cv::Mat view = image(cv::Rect(3, 4, 5, 6));
  WritePng(folder / "d.png", view);
  EXPECT_TRUE(Same(ReadDepthImage(folder / "d.png"), view));
}

TEST(WritePng, GivesTheSameBytesEveryTime) {
  const TestFolder folder;
  const cv::Mat image = RandomImage(30, 40, CV_8UC3);
  WritePng(folder / "a.png", image);
  WritePng(folder / "b.png", image);
  EXPECT_EQ(TestFolder::Read(folder / "a.png"), TestFolder::Read(folder / "b.png"));
}

TEST(WritePng, StoresDepthBigEndianAsThePngStandardSays) {
  const TestFolder folder;
  cv::Mat depth(1, 1, CV_16UC1, cv::Scalar(0x1234));
  WritePng(folder / "d.png", depth, 0);
  EXPECT_NE(TestFolder::Read(folder / "d.png").find("\x12\x34"), std::string::npos);
}

TEST(WritePng, NamesThePathWhenItsFolderIsMissing) {
  const TestFolder folder;
  EXPECT_THAT(MessageOf([&] { WritePng(folder / "no/a.png", RandomImage(2, 2, CV_8UC1)); }),
              HasSubstr("no/a.png"));
}

TEST(WritePng, RefusesTypesPngHasNot) {
  const TestFolder folder;
  EXPECT_THROW(WritePng(folder / "a.png", cv::Mat(2, 2, CV_32FC1)), InternalError);
}

TEST(ReadColorImage, SpreadsGreyOverThreeChannels) {
  const TestFolder folder;
  cv::Mat gray = RandomImage(5, 6, CV_8UC1);
  WritePng(folder / "g.png", gray);
  cv::Mat expected;
  cv::merge(std::vector<cv::Mat>{gray, gray, gray}, expected);
  EXPECT_TRUE(Same(ReadColorImage(folder / "g.png"), expected));
}

TEST(ReadColorImage, DropsAlphaAndOrdersChannelsAsBgr) {
  const TestFolder folder;
  WriteWithLibpng(folder / "a.png", PNG_FORMAT_RGBA, 1, 1, {10, 20, 30, 40});
  EXPECT_EQ(ReadColorImage(folder / "a.png").at<cv::Vec3b>(0, 0), cv::Vec3b(30, 20, 10));
}

TEST(ReadColorImage, ResolvesPalettes) {
  const TestFolder folder;
  WriteWithLibpng(folder / "p.png", PNG_FORMAT_RGB_COLORMAP, 2, 1, {1, 0}, {1, 2, 3, 40, 50, 60});
  const cv::Mat image = ReadColorImage(folder / "p.png");
  ASSERT_EQ(image.size(), cv::Size(2, 1));
  EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(60, 50, 40));
  EXPECT_EQ(image.at<cv::Vec3b>(0, 1), cv::Vec3b(3, 2, 1));
}

TEST(ReadColorImage, DecodesJpegToBgr) {
  const TestFolder folder;
  const cv::Mat blue(16, 24, CV_8UC3, cv::Scalar(200, 30, 20));
  folder.Write("a.jpg", EncodeJpeg(blue, 100));
  const cv::Mat image = ReadColorImage(folder / "a.jpg");
  ASSERT_EQ(image.size(), blue.size());
  EXPECT_LE(cv::norm(image, blue, cv::NORM_INF), 3.0);
}

TEST(ReadColorImage, KnowsTheTypeByContentNotByName) {
  const TestFolder folder;
  WritePng(folder / "a.jpg", RandomImage(4, 4, CV_8UC3));
  EXPECT_EQ(ReadColorImage(folder / "a.jpg").size(), cv::Size(4, 4));
}

TEST(ReadColorImage, RefusesTruncatedFilesAtEveryLength) {
  const TestFolder folder;
  WritePng(folder / "a.png", RandomImage(8, 8, CV_8UC3));
  for (const std::string& whole :
       {TestFolder::Read(folder / "a.png"), EncodeJpeg(RandomImage(32, 32, CV_8UC3), 80)}) {
    for (std::size_t length = 0; length < whole.size() - 2; length += 7) {
      const auto file = folder.Write("cut", whole.substr(0, length));
      EXPECT_THAT(MessageOf([&] { ReadColorImage(file); }), HasSubstr(file.string()))
          << length << " of " << whole.size() << " bytes";
    }
  }
}

TEST(ReadColorImage, RefusesFlippedBytes) {
  const TestFolder folder;
  WritePng(folder / "a.png", RandomImage(8, 8, CV_8UC3));
  std::string bytes = TestFolder::Read(folder / "a.png");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  folder.Write("a.png", bytes);
  EXPECT_THAT(MessageOf([&] { ReadColorImage(folder / "a.png"); }),
              HasSubstr("cannot decode PNG image"));
}

TEST(ReadColorImage, SaysWhatIsWrong) {
  const TestFolder folder;
  EXPECT_THAT(MessageOf([&] { ReadColorImage(folder / "none.png"); }),
              AllOf(HasSubstr("none.png"), HasSubstr("No such file")));
  EXPECT_THAT(MessageOf([&] { ReadColorImage(folder.path()); }), HasSubstr("Is a directory"));
  folder.Write("empty.png", "");
  EXPECT_THAT(MessageOf([&] { ReadColorImage(folder / "empty.png"); }), HasSubstr("0 bytes"));
  folder.Write("text.png", "hello, world");
  EXPECT_THAT(MessageOf([&] { ReadColorImage(folder / "text.png"); }),
              HasSubstr("neither PNG nor JPEG"));
  WritePng(folder / "depth.png", RandomImage(4, 4, CV_16UC1));
  EXPECT_THAT(MessageOf([&] { ReadColorImage(folder / "depth.png"); }),
              HasSubstr("16 bits per channel"));
}

TEST(ReadDepthImage, RefusesEveryOtherType) {
  const TestFolder folder;
  WritePng(folder / "8.png", RandomImage(4, 4, CV_8UC1));
  EXPECT_THAT(MessageOf([&] { ReadDepthImage(folder / "8.png"); }),
              AllOf(HasSubstr("8-bit"), HasSubstr("expected 16-bit with 1 channel")));
  WritePng(folder / "rgb.png", RandomImage(4, 4, CV_8UC3));
  EXPECT_THAT(MessageOf([&] { ReadDepthImage(folder / "rgb.png"); }), HasSubstr("3 channel"));
  folder.Write("a.jpg", EncodeJpeg(RandomImage(16, 16, CV_8UC3), 80));
  EXPECT_THAT(MessageOf([&] { ReadDepthImage(folder / "a.jpg"); }), HasSubstr("is a JPEG"));
}

}  // namespace
}  // namespace cslam
