// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Tracks a recorded sequence and prints its trajectory in TUM format: track_folder FOLDER
//
// Shows the four things the library offers: feed a frame and get its pose, subscribe to results,
// query the map, and the final trajectory.
#include "cslam/io/dataset.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/pipeline/slam.h"
#include "cslam/util/check.h"

#include <cstdio>
#include <memory>
#include <utility>

namespace {

// A listener; SLAM runs the same without it.
class KeyframeCounter : public cslam::OutputSink {
 public:
  void OnMap(const cslam::MapUpdate& update) override {
    if (update.step == cslam::MapUpdate::Step::kInserted) ++num_inserted_;
  }
  int num_inserted() const { return num_inserted_; }

 private:
  int num_inserted_ = 0;
};

void Track(const char* folder) {
  const auto dataset = cslam::OpenDataset(folder);
  const auto counter = std::make_shared<KeyframeCounter>();
  cslam::Slam slam(dataset->camera().camera, cslam::SlamOptions{}, cslam::Execution::kInline,
                   {counter});
  int num_tracked = 0;
  for (std::size_t i = 0; i < dataset->size(); ++i) {
    cslam::LoadResult loaded = dataset->Load(i);
    if (!loaded.frame) continue;  // loaded.problem says why
    const cslam::TrackingResult result =
        slam.Track(std::make_shared<const cslam::RgbdFrame>(std::move(*loaded.frame)));
    if (result.T_world_camera) ++num_tracked;
  }
  const cslam::RunResult& result = slam.Finish();
  std::fprintf(stderr, "%d of %zu frames tracked, %d keyframes inserted, %zu points in the map\n",
               num_tracked, dataset->size(), counter->num_inserted(),
               slam.map() ? slam.map()->map.num_points() : 0);
  std::fputs(cslam::FormatTrajectory(cslam::FinalTrajectory(result)).c_str(), stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER > trajectory.txt\n", argv[0]);
    return 2;
  }
  try {
    Track(argv[1]);
  } catch (const cslam::Error& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
  return 0;
}
