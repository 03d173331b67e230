// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/gate.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace cslam {
namespace {

TEST(Gate, LetsPassWhileLittleIsInFlight) {
  Gate gate;
  gate.WaitUntilAtMost(0);
  gate.Enter();
  gate.WaitUntilAtMost(1);
}

TEST(Gate, WaitsUntilEnoughHasLeft) {
  Gate gate;
  gate.Enter();
  gate.Enter();
  std::atomic<int> left = 0;
  std::thread worker([&] {
    for (int i = 0; i < 2; ++i) {
      ++left;
      gate.Leave();
    }
  });
  gate.WaitUntilAtMost(1);
  EXPECT_GE(left, 1);
  gate.WaitUntilAtMost(0);
  EXPECT_EQ(left, 2);
  worker.join();
}

TEST(Gate, OpenReleasesWhoWaitsAndWhoComesLater) {
  Gate gate;
  gate.Enter();
  std::thread waiter([&] { gate.WaitUntilAtMost(0); });
  gate.Open();
  waiter.join();
  gate.WaitUntilAtMost(0);
}

}  // namespace
}  // namespace cslam
