// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace cslam {

// Adds "benchmark": the rendered sequences with the object layer on and off. exit_code must live
// until the command line is parsed.
void AddBenchmarkCommand(CLI::App& root, int& exit_code);

}  // namespace cslam
