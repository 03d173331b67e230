// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace cslam {

struct RenderRequest;

// Adds --frames, --fps and --size. request must live until the command line is parsed.
void AddSizeOptions(CLI::App& app, RenderRequest& request);

// Adds "render" and "list" below "dataset". exit_code must live until the command line is parsed.
void AddRenderCommands(CLI::App& dataset, int& exit_code);

}  // namespace cslam
