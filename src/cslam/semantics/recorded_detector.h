// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/truth_files.h"
#include "cslam/semantics/detector.h"
#include "cslam/semantics/detector_options.h"

#include <deque>
#include <string>

namespace cslam {

// Gives back detections that were written down, degraded as the options say. What happens to a
// frame's boxes depends on the seed and the frame's stamp only.
class RecordedDetector final : public Detector {
 public:
  // source: the file it came from, for messages.
  RecordedDetector(DetectionRecord record, std::string source, const DegradeOptions& degrade);

  // Throws Error if the record has no entry for the frame's stamp, or is for images of another
  // size. With a delay, the first calls belong to their own frame and hold nothing.
  Detections Detect(const RgbdFrame& frame) override;
  DetectorInfo info() const override;

 private:
  struct Seen {
    FrameId frame;
    Stamp stamp;
  };

  const RecordedFrame& EntryOf(Stamp stamp) const;
  void CheckSize(const RgbdFrame& frame) const;

  DetectionRecord record_;
  std::string source_;
  DegradeOptions degrade_;
  std::deque<Seen> waiting_;  // frames whose detections are still to come, oldest first
};

// The boxes of one recorded frame as a worse detector would give them, best score first.
// record: for the image size and the classes that false boxes may have.
std::vector<Detection> Degrade(const RecordedFrame& frame, const DetectionRecord& record,
                               const DegradeOptions& options);

}  // namespace cslam
