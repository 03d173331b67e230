// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/process_info.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace cslam {
namespace {

constexpr std::size_t kMb = std::size_t{1} << 20;

TEST(ProcessInfo, PeakMemoryGrowsWithWhatIsUsed) {
  const std::size_t before = PeakMemoryBytes();
  std::vector<char> block(64 * kMb);
  std::memset(block.data(), 1, block.size());
  EXPECT_GT(before, kMb / 2);
  EXPECT_GE(PeakMemoryBytes(), 64 * kMb);
  EXPECT_EQ(block.back(), 1);
}

TEST(ProcessInfo, AgeIsThatOfThisProcess) {
  const auto age_ms = ProcessAgeMs();
  ASSERT_TRUE(age_ms);
  EXPECT_GT(*age_ms, -20.0);  // the start is known to the clock tick
  EXPECT_LT(*age_ms, 600e3);
}

TEST(ProcessInfo, CpuTimeGrowsWithWork) {
  const double before_s = ProcessCpuSeconds();
  double sum = 0.0;
  while (ProcessCpuSeconds() == before_s)
    sum += before_s;
  EXPECT_GT(ProcessCpuSeconds(), before_s) << sum;
}

TEST(ProcessInfo, DescribesHostAndCommandLine) {
  const HostInfo host = DescribeHost();
  EXPECT_FALSE(host.system.empty());
  EXPECT_GE(host.num_cpus, 1);
  EXPECT_EQ(CommandLineArguments().size(), testing::internal::GetArgvs().size() - 1);
}

}  // namespace
}  // namespace cslam
