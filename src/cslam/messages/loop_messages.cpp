// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/messages/loop_messages.h"

namespace cslam {

const char* ToString(LoopVerdict verdict) {
  switch (verdict) {
    case LoopVerdict::kRefused:
      return "refused";
    case LoopVerdict::kPending:
      return "pending";
    case LoopVerdict::kClosed:
      return "closed";
    case LoopVerdict::kMerged:
      return "merged";
  }
  return "";
}

}  // namespace cslam
