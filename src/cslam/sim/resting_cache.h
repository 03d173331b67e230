// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/resting_scene.h"
#include "cslam/sim/world.h"

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace cslam {

// The resting scenes of a world, made when first asked for; the last few are kept. May be asked
// from several threads at once; the answer does not depend on who asked for what before.
class RestingCache {
 public:
  explicit RestingCache(const World& world);  // must outlive this

  std::shared_ptr<const RestingScene> At(double time_s) const;

 private:
  struct Entry {
    std::size_t epoch = 0;  // number of changes before it
    std::shared_ptr<const RestingScene> scene;
  };

  const World& world_;
  std::vector<double> changes_s_;
  mutable std::mutex mutex_;
  mutable std::vector<Entry> entries_;  // the last used one first
};

}  // namespace cslam
