// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace cslam {

// Prints what parsing ended with, and returns the exit code: the help or version that was asked
// for on stdout, or one line on stderr that names the nearest valid command or option. Without
// any argument the whole help goes to stderr.
int ReportParseError(const CLI::App& root, const CLI::ParseError& error, int num_arguments);

}  // namespace cslam
