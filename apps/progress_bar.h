// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/stopwatch.h"

#include <string>

namespace cslam {

// "[######....]  60 %  18 of 30  5 s left": what a progress bar shows.
// already_done: what was done before the time began, and took none of it.
std::string ProgressText(int done, int total, double elapsed_s, int already_done = 0);

// Tells on stderr how far a long work is: one line that rewrites itself on a terminal, a line for
// every tenth of the work elsewhere. For one thread at a time.
class ProgressBar {
 public:
  // total >= 1; label: what is being done, "rendering"; already_done: in an earlier run.
  ProgressBar(std::string label, int total, int already_done = 0);
  // Leaves the cursor at the start of a line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void Update(int done);

 private:
  void Redraw(int done);
  void PrintTenth(int done);

  std::string label_;
  int total_;
  int already_done_;
  bool is_terminal_;
  Stopwatch since_start_;
  double last_redraw_ms_ = 0.0;
  int last_tenth_ = 0;
  bool is_line_open_ = false;
};

}  // namespace cslam
