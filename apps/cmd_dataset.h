// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace cslam {

// Adds "dataset" and what is below it. exit_code must live until the command line is parsed.
CLI::App* AddDatasetCommand(CLI::App& root, int& exit_code);

}  // namespace cslam
