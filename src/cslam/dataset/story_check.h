// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/check_frames.h"
#include "cslam/dataset/story.h"
#include "cslam/dataset/truth_check.h"
#include "cslam/io/truth_files.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

struct StoryCheckOptions {
  // Share of the picture that must show an object for it to be in view: 150 px of 640x480.
  double min_visible_share = 0.0005;
  // Images opened per question, evenly spread over the frames that may answer it.
  std::size_t max_images = 60;
  DepthTolerance tolerance = {};  // of depth, for looking through where something was
  PeopleClaim people = {};
  // Whether the frames go to the story's end. If not, what is missing after a change, and the
  // people's claim, are no errors.
  bool is_whole = true;
};

// A change, and when the camera saw what.
struct ChangeEvidence {
  TrueChange change;
  // Frames before the change in which the object (for kAdded: its future place, empty) is seen.
  std::size_t num_views_before = 0;
  // Frames after it in which the object (for kReplaced: the new one; for kRemoved: its old place,
  // empty) is seen. At most max_images where images had to be opened.
  std::size_t num_views_after = 0;
  std::optional<double> last_view_before_s;  // time since the sequence's start
  std::optional<double> first_view_after_s;
  // Whether a pixel of what changes is seen in a frame next to the change.
  bool is_in_view_when_it_happens = false;
  std::string problem;  // why the change does not make a story; empty if it does
};

// How much of the picture people fill; shares are 0 to 1.
struct PeopleFigures {
  double mean_share = 0.0;
  double peak_share = 0.0;
  bool leave_view = false;  // somebody was seen, and nobody later
};

struct StoryEvidence {
  std::vector<ChangeEvidence> changes;  // in the order of changes.json
  std::optional<PeopleFigures> people;  // absent without detections.json
  Findings errors;                      // claims not kept
  Findings warnings;
};

// Proves of each change that the object was in view before it and is in view after it (of one
// removed: that its place is in view, empty, taken by something else, or where a new object came
// to stand at that time), and that it happens out of view. A change said to be carried in view may
// be seen instead. Measures the people, too. Needs objects and changes; detections spare it opening
// most instance images.
StoryEvidence CheckStory(const CheckFrames& frames, const SequenceTruth& truth,
                         const StoryCheckOptions& options);

}  // namespace cslam
