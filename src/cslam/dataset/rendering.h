// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/render_record.h"
#include "cslam/dataset/story.h"
#include "cslam/sim/simulated_sequence.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

// The demo tour, whose entry has no `make`, and AllSequences().
std::vector<SequenceEntry> RenderableSequences();

struct RenderRequest {
  std::uint64_t seed = 1;
  int width = 640;                   // px
  int height = 480;                  // px
  double fps = 30.0;                 // the story is resampled
  int num_frames = 0;                // 0: the whole story; otherwise at most so many
  std::optional<SensorNoise> noise;  // none: that of the sequence's own sensor
  bool is_short = false;
  bool without_people = false;       // what they carry moves all the same
  std::vector<std::string> without;  // names of objects that are left out as well
};

// How many frames the whole story has, and how many of them are wanted.
int CountStoryFrames(const SequenceEntry& entry, const RenderRequest& request);
int CountFrames(const SequenceEntry& entry, const RenderRequest& request);
SensorNoise NoiseOf(const SequenceEntry& entry, const RenderRequest& request);

struct Rendering {
  SimulatedSequence sequence;
  RenderRecord record;  // without program and command
};

// Makes the story's world and camera; deterministic. The demo needs no stage but takes any. Throws
// Error where there is no object of a name that is to be left out.
Rendering MakeRendering(const SequenceEntry& entry, const RenderRequest& request,
                        const Stage& stage);

// The command line that renders it again, into "DIR".
std::string CommandOf(const RenderRecord& record);

// Bytes on disk before anything is rendered. Only rough, since what there is to see and the look
// matter: within a factor of two.
double RoughBytes(const SequenceEntry& entry, const RenderRequest& request);

}  // namespace cslam
