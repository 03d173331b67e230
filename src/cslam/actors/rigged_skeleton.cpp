// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/rigged_skeleton.h"

#include "cslam/util/check.h"

#include <array>
#include <string>
#include <utility>

namespace cslam {
namespace {

struct Prefix {
  std::string_view text;
  Joint joint;
};

constexpr std::array<Prefix, 10> kTrunkGroups{{{"root", kPelvis},
                                               {"spine05", kPelvis},
                                               {"pelvis", kPelvis},
                                               {"spine04", kWaist},
                                               {"spine03", kWaist},
                                               {"spine", kChest},
                                               {"breast", kChest},
                                               {"clavicle", kChest},
                                               {"shoulder01", kChest},
                                               {"neck", kNeck}}};
constexpr std::array<Prefix, 9> kLimbGroups{{{"shoulder02", kUpperArmL},
                                             {"upperarm", kUpperArmL},
                                             {"lowerarm", kForearmL},
                                             {"wrist", kHandL},
                                             {"metacarpal", kHandL},
                                             {"finger", kHandL},
                                             {"upperleg", kThighL},
                                             {"lowerleg", kShinL},
                                             {"foot", kFootL}}};

Joint OnSide(Joint left, Side side) {
  if (side == Side::kLeft) return left;
  const std::size_t step = left >= kThighL ? kThighR - kThighL : kUpperArmR - kUpperArmL;
  return static_cast<Joint>(left + step);
}

class RigSkeleton {
 public:
  RigSkeleton(const BlendContents& rig, const Eigen::Vector3d& scale, double floor_m,
              const std::filesystem::path& file)
      : rig_(rig), scale_(scale), floor_m_(floor_m), file_(file) {}

  Skeleton Make() {
    const auto place = [&](Joint joint, const Eigen::Vector3d& at) {
      skeleton_.T_body_joint[joint].translation = at;
    };
    place(kPelvis, 0.5 * (Head("upperleg01_L") + Head("upperleg01_R")));
    place(kWaist, Head("spine04"));
    place(kChest, Head("spine02"));
    place(kNeck, Head("neck01"));
    place(kHead, Head("head"));
    for (const Side side : kSides) {
      const std::string_view suffix = side == Side::kLeft ? "_L" : "_R";
      const auto bone = [&](std::string_view name) {
        return Head(std::string(name) + std::string(suffix));
      };
      PlaceArm(side, bone("shoulder02"), bone("lowerarm01"), bone("wrist"));
      PlaceLeg(side, bone("upperleg01"), bone("lowerleg01"), bone("foot"));
    }
    return skeleton_;
  }

 private:
  Eigen::Vector3d Head(std::string_view name) const {
    for (const BlendBone& bone : rig_.bones) {
      if (bone.name != name) continue;
      const Eigen::Vector3d head = bone.head.cast<double>();
      return (head - Eigen::Vector3d(0.0, 0.0, floor_m_)).cwiseProduct(scale_);
    }
    throw Error("'{}' has no bone '{}'; it is not the rig of morse-simulator-data", file_.string(),
                name);
  }

  // The elbows are bent in rest: the plane of the arm gives the hinge.
  void PlaceArm(Side side, const Eigen::Vector3d& shoulder, const Eigen::Vector3d& elbow,
                const Eigen::Vector3d& wrist) {
    const LimbJoints arm = ArmOf(side);
    const Eigen::Vector3d hinge = (wrist - elbow).cross(elbow - shoulder);
    skeleton_.T_body_joint[arm.root] = Se3(BoneRotation(elbow - shoulder, hinge), shoulder);
    const Eigen::Quaterniond forearm = BoneRotation(wrist - elbow, hinge);
    skeleton_.T_body_joint[arm.middle] = Se3(forearm, elbow);
    skeleton_.T_body_joint[arm.end] = Se3(forearm, wrist);
  }

  void PlaceLeg(Side side, const Eigen::Vector3d& hip, const Eigen::Vector3d& knee,
                const Eigen::Vector3d& ankle) {
    const LimbJoints leg = LegOf(side);
    const Eigen::Vector3d left = Eigen::Vector3d::UnitY();
    skeleton_.T_body_joint[leg.root] = Se3(BoneRotation(knee - hip, left), hip);
    skeleton_.T_body_joint[leg.middle] = Se3(BoneRotation(ankle - knee, left), knee);
    skeleton_.T_body_joint[leg.end].translation = ankle;
    skeleton_.T_body_joint[ToesOf(side)].translation = ankle;
  }

  const BlendContents& rig_;
  Eigen::Vector3d scale_;
  double floor_m_;
  const std::filesystem::path& file_;
  Skeleton skeleton_;
};

}  // namespace

Skeleton SkeletonOfRig(const BlendContents& rig, const Eigen::Vector3d& scale, double floor_m,
                       const std::filesystem::path& file) {
  return RigSkeleton(rig, scale, floor_m, file).Make();
}

Joint JointOfGroup(std::string_view group) {
  for (const Prefix& prefix : kTrunkGroups) {
    if (group.starts_with(prefix.text)) return prefix.joint;
  }
  const Side side = group.ends_with("_R") ? Side::kRight : Side::kLeft;
  for (const Prefix& prefix : kLimbGroups) {
    if (group.starts_with(prefix.text)) return OnSide(prefix.joint, side);
  }
  if (group.starts_with("toe") || group.starts_with("metatarsal")) return LegOf(side).end;
  return kHead;  // jaw, eyes, mouth and whatever else moves a face
}

}  // namespace cslam
