// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace cslam {

// Adds "objects" and "changes" to the eval command: what a run says of things against the truth of
// a rendered sequence. exit_code must live until the command line is parsed.
void AddSceneEvalCommands(CLI::App& eval, int& exit_code);

}  // namespace cslam
