// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/frames_csv.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

constexpr const char* kFixedColumns =
    "frame,timestamp_s,state,reason,map,keypoints,matches,inliers,keyframe,reference_keyframe,"
    "map_revision,total_ms";

TEST(FormatFramesCsv, WritesOneLineAFrameWithAColumnForEachStage) {
  TrackingResult first;
  first.frame = FrameId(7);
  first.stamp = Stamp{1'500'000'000};
  first.reason = "12 keypoints with depth < 100";
  first.num_keypoints = 12;
  first.keyframe_reason = KeyframeReason::kNotTracking;
  first.times = {{"extract", 2.0, 1.0}};
  TrackingResult second;
  second.frame = FrameId(8);
  second.stamp = Stamp{1'600'000'000};
  second.state = TrackingState::kTracking;
  second.reason = "90 inliers";
  second.map = MapId(0);
  second.reference = KeyframeId(3);
  second.num_keypoints = 400;
  second.num_map_matches = 100;
  second.num_inliers = 90;
  second.keyframe_reason = KeyframeReason::kNotNeeded;
  second.map_revision = 5;
  second.times = {{"extract", 2.0, 1.0}, {"predict", 0.5, 0.5}};
  EXPECT_EQ(FormatFramesCsv({first, second}),
            std::string(kFixedColumns) +
                ",extract_ms,predict_ms\n"
                "7,1.500000,initialising,12 keypoints with depth < 100,,12,0,0,not_tracking,,0,"
                "2.000,2.000,\n"
                "8,1.600000,tracking,90 inliers,0,400,100,90,not_needed,3,5,2.500,2.000,0.500\n");
}

TEST(FormatFramesCsv, QuotesReasonsThatHoldCommasOrQuotes) {
  TrackingResult frame;
  frame.frame = FrameId(0);
  frame.reason = "lost, \"badly\"";
  EXPECT_NE(FormatFramesCsv({frame}).find(",\"lost, \"\"badly\"\"\","), std::string::npos);
}

TEST(FormatFramesCsv, IsTheTitleLineWhenThereAreNoFrames) {
  EXPECT_EQ(FormatFramesCsv({}), std::string(kFixedColumns) + "\n");
}

}  // namespace
}  // namespace cslam
