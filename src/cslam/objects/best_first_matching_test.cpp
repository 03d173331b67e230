// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/best_first_matching.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::ElementsAre;

TEST(MatchBestFirst, GivesEachTrackToItsBestDetection) {
  EXPECT_THAT(MatchBestFirst({{0.4, 0, TrackId(7)}, {0.9, 1, TrackId(7)}, {0.3, 1, TrackId(8)}}, 3),
              ElementsAre(std::nullopt, TrackId(7), std::nullopt))
      << "detection 1 is taken before track 8 is tried";
  EXPECT_THAT(MatchBestFirst({{0.4, 0, TrackId(7)}, {0.9, 1, TrackId(7)}, {0.3, 0, TrackId(8)}}, 2),
              ElementsAre(TrackId(8), TrackId(7)));
}

TEST(MatchBestFirst, GivesTiesToTheOlderTrack) {
  EXPECT_THAT(MatchBestFirst({{0.5, 0, TrackId(9)}, {0.5, 0, TrackId(2)}}, 1),
              ElementsAre(TrackId(2)));
}

}  // namespace
}  // namespace cslam
