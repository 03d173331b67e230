// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace cslam {

// Adds "model install", "model list" and "model info": the networks that find people and things.
// exit_code must live until the command line is parsed.
CLI::App* AddModelCommand(CLI::App& root, int& exit_code);

}  // namespace cslam
