// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace cslam {

// Adds "map info" and "map export": what is in a saved map. exit_code must live until the command
// line is parsed.
CLI::App* AddMapCommand(CLI::App& root, int& exit_code);

}  // namespace cslam
