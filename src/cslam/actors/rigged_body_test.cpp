// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/rigged_body.h"

#include "cslam/actors/person.h"
#include "cslam/actors/person_model.h"
#include "cslam/actors/pose_solver.h"
#include "cslam/actors/rigged_skeleton.h"
#include "cslam/assets/asset_fetch.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace cslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(JointOfGroup, MapsBothSidesAndTheFace) {
  EXPECT_EQ(JointOfGroup("spine05"), kPelvis);
  EXPECT_EQ(JointOfGroup("spine02"), kChest);
  EXPECT_EQ(JointOfGroup("upperarm02_L"), kUpperArmL);
  EXPECT_EQ(JointOfGroup("lowerarm01_R"), kForearmR);
  EXPECT_EQ(JointOfGroup("finger3-2_R"), kHandR);
  EXPECT_EQ(JointOfGroup("lowerleg02_L"), kShinL);
  EXPECT_EQ(JointOfGroup("upperleg01_R"), kThighR);
  EXPECT_EQ(JointOfGroup("toe1-1_R"), kFootR);
  EXPECT_EQ(JointOfGroup("oculi02_L"), kHead);
}

TEST(MakePersonModel, NamesThePackageWhenTheRigIsMissing) {
  const TestFolder folder;
  const AssetFolder assets(folder.path());
  EXPECT_THAT(
      [&] { MakePersonModel(&assets, 0); },
      ThrowsMessage<Error>(AllOf(HasSubstr("human_rig.blend"), HasSubstr("morse-simulator-data"))));
}

TEST(MakeRiggedBody, NamesWhatIsMissingInAnotherRig) {
  EXPECT_THAT([] { MakeRiggedBody({}, LookOf(0), "other.blend"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("other.blend"), HasSubstr("-classic_shoes"))));
}

// The real file, where it has been fetched.
class RiggedPerson : public testing::Test {
 protected:
  void SetUp() override {
    const char* chosen = std::getenv("CSLAM_TEST_ASSETS");
    const std::filesystem::path root = chosen != nullptr ? chosen : DefaultAssetRoot();
    if (!std::filesystem::exists(root / kHumanRigFile))
      GTEST_SKIP() << "no " << (root / kHumanRigFile).string();
    assets_.emplace(root);
  }

  std::optional<AssetFolder> assets_;
};

TEST_F(RiggedPerson, StandsOnTheFloorWithItsOwnHeight) {
  for (const int variant : {0, 3}) {
    const auto model = MakePersonModel(&*assets_, variant);
    const BodyShape shape = ShapeOf(*model, StandingPose());
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& p : shape.positions)
      box.extend(p);
    EXPECT_NEAR(static_cast<double>(box.sizes().z()), LookOf(variant).height_m, 0.03);
    EXPECT_NEAR(box.min().z(), 0.0F, 0.01F);
    EXPECT_LT(box.sizes().y(), 0.8F);  // arms hang
    EXPECT_LT(box.sizes().x(), 0.5F);
  }
}

TEST_F(RiggedPerson, WalksOnTheFloorAndSitsOnTheSeat) {
  const auto model = MakePersonModel(&*assets_, 1);
  const Animation walker = Animate(model, Walk({{0.0, {0.0, 0.0}}, {3.0, {3.6, 0.0}}}, 1));
  for (double t = 0.0; t <= 3.0; t += 0.05) {
    float lowest_m = 1.0F;
    const BodyShape shape = *walker(t);
    for (const Eigen::Vector3f& p : shape.positions)
      lowest_m = std::min(lowest_m, p.z());
    EXPECT_NEAR(lowest_m, 0.0F, 0.025F) << t;
  }
  Sitting sitting;
  const Animation sitter = Animate(model, Sit(sitting, 1));
  float seat_m = 9.0F;  // the lowest of what is above the seat's middle
  const BodyShape sitting_shape = *sitter(1.0);
  for (const Eigen::Vector3f& p : sitting_shape.positions) {
    if (p.head<2>().norm() < 0.12F) seat_m = std::min(seat_m, p.z());
  }
  EXPECT_NEAR(seat_m, 0.45F, 0.03F);
}

TEST_F(RiggedPerson, HasTheSameTopologyInAllVariants) {
  const auto a = MakePersonModel(&*assets_, 0);
  const auto b = MakePersonModel(&*assets_, 2);
  EXPECT_EQ(a->body.mesh.positions.size(), b->body.mesh.positions.size());
  EXPECT_EQ(a->body.mesh.triangles.size(), b->body.mesh.triangles.size());
  EXPECT_GT(a->body.mesh.triangles.size(), 5000U);
}

}  // namespace
}  // namespace cslam
