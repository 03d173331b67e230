// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace cslam {

// Adds "relocalise" to root. Running it sets exit_code.
CLI::App* AddRelocaliseCommand(CLI::App& root, int& exit_code);

}  // namespace cslam
