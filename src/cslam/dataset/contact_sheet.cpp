// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/contact_sheet.h"

#include "cslam/dataset/change_text.h"
#include "cslam/io/image_codec.h"
#include "cslam/util/check.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace cslam {
namespace {

constexpr int kColumns = 4;
constexpr std::size_t kMaxThumbs = 12;
constexpr int kThumbWidth = 320;  // px, like all below
constexpr int kMargin = 8;
constexpr int kLineHeight = 18;
constexpr std::size_t kMaxChangeLines = 2;  // below each picture
constexpr double kFontScale = 0.45;
constexpr std::size_t kLineLength = 40;  // characters that fit into the width

const cv::Scalar kPaper(255, 255, 255);
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kChangeInk(20, 60, 200);  // red

std::vector<std::size_t> ChooseFrames(std::size_t num_frames) {
  const std::size_t count = std::min(num_frames, kMaxThumbs);
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < count; ++k)
    chosen.push_back(count == 1 ? 0 : (k * (num_frames - 1) + (count - 1) / 2) / (count - 1));
  return chosen;
}

// What changed in (after_s, until_s], as lines that fit; the last tells how many do not.
std::vector<std::string> ChangeLines(double after_s, double until_s, const TrueObjects& objects,
                                     const TrueChanges& changes) {
  std::vector<std::string> lines;
  for (const TrueChange& change : changes.changes) {
    if (change.time_s <= after_s || change.time_s > until_s) continue;
    const std::string text = Describe(change, objects);
    const bool fits = !lines.empty() && lines.back().size() + 2 + text.size() <= kLineLength;
    if (fits) {
      lines.back() += ", " + text;
    } else {
      lines.push_back(text.substr(0, kLineLength));
    }
  }
  if (lines.size() > kMaxChangeLines) {
    lines.resize(kMaxChangeLines);
    lines.back() = lines.back().substr(0, kLineLength - 4) + " ...";
  }
  return lines;
}

void Write(const cv::Mat& sheet, const std::string& text, cv::Point at, const cv::Scalar& ink) {
  cv::putText(sheet, text, at, cv::FONT_HERSHEY_SIMPLEX, kFontScale, ink, 1, cv::LINE_AA);
}

struct Caption {
  std::string time;
  std::vector<std::string> changes;
};

std::vector<Caption> MakeCaptions(std::span<const SheetFrame> frames,
                                  const std::vector<std::size_t>& chosen,
                                  const TrueObjects& objects, const TrueChanges& changes) {
  std::vector<Caption> captions;
  double last_s = -1.0;
  for (const std::size_t i : chosen) {
    const double time_s = frames[i].time_s;
    captions.push_back(
        {fmt::format("{:.1f} s", time_s), ChangeLines(last_s, time_s, objects, changes)});
    last_s = time_s;
  }
  return captions;
}

// cell: the part of the sheet that belongs to one picture; the captions go below the picture.
void DrawCell(const cv::Mat& cell, const cv::Mat& image, int picture_height,
              const Caption& caption) {
  cv::Mat thumb;
  const cv::Size size(kThumbWidth, picture_height);
  cv::resize(image, thumb, size, 0, 0,
             image.cols > size.width ? cv::INTER_AREA : cv::INTER_NEAREST);
  thumb.copyTo(cell(cv::Rect({0, 0}, size)));
  constexpr int kBaseline = 13;  // below the top of a line
  cv::Point at(2, picture_height + kBaseline);
  Write(cell, caption.time, at, kInk);
  for (const std::string& line : caption.changes) {
    at.y += kLineHeight;
    Write(cell, line, at, kChangeInk);
  }
}

}  // namespace

cv::Mat MakeContactSheet(std::span<const SheetFrame> frames, const TrueObjects& objects,
                         const TrueChanges& changes) {
  CSLAM_CHECK(!frames.empty(), "a contact sheet of nothing");
  const std::vector<std::size_t> chosen = ChooseFrames(frames.size());
  const std::vector<Caption> captions = MakeCaptions(frames, chosen, objects, changes);
  std::size_t num_lines = 1;
  for (const Caption& caption : captions)
    num_lines = std::max(num_lines, 1 + caption.changes.size());
  const int count = static_cast<int>(chosen.size());
  const int columns = std::min(count, kColumns);
  const int rows = (count + kColumns - 1) / kColumns;
  cv::Mat sheet;
  for (int k = 0; k < count; ++k) {
    const auto index = static_cast<std::size_t>(k);
    const cv::Mat image = ReadColorImage(frames[chosen[index]].image);
    const int picture_height = std::max(1, image.rows * kThumbWidth / image.cols);
    const int height = picture_height + static_cast<int>(num_lines) * kLineHeight;
    if (sheet.empty()) {
      sheet = cv::Mat(kMargin + rows * (height + kMargin),
                      kMargin + columns * (kThumbWidth + kMargin), CV_8UC3, kPaper);
    }
    const cv::Rect place(kMargin + (k % kColumns) * (kThumbWidth + kMargin),
                         kMargin + (k / kColumns) * (height + kMargin), kThumbWidth, height);
    DrawCell(sheet(place), image, picture_height, captions[index]);
  }
  return sheet;
}

}  // namespace cslam
