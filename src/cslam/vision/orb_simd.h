// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// One source for two instruction sets: the body of a loop is a CSLAM_KERNEL, which the compiler
// vectorises anew inside each function it is called from; one of these is a CSLAM_TARGET_AVX2,
// chosen at run time. Both give the same bits, as no kernel contracts or reorders floating point.
#if defined(__x86_64__) && defined(__GNUC__)
#define CSLAM_HAS_AVX2 1
#define CSLAM_TARGET_AVX2 [[gnu::target("avx2")]]
#else
#define CSLAM_HAS_AVX2 0
#define CSLAM_TARGET_AVX2
#endif
#define CSLAM_KERNEL [[gnu::always_inline]] inline

namespace cslam::orb {

enum class Simd { kBaseline, kAvx2 };

// The widest set this processor has.
inline Simd BestSimd() {
#if CSLAM_HAS_AVX2
  return __builtin_cpu_supports("avx2") ? Simd::kAvx2 : Simd::kBaseline;
#else
  return Simd::kBaseline;
#endif
}

}  // namespace cslam::orb
