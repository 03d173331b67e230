// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "progress_bar.h"

#include "cslam/util/check.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace cslam {
namespace {

constexpr int kWidth = 30;  // characters of the bar
constexpr double kRedrawMs = 100.0;
constexpr char kClearToEndOfLine[] = "\x1b[K";

std::string Duration(double seconds) {
  if (seconds < 9.5) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

std::string TimeLeft(int done, int total, double elapsed_s, int already_done) {
  if (done == total) return "took " + Duration(elapsed_s);
  if (done <= already_done) return "";
  return Duration(elapsed_s * (total - done) / (done - already_done)) + " left";
}

}  // namespace

std::string ProgressText(int done, int total, double elapsed_s, int already_done) {
  CSLAM_CHECK(done >= 0 && done <= total && total > 0, "{} of {}", done, total);
  const auto filled = static_cast<std::size_t>(kWidth * static_cast<long>(done) / total);
  return fmt::format("[{}{}] {:3} %  {} of {}  {}", std::string(filled, '#'),
                     std::string(kWidth - filled, '.'), 100L * done / total, done, total,
                     TimeLeft(done, total, elapsed_s, already_done));
}

ProgressBar::ProgressBar(std::string label, int total, int already_done)
    : label_(std::move(label)),
      total_(total),
      already_done_(already_done),
      is_terminal_(isatty(STDERR_FILENO) != 0),
      last_tenth_(static_cast<int>(10L * already_done / total)) {
  if (is_terminal_) Redraw(already_done);
}

ProgressBar::~ProgressBar() {
  if (is_line_open_) std::fputc('\n', stderr);
}

void ProgressBar::Update(int done) {
  if (!is_terminal_) {
    PrintTenth(done);
  } else if (done == total_ || since_start_.ElapsedMs() >= last_redraw_ms_ + kRedrawMs) {
    Redraw(done);
  }
}

void ProgressBar::Redraw(int done) {
  last_redraw_ms_ = since_start_.ElapsedMs();
  fmt::print(stderr, "\r{} {}{}", label_,
             ProgressText(done, total_, 1e-3 * last_redraw_ms_, already_done_), kClearToEndOfLine);
  std::fflush(stderr);
  is_line_open_ = true;
}

void ProgressBar::PrintTenth(int done) {
  const int tenth = static_cast<int>(10L * done / total_);
  if (tenth == last_tenth_) return;
  last_tenth_ = tenth;
  fmt::print(stderr, "{} {} of {}, {}\n", label_, done, total_,
             TimeLeft(done, total_, 1e-3 * since_start_.ElapsedMs(), already_done_));
}

}  // namespace cslam
