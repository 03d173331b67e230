// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cslam {

inline constexpr int kExitOk = 0;
inline constexpr int kExitRuntimeError = 1;
inline constexpr int kExitUsage = 2;
inline constexpr int kExitBarMissed = 3;
inline constexpr int kExitInterrupted = 130;  // as shells report SIGINT; results are complete

}  // namespace cslam
