// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "render_sequences.h"

#include "cslam/assets/procedural_props.h"
#include "cslam/dataset/sequence_writer.h"
#include "cslam/util/options.h"

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>

#include <sched.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stop_token>
#include <string_view>
#include <utility>

#include "cli_common.h"
#include "disk_space.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "version.h"

namespace cslam {
namespace {

// Thrown out of a download that the user ends.
struct Interrupted {};

constexpr std::string_view kAllNames = "all";

struct Task {
  SequenceEntry entry;
  std::filesystem::path folder;
};

}  // namespace

SequenceEntry FindSequence(std::string_view name) {
  std::vector<std::string> names;
  for (const SequenceEntry& entry : RenderableSequences()) {
    if (name == entry.name) return entry;
    names.emplace_back(entry.name);
  }
  const std::string nearest = NearestName(name, names);
  throw UsageError(fmt::format("unknown sequence '{}'{} (see 'changing-slam dataset list')", name,
                               nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

namespace {

// Throws UsageError for names that are unknown or there twice.
std::vector<SequenceEntry> FindEntries(const std::vector<std::string>& names) {
  if (names.size() == 1 && names[0] == kAllNames) return RenderableSequences();
  std::vector<SequenceEntry> entries;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (*name == kAllNames) throw UsageError("'all' stands alone, without other names");
    if (std::find(names.begin(), name, *name) != name)
      throw UsageError(fmt::format("'{}' is named twice", *name));
    entries.push_back(FindSequence(*name));
  }
  return entries;
}

std::vector<Task> MakeTasks(const RenderArguments& arguments) {
  if (arguments.folder.empty()) throw UsageError("--out: the name of the folder is empty");
  const std::vector<SequenceEntry> entries = FindEntries(arguments.names);
  std::vector<Task> tasks;
  for (const SequenceEntry& entry : entries) {
    const bool is_only = entries.size() == 1;
    tasks.push_back({entry, is_only ? arguments.folder : arguments.folder / entry.name});
  }
  return tasks;
}

int NumCores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(0, sizeof cores, &cores) != 0) return 1;
  return std::max(1, CPU_COUNT(&cores));
}

// Before minutes of downloads and work: are the folders free, and is there room?
void CheckFolders(const std::vector<Task>& tasks, const RenderArguments& arguments) {
  double needed_bytes = 0.0;
  for (const Task& task : tasks) {
    // Whether a rendering's parameters are the same is asked later, when they are all known.
    const bool must_be_free = arguments.existing == ExistingFolder::kRefuse;
    CheckSequenceFolder(task.folder, RenderRecord{},
                        must_be_free ? ExistingFolder::kRefuse : ExistingFolder::kReplace);
    const double existing_bytes = must_be_free ? 0.0 : BytesIn(task.folder);
    needed_bytes += std::max(0.0, RoughBytes(task.entry, arguments.request) - existing_bytes);
  }
  CheckFreeSpace(arguments.folder, needed_bytes);
}

constexpr int kNumSamples = 8;           // enough for 20 % in all sequences there are
constexpr double kOtherBytes = 1.5e6;    // contact sheet, truth files, lists
constexpr int kMinFramesToSample = 100;  // shorter ones are done in no time anyway

// Bytes the whole sequence takes, told from a few frames that are rendered into the folder.
double SampleBytes(const Rendering& rendering, const Task& task, ExistingFolder existing) {
  PrepareSequenceFolder(task.folder, rendering.record, existing);
  const double frame_bytes = MeasureFrameBytes(rendering.sequence, task.folder, kNumSamples);
  const double needed_bytes = kOtherBytes + rendering.sequence.size() * frame_bytes;
  CheckFreeSpace(task.folder, needed_bytes - BytesIn(task.folder));
  return needed_bytes;
}

void Announce(const Task& task, const RenderRequest& request, double needed_bytes) {
  const int num_frames = CountFrames(task.entry, request);
  fmt::print(stderr, "'{}'{}: {} frame{} of {}x{} at {} Hz, about {} in '{}'\n", task.entry.name,
             request.is_short ? " (short form)" : "", num_frames, num_frames == 1 ? "" : "s",
             request.width, request.height, request.fps, FormatBytes(needed_bytes),
             task.folder.string());
  if (request.num_frames > num_frames) {
    fmt::print(stderr, "warning: the story ends after {} frame{} at {} Hz; {} were asked for\n",
               num_frames, num_frames == 1 ? "" : "s", request.fps, request.num_frames);
  }
}

// What downloads say: a bar for each package whose size is known.
class FetchReporter {
 public:
  void Report(const FetchProgress& progress) {
    if (InterruptRequested()) throw Interrupted{};
    if (progress.package != package_) {
      bar_.reset();
      package_ = progress.package;
      if (progress.total_mb <= 0.0) fmt::print(stderr, "fetching {}\n", package_);
    }
    if (progress.total_mb <= 0.0) return;
    const int total = std::max(1, static_cast<int>(progress.total_mb));
    if (!bar_) bar_.emplace(fmt::format("fetching {} [MB]", package_), total);
    bar_->Update(std::clamp(static_cast<int>(progress.done_mb), 0, total));
  }

 private:
  std::string package_;
  std::optional<ProgressBar> bar_;
};

AssetStatus LoadAssets(const std::vector<Task>& tasks, Look wish) {
  const bool are_needed =
      std::ranges::any_of(tasks, [](const Task& task) { return task.entry.make != nullptr; });
  if (!are_needed) return {std::make_shared<const ProceduralProps>(), std::nullopt, ""};
  FetchReporter reporter;
  AssetStatus status =
      LoadOrFetchAssets(wish, [&](const FetchProgress& progress) { reporter.Report(progress); });
  if (!status.note.empty()) fmt::print(stderr, "warning: {}\n", status.note);
  return status;
}

// Turns what ends a rendering into a line that says how to go on.
WriteOutcome Write(const Rendering& rendering, const Task& task, const RenderArguments& arguments,
                   ExistingFolder existing) {
  std::optional<ProgressBar> bar;
  std::stop_source stop;
  WriteSequenceOptions options;
  options.jobs = arguments.jobs > 0 ? arguments.jobs : NumCores();
  options.existing = existing;
  options.stop = stop.get_token();
  options.progress = [&](int done, int total) {
    if (!bar) {
      if (arguments.existing == ExistingFolder::kResume)
        fmt::print(stderr, "{} of {} frames are there already\n", done, total);
      bar.emplace("rendering", total, done);
    }
    bar->Update(done);
    if (InterruptRequested()) stop.request_stop();
  };
  try {
    return WriteSequence(rendering.sequence, rendering.record, task.folder, options);
  } catch (const Error& error) {
    if (!bar) throw;
    throw Error("{}; the frames that are done are kept, --resume goes on", error.what());
  }
}

Rendering Describe(const Task& task, const RenderArguments& arguments, const Stage& stage) {
  Rendering rendering = MakeRendering(task.entry, arguments.request, stage);
  rendering.record.program = ProgramName();
  rendering.record.command = CommandOf(rendering.record);
  return rendering;
}

int Render(const Task& task, const RenderArguments& arguments, const AssetStatus& assets) {
  const Stage stage{*assets.props, assets.folder ? &*assets.folder : nullptr};
  const Rendering rendering = Describe(task, arguments, stage);
  ExistingFolder existing = arguments.existing;
  double needed_bytes = RoughBytes(task.entry, arguments.request);
  const bool may_be_complete =
      existing == ExistingFolder::kResume && std::filesystem::exists(task.folder / kCameraFile);
  if (rendering.sequence.size() >= kMinFramesToSample && !may_be_complete) {
    needed_bytes = SampleBytes(rendering, task, existing);
    existing = ExistingFolder::kResume;
  }
  Announce(task, arguments.request, needed_bytes);
  if (Write(rendering, task, arguments, existing) == WriteOutcome::kComplete) return kExitOk;
  fmt::print(stderr, "interrupted; the frames that are done are kept, --resume goes on\n");
  return kExitInterrupted;
}

RenderEstimate Estimate(const Task& task, const RenderArguments& arguments,
                        const AssetStatus& assets) {
  constexpr int kNumWeighed = 2;
  const Stage stage{*assets.props, assets.folder ? &*assets.folder : nullptr};
  const Rendering rendering = Describe(task, arguments, stage);
  RenderEstimate estimate;
  estimate.num_frames = rendering.sequence.size();
  PrepareSequenceFolder(task.folder, rendering.record, arguments.existing);
  const double frame_bytes = MeasureFrameBytes(rendering.sequence, task.folder, kNumWeighed);
  const double frame_s = MeasureFrameSeconds(rendering.sequence, task.folder);
  estimate.bytes = kOtherBytes + estimate.num_frames * frame_bytes;
  estimate.seconds =
      estimate.num_frames * frame_s / (arguments.jobs > 0 ? arguments.jobs : NumCores());
  return estimate;
}

}  // namespace

RenderEstimate EstimateRendering(const RenderArguments& arguments) {
  const std::vector<Task> tasks = MakeTasks(arguments);
  CSLAM_CHECK(tasks.size() == 1);
  try {
    return Estimate(tasks[0], arguments, LoadAssets(tasks, arguments.look));
  } catch (const Interrupted&) {
    return {};
  }
}

int RenderSequences(const RenderArguments& arguments) {
  const std::vector<Task> tasks = MakeTasks(arguments);
  CheckFolders(tasks, arguments);
  CatchInterrupts();
  cv::setNumThreads(1);  // the frames are spread over the cores already
  try {
    const AssetStatus assets = LoadAssets(tasks, arguments.look);
    for (const Task& task : tasks) {
      const int exit_code = Render(task, arguments, assets);
      if (exit_code != kExitOk) return exit_code;
    }
  } catch (const Interrupted&) {
    fmt::print(stderr, "interrupted\n");
    return kExitInterrupted;
  }
  return kExitOk;
}

}  // namespace cslam
