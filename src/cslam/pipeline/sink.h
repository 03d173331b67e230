// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/messages/loop_messages.h"
#include "cslam/messages/messages.h"
#include "cslam/pipeline/run_result.h"

namespace cslam {

// Something that listens: run writer, progress bar, viewer, a user's own code. SLAM does not know
// who listens and runs the same without. Calls come one at a time, from one thread at a time;
// frames and map updates each in order.
class OutputSink {
 public:
  virtual ~OutputSink() = default;
  virtual void OnFrame(const TrackingResult& /*result*/) {}
  virtual void OnLoop(const LoopRecord& /*record*/) {}
  virtual void OnMap(const MapUpdate& /*update*/) {}
  virtual void OnFinish(const RunResult& /*result*/) {}
};

}  // namespace cslam
