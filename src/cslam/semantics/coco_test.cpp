// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/coco.h"

#include "cslam/semantics/detection.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

TEST(CocoClassName, KnowsTheIdsTheCodeRefersTo) {
  EXPECT_EQ(CocoClassName(kPersonClass), "person");
  EXPECT_EQ(CocoClassName(kChairClass), "chair");
  EXPECT_EQ(CocoClassName(kTvClass), "tv");
  EXPECT_EQ(CocoClassName(kNumCocoClasses - 1), "toothbrush");
  EXPECT_EQ(CocoClassName(kBackgroundClass), "background");
  EXPECT_THROW(CocoClassName(kNumCocoClasses), InternalError);
}

TEST(FindCocoClass, FindsEveryNameAndKey) {
  for (int id = 0; id < kNumCocoClasses; ++id) {
    EXPECT_EQ(FindCocoClass(CocoClassName(id)), id);
    EXPECT_EQ(FindCocoClass(CocoClassKey(id)), id);
  }
}

TEST(FindCocoClass, TakesOldNamesForTheSameClass) {
  EXPECT_EQ(FindCocoClass("tvmonitor"), kTvClass);
  EXPECT_EQ(FindCocoClass("sofa"), FindCocoClass("couch"));
  EXPECT_EQ(FindCocoClass("diningtable"), FindCocoClass("dining table"));
  EXPECT_EQ(FindCocoClass("motorbike"), 3);
  EXPECT_EQ(FindCocoClass("aeroplane"), 4);
  EXPECT_EQ(FindCocoClass("pottedplant"), 58);
}

TEST(FindCocoClass, FindsNothingForOtherNames) {
  EXPECT_FALSE(FindCocoClass("box"));
  EXPECT_FALSE(FindCocoClass(""));
  EXPECT_FALSE(FindCocoClass("background"));
}

}  // namespace
}  // namespace cslam
