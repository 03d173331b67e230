// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/sequence_writer.h"

#include "cslam/dataset/sequence_summary.h"
#include "cslam/dataset/truth_builder.h"
#include "cslam/io/image_codec.h"
#include "cslam/io/instance_image.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"

#include <opencv2/core/mat.hpp>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace cslam {
namespace {

// Which frames of the sequence are still to be rendered.
std::vector<int> MissingFrames(const SimulatedSequence& sequence,
                               const std::filesystem::path& folder) {
  std::vector<int> missing;
  for (int i = 0; i < sequence.size(); ++i) {
    if (!IsFrameComplete(folder, sequence.stamp(i))) missing.push_back(i);
  }
  return missing;
}

// The images of one frame; the instance image last, since what is seen is told from it.
void WriteFrame(const SimulatedSequence& sequence, const std::filesystem::path& folder, int i) {
  const RenderedView truth = sequence.Truth(i);
  const RgbdFrame frame = sequence.Observe(i, truth);
  cv::Mat depth_units;
  frame.depth_m.convertTo(depth_units, CV_16U, kDepthUnitsPerM);
  const Stamp stamp = sequence.stamp(i);
  WritePng(folder / ImageName("rgb", stamp), frame.bgr);
  WritePng(folder / ImageName("depth", stamp), depth_units);
  WriteInstanceImage(folder / ImageName("instances", stamp), truth.instances,
                     static_cast<int>(sequence.scene().objects.size()));
}

// What the threads of one call share: which frame comes next, how many are done, what went wrong.
class Progress {
 public:
  Progress(int num_done, int total, const WriteSequenceOptions& options)
      : total_(total), done_(num_done), num_left_(total - num_done), options_(options) {
    if (options_.progress) options_.progress(done_, total_);
  }

  // Index into the missing frames; nothing when all are given out, on failure and on request to
  // stop. In order, so that threads work on neighbours, which share light.
  std::optional<std::size_t> Next() {
    const std::lock_guard lock(mutex_);
    if (next_ == num_left_ || failure_ || options_.stop.stop_requested()) return std::nullopt;
    return static_cast<std::size_t>(next_++);
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
  int done_;
  int num_left_;
  std::exception_ptr failure_;
  const WriteSequenceOptions& options_;
};

// False if asked to stop before all is done.
bool WriteFrames(const SimulatedSequence& sequence, const std::filesystem::path& folder,
                 const WriteSequenceOptions& options) {
  const std::vector<int> missing = MissingFrames(sequence, folder);
  const int num_missing = static_cast<int>(missing.size());
  Progress progress(sequence.size() - num_missing, sequence.size(), options);
  const auto work = [&] {
    try {
      while (const std::optional<std::size_t> next = progress.Next()) {
        WriteFrame(sequence, folder, missing[*next]);
        progress.Done();
      }
    } catch (...) {
      progress.Fail(std::current_exception());
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int job = 1; job < std::min(options.jobs, num_missing); ++job)
      helpers.emplace_back(work);
    work();
  }
  return progress.IsComplete();
}

// Nothing to do: a complete rendering of the same parameters.
bool IsComplete(const SimulatedSequence& sequence, const std::filesystem::path& folder,
                const WriteSequenceOptions& options) {
  std::error_code error;
  return options.existing == ExistingFolder::kResume &&
         std::filesystem::exists(folder / kCameraFile, error) &&
         MissingFrames(sequence, folder).empty();
}

}  // namespace

WriteOutcome WriteSequence(const SimulatedSequence& sequence, const RenderRecord& record,
                           const std::filesystem::path& folder,
                           const WriteSequenceOptions& options) {
  CSLAM_CHECK(options.jobs >= 1, "jobs {}", options.jobs);
  CheckSequenceFolder(folder, record, options.existing);
  if (IsComplete(sequence, folder, options)) {
    if (options.progress) options.progress(sequence.size(), sequence.size());
    return WriteOutcome::kComplete;
  }
  PrepareSequenceFolder(folder, record, options.existing);
  if (!WriteFrames(sequence, folder, options)) return WriteOutcome::kStopped;
  WriteSequenceSummary(sequence, record, folder);
  return WriteOutcome::kComplete;
}

double MeasureFrameBytes(const SimulatedSequence& sequence, const std::filesystem::path& folder,
                         int count) {
  CSLAM_CHECK(count >= 1, "{} samples", count);
  const int num_samples = std::min(count, sequence.size());
  double bytes = 0.0;
  for (int k = 0; k < num_samples; ++k) {
    const int i = (2 * k + 1) * sequence.size() / (2 * num_samples);
    const Stamp stamp = sequence.stamp(i);
    if (!IsFrameComplete(folder, stamp)) WriteFrame(sequence, folder, i);
    bytes += FrameBytes(folder, stamp);
  }
  return bytes / num_samples;
}

double MeasureFrameSeconds(const SimulatedSequence& sequence, const std::filesystem::path& folder) {
  const int i = sequence.size() / 2;
  WriteFrame(sequence, folder, std::max(0, i - 1));
  const Stopwatch watch;
  WriteFrame(sequence, folder, i);
  return 1e-3 * watch.Elapsed().cpu_ms;
}

WriteOutcome WriteSequence(const SimulatedSequence& sequence, const std::filesystem::path& folder,
                           const WriteSequenceOptions& options) {
  return WriteSequence(sequence, DescribeSequence(sequence, "simulated"), folder, options);
}

}  // namespace cslam
