// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/image_codec.h"
#include "cslam/util/test_folder.h"

#include <fmt/core.h>
#include <opencv2/core.hpp>

#include <filesystem>
#include <string>

namespace cslam {

// For tests: a sound sequence of tiny images at 20 Hz in TUM layout, to be spoilt by the test.
// Frame i has stamp i / 20 s, blue 10 * i, and depth 1500 + i mm everywhere.
class TestSequence {
 public:
  static constexpr int kWidth = 64;   // px
  static constexpr int kHeight = 48;  // px

  explicit TestSequence(int num_frames) {
    std::filesystem::create_directories(folder_ / "rgb");
    std::filesystem::create_directories(folder_ / "depth");
    std::string associations;
    for (int i = 0; i < num_frames; ++i) {
      WriteColor(i, kWidth, kHeight);
      WriteDepth(i, kWidth, kHeight, 1500 + i);
      const double time_s = i / 20.0;
      associations +=
          fmt::format("{:.3f} rgb/{}.png {:.3f} depth/{}.png\n", time_s, i, time_s + 0.004, i);
    }
    folder_.Write("associations.txt", associations);
    folder_.Write("camera.yaml",
                  fmt::format("width: {}\nheight: {}\nfx: 50\nfy: 50\ncx: 32\ncy: 24\n"
                              "depth_scale: 1000\n",
                              kWidth, kHeight));
  }

  const TestFolder& folder() const { return folder_; }
  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path Color(int i) const { return folder_ / fmt::format("rgb/{}.png", i); }
  std::filesystem::path Depth(int i) const { return folder_ / fmt::format("depth/{}.png", i); }

  void WriteColor(int i, int width, int height) const {
    WritePng(Color(i), cv::Mat(height, width, CV_8UC3, cv::Scalar(10 * i, 20, 30)));
  }
  void WriteDepth(int i, int width, int height, int value) const {
    WritePng(Depth(i), cv::Mat(height, width, CV_16UC1, cv::Scalar(value)));
  }

 private:
  TestFolder folder_;
};

}  // namespace cslam
