// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/mapping/object_options.h"
#include "cslam/mapping/test_objects.h"
#include "cslam/semantics/coco.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace cslam::test {

// Twenty keyframes at the origin that look at an empty room's wall, 3 m away; objects by hand.
class WatchedRoomTest : public testing::Test {
 protected:
  WatchedRoomTest() : map_(kRoomScales) {
    static const auto kData = LookAtRoom(TestRoom{}, camera_, Se3(), 0).data;
    for (std::uint32_t i = 0; i < 20; ++i) {
      Keyframe keyframe;
      keyframe.id = KeyframeId(i);
      keyframe.map = MapId(0);
      if (i > 0) keyframe.parent = KeyframeId(0);
      keyframe.data = kData;
      map_.AddKeyframe(std::move(keyframe));
    }
  }

  // Seen from keyframe first to last; its front is at z - 0.25.
  ObjectId AddObject(const Eigen::Vector3d& at, std::uint32_t first, std::uint32_t last,
                     int class_id = kChairClass, float hue = 2.0F, double size_m = 0.5) {
    MapObject object;
    object.map = MapId(0);
    object.class_id = class_id;
    object.reference = KeyframeId(0);
    object.state = ObjectState::kPresent;
    object.log_odds = 3.0;
    object.centroid = object.box.center = at;
    object.box.size_m = Eigen::Vector3d::Constant(size_m);
    object.colours = ColoursWithHue(hue);
    object.first_keyframe = object.arrived_keyframe = KeyframeId(first);
    object.last_keyframe = KeyframeId(last);
    object.first_seen = Stamp{first * 1'000'000'000LL};
    object.last_seen = Stamp{last * 1'000'000'000LL};
    ObjectSurface surface;
    for (int i = 0; i < 25; ++i) {
      const Eigen::Vector3d offset(-0.2 + 0.1 * (i % 5), -0.2 + 0.1 * (i / 5), -0.25);
      surface.samples.push_back((at + offset).cast<float>());
    }
    object.surface = std::make_shared<const ObjectSurface>(std::move(surface));
    return map_.AddObject(std::move(object));
  }

  const Camera camera_ = RoomCamera();
  const MapObjectOptions options_;
  Map map_;
};

}  // namespace cslam::test
