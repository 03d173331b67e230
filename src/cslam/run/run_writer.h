// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/run/run_report.h"

#include <filesystem>

namespace cslam {

// Makes folder, with those above it, and makes sure that files can be written in it, so that a run
// does not end with nowhere to go. Removes the run.json of an earlier run: a folder without it is
// not complete. Throws Error.
void PrepareRunFolder(const std::filesystem::path& folder);

// Writes all files of a run (docs/formats.md) into report.identity.folder, run.json last. Each
// appears under its name only when complete. Where one cannot be written the others still are;
// then throws the first Error.
void WriteRunFolder(const RunReport& report, const RunOutcome& outcome,
                    const RunTrajectories& trajectories, const DatasetReader& dataset,
                    const SlamOptions& options);

// "desk" for "data/desk/".
std::string SequenceName(const std::filesystem::path& sequence);

}  // namespace cslam
