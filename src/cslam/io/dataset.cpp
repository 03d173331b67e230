// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/dataset.h"

#include "cslam/io/tum_dataset.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <system_error>
#include <vector>

namespace cslam {
namespace {

namespace fs = std::filesystem;

// A user often names the folder above: the first folder inside that would do, as a hint.
std::string HintAtInnerDataset(const fs::path& folder) {
  std::vector<fs::path> candidates;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (entry->is_directory(error) && LooksLikeTum(entry->path())) {
      candidates.push_back(entry->path());
    }
  }
  if (candidates.empty()) return "";
  return fmt::format("; did you mean '{}'?",
                     std::min_element(candidates.begin(), candidates.end())->string());
}

// A sequence of which nothing can be used is the user's error, not hundreds of skipped frames. A
// few wrong sizes are enough to tell that camera and images do not belong together.
void CheckHasUsableFrame(const TumDataset& dataset) {
  constexpr int kMaxWrongSize = 3;
  int num_wrong_size = 0;
  std::string first_problem;
  std::string size_problem;
  for (std::size_t i = 0; i < dataset.size() && num_wrong_size < kMaxWrongSize; ++i) {
    const LoadResult result = LoadTumPair(dataset.pair(i), FrameId(0), dataset.camera());
    if (result.frame) return;
    if (first_problem.empty()) first_problem = result.problem;
    if (result.fault != FrameFault::kWrongSize) continue;
    if (size_problem.empty()) size_problem = result.problem;
    ++num_wrong_size;
  }
  if (!size_problem.empty()) {
    throw Error("{}; pass the camera of this recording with --camera", size_problem);
  }
  throw Error("none of the {} frames can be read; the first: {}", dataset.size(), first_problem);
}

}  // namespace

void CheckIsDataset(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) {
    throw Error("no such folder: '{}'", folder.string());
  }
  if (!fs::is_directory(folder, ignored)) {
    throw Error("'{}' is a file; name the folder of the data set", folder.string());
  }
  if (!LooksLikeTum(folder)) {
    throw Error(
        "'{}' is no data set: looked for associations.txt, else for colour (rgb.txt or rgb/) and "
        "depth (depth.txt or depth/){}",
        folder.string(), HintAtInnerDataset(folder));
  }
}

std::unique_ptr<DatasetReader> OpenDataset(const fs::path& folder, const DatasetOptions& options) {
  CheckIsDataset(folder);
  CameraConfig camera = ResolveCamera(folder, options.camera);
  auto dataset = std::make_unique<TumDataset>(ReadTumIndex(folder), std::move(camera), options);
  CheckHasUsableFrame(*dataset);
  return dataset;
}

}  // namespace cslam
