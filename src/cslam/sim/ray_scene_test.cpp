// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/ray_scene.h"

#include "cslam/sim/test_scene.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

TEST(RayScene, FindsTheNearestObjectOfEveryRay) {
  const RayScene rays(MakeTestScene());
  // Seven rays: more than one packet, and not a whole number of them.
  const std::vector<Eigen::Vector3f> directions{
      {0.0F, 1.0F, 0.0F},  {2.0F, 1.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, {0.1F, 1.8F, 0.1F},
      {-1.0F, 1.0F, 0.0F}, {0.0F, 1.0F, 2.0F}, {0.0F, 1.0F, 0.05F}};
  const std::vector<RayHit> hits = rays.Cast({0.0F, 0.0F, 1.0F}, directions);
  ASSERT_EQ(hits.size(), directions.size());
  EXPECT_EQ(hits[0].object, 1U);
  EXPECT_EQ(hits[1].object, RayHit::kNone);  // passes beside the wall's end
  EXPECT_EQ(hits[2].object, RayHit::kNone);
  EXPECT_EQ(hits[3].object, 1U);
  EXPECT_EQ(hits[4].object, 0U);
  EXPECT_EQ(hits[5].object, RayHit::kNone);
  EXPECT_EQ(hits[6].object, 1U);
}

TEST(RayScene, IsBlockedOnlyWithinTheVectorsLength) {
  const RayScene rays(MakeTestScene());
  const std::vector<bool> blocked =
      rays.AreBlocked({0.0F, 0.0F, 1.0F}, std::vector<Eigen::Vector3f>{{0.0F, 1.7F, 0.0F},
                                                                       {0.0F, 1.9F, 0.0F},
                                                                       {1.0F, 2.9F, 0.0F},
                                                                       {1.0F, 3.1F, 0.0F},
                                                                       {0.0F, -9.0F, 0.0F}});
  EXPECT_EQ(blocked, (std::vector<bool>{false, true, false, true, false}));
}

TEST(RayScene, AnswersNothingToNoRays) {
  const RayScene rays(MakeTestScene());
  EXPECT_TRUE(rays.Cast({0.0F, 0.0F, 0.0F}, {}).empty());
  EXPECT_TRUE(rays.AreBlocked({0.0F, 0.0F, 0.0F}, {}).empty());
}

}  // namespace
}  // namespace cslam
