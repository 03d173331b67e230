// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cslam {

// From now on the first Ctrl-C (SIGINT) or SIGTERM only sets a flag, so that the program can
// finish its files; the second one terminates at once.
void CatchInterrupts();

// Whether such a signal came. Poll it between frames.
bool InterruptRequested();

}  // namespace cslam
