// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/options.h"

namespace cslam {

struct SlamOptions {
  int seed = 1;
};

inline void Describe(OptionList& list, SlamOptions& o) {
  list.Add("seed", o.seed, {0, 1e9}, "", "seed of every random choice");
}

}  // namespace cslam
