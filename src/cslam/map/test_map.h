// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/vision/test_features.h"

#include <memory>

namespace cslam::test {

inline const std::vector<double> kLevelScales{1.0, 1.2, 1.44};

// A keyframe with num_features features of random looks, at x metres along the world's x axis.
// Without a parent it is the first of its map.
inline Keyframe MakeKeyframe(std::uint32_t id, int num_features, double x = 0.0,
                             KeyframeId parent = {}, MapId map = MapId(0)) {
  Rng rng(id, 17);
  std::vector<Feature> features;
  for (int i = 0; i < num_features; ++i) {
    features.push_back({.u = static_cast<float>(rng.Uniform(0.0, 640.0)),
                        .v = static_cast<float>(rng.Uniform(0.0, 480.0)),
                        .descriptor = RandomDescriptor(rng),
                        .octave = static_cast<int>(rng.Index(kLevelScales.size()))});
  }
  auto data = std::make_shared<KeyframeData>();
  data->frame = FrameId(10 * id);
  data->stamp = Stamp{1'000'000 * static_cast<std::int64_t>(id)};
  data->features = MakeFeatures(features);
  Keyframe keyframe;
  keyframe.id = KeyframeId(id);
  keyframe.map = map;
  keyframe.parent = parent;
  keyframe.T_world_camera.translation.x() = x;
  keyframe.data = std::move(data);
  return keyframe;
}

}  // namespace cslam::test
