// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/report_files.h"
#include "cslam/pipeline/run_result.h"

#include <string>

namespace cslam {

// What a run knows of objects and changes in the map that most of its frames were tracked in, for
// objects.json and changes.json. Candidates are listed as such; merged and erased objects are not.
ReportedObjects ReportObjects(const RunResult& result, const std::string& sequence);
ReportedChanges ReportChanges(const RunResult& result, const std::string& sequence);

}  // namespace cslam
