// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace cslam {

// Adds "model detect": writes down what a network finds in a recording.
void AddModelDetectCommand(CLI::App& group, int& exit_code);

}  // namespace cslam
