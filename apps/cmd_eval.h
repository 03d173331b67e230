// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace cslam {

// Adds "eval ate" and "eval rpe", which compare an estimated trajectory with a reference, and what
// cmd_eval_scene.h has.
// exit_code must live until the command line is parsed.
CLI::App* AddEvalCommand(CLI::App& root, int& exit_code);

}  // namespace cslam
