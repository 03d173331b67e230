// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/sequence_writer.h"

#include "cslam/io/camera_file.h"
#include "cslam/io/image_codec.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr double kDepthUnitsPerM = 5000.0;  // TUM's
constexpr char kCompletionFile[] = "camera.yaml";

std::string ImageName(const SimulatedSequence& sequence, int i, const char* kind) {
  return fmt::format("{}/{}.png", kind, FormatStamp(sequence.stamp(i)));
}

void PrepareFolder(const std::filesystem::path& folder, ExistingFolder existing) {
  std::error_code error;
  const bool is_empty =
      !std::filesystem::exists(folder, error) ||
      (std::filesystem::is_directory(folder, error) && std::filesystem::is_empty(folder, error));
  if (!is_empty && existing == ExistingFolder::kRefuse) {
    throw Error("'{}' exists and is not an empty folder; choose another one or remove it",
                folder.string());
  }
  std::filesystem::remove(folder / kCompletionFile, error);
  for (const char* kind : {"rgb", "depth"}) {
    std::filesystem::create_directories(folder / kind, error);
    if (error) throw Error("cannot create '{}': {}", (folder / kind).string(), error.message());
  }
}

void WriteFrame(const SimulatedSequence& sequence, const std::filesystem::path& folder, int i) {
  const RgbdFrame frame = sequence.Frame(i);
  cv::Mat depth_units;
  frame.depth_m.convertTo(depth_units, CV_16U, kDepthUnitsPerM);
  WritePng(folder / ImageName(sequence, i, "rgb"), frame.bgr);
  WritePng(folder / ImageName(sequence, i, "depth"), depth_units);
}

// What the threads of one call share: which frame comes next, how many are done, what went wrong.
class Progress {
 public:
  Progress(int total, const WriteSequenceOptions& options) : total_(total), options_(options) {}

  // The next frame to render; nothing when all are given out, on failure and on request to stop.
  std::optional<int> Next() {
    const std::lock_guard lock(mutex_);
    if (next_ == total_ || failure_ || options_.stop.stop_requested()) return std::nullopt;
    return next_++;
  }

  void Done() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (options_.progress) options_.progress(done_, total_);
  }

  void Fail(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }

  // After the threads have ended: throws what one of them threw.
  bool IsComplete() const {
    if (failure_) std::rethrow_exception(failure_);
    return done_ == total_;
  }

 private:
  std::mutex mutex_;
  int total_;
  int next_ = 0;
  int done_ = 0;
  std::exception_ptr failure_;
  const WriteSequenceOptions& options_;
};

void WriteLists(const SimulatedSequence& sequence, const std::filesystem::path& folder) {
  std::string rgb = "# color images\n# timestamp filename\n";
  std::string depth = "# depth maps\n# timestamp filename\n";
  std::string associations;
  Trajectory trajectory;
  for (int i = 0; i < sequence.size(); ++i) {
    const std::string stamp = FormatStamp(sequence.stamp(i));
    const std::string rgb_entry = fmt::format("{} {}", stamp, ImageName(sequence, i, "rgb"));
    const std::string depth_entry = fmt::format("{} {}", stamp, ImageName(sequence, i, "depth"));
    rgb += fmt::format("{}\n", rgb_entry);
    depth += fmt::format("{}\n", depth_entry);
    associations += fmt::format("{} {}\n", rgb_entry, depth_entry);
    trajectory.push_back({sequence.stamp(i), sequence.T_world_camera(i)});
  }
  WriteFileAtomically(folder / "rgb.txt", rgb);
  WriteFileAtomically(folder / "depth.txt", depth);
  WriteFileAtomically(folder / "associations.txt", associations);
  WriteTrajectory(folder / "groundtruth.txt", trajectory);
  CameraConfig config;
  config.camera = sequence.camera();
  config.depth_units_per_m = kDepthUnitsPerM;
  config.name = "simulated";
  WriteCameraFile(folder / kCompletionFile, config);
}

}  // namespace

WriteOutcome WriteSequence(const SimulatedSequence& sequence, const std::filesystem::path& folder,
                           const WriteSequenceOptions& options) {
  CSLAM_CHECK(options.jobs >= 1, "jobs {}", options.jobs);
  PrepareFolder(folder, options.existing);
  Progress progress(sequence.size(), options);
  const auto work = [&] {
    try {
      while (const std::optional<int> i = progress.Next()) {
        WriteFrame(sequence, folder, *i);
        progress.Done();
      }
    } catch (...) {
      progress.Fail(std::current_exception());
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int job = 1; job < std::min(options.jobs, sequence.size()); ++job)
      helpers.emplace_back(work);
    work();
  }
  if (!progress.IsComplete()) return WriteOutcome::kStopped;
  WriteLists(sequence, folder);
  return WriteOutcome::kComplete;
}

}  // namespace cslam
