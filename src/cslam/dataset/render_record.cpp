// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/render_record.h"

#include "cslam/io/truth_json.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace cslam {
namespace {

constexpr char kFormat[] = "render";
constexpr int kMaxSidePx = 16384;  // as for cameras
constexpr int kMaxFrames = 100'000'000;
constexpr double kMaxFps = 1e6;
constexpr double kMaxDurationS = 1e9;
constexpr std::array kNoises{SensorNoise::kOff, SensorNoise::kKinect, SensorNoise::kD435i};

SensorNoise ReadNoise(const JsonValue& value) {
  const std::string name = value.Text();
  for (const SensorNoise noise : kNoises) {
    if (name == NameOf(noise)) return noise;
  }
  value.Fail("expected \"off\", \"kinect\" or \"d435i\"");
}

std::string JsonList(const std::vector<std::string>& names) {
  std::vector<std::string> quoted;
  for (const std::string& name : names)
    quoted.push_back(JsonQuoted(name));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

PeopleClaim ReadPeople(const JsonValue& value) {
  value.RequireKeys({"min_mean_share", "min_peak_share", "leave_view"});
  return {.min_mean_share = value.At("min_mean_share").NumberIn(0.0, 1.0),
          .min_peak_share = value.At("min_peak_share").NumberIn(0.0, 1.0),
          .leave_view = value.At("leave_view").Bool()};
}

}  // namespace

std::string_view NameOf(SensorNoise noise) {
  switch (noise) {
    case SensorNoise::kOff:
      return "off";
    case SensorNoise::kKinect:
      return "kinect";
    case SensorNoise::kD435i:
      return "d435i";
  }
  throw InternalError("noise", "no such kind of noise", std::source_location::current());
}

RenderRecord DescribeSequence(const SimulatedSequence& sequence, const std::string& name) {
  RenderRecord record;
  record.sequence = name;
  record.seed = sequence.options().seed;
  record.width_px = sequence.camera().width;
  record.height_px = sequence.camera().height;
  record.fps = sequence.options().fps;
  record.num_frames = sequence.size();
  record.story_duration_s = sequence.size() / record.fps;
  record.noise = sequence.options().noise;
  return record;
}

RenderRecord ReadRenderRecord(const std::filesystem::path& file) {
  const JsonFile json(file);
  const JsonValue root = json.root();
  RequireFormat(root, kFormat);
  root.RequireKeys({"format", "version", "sequence", "summary", "program", "look", "command",
                    "seed", "is_short", "without_people", "width_px", "height_px", "fps",
                    "num_frames", "story_duration_s", "noise", "people"},
                   {"without"});
  RenderRecord record;
  if (root.Has("without")) {
    for (const JsonValue& name : root.At("without").Items())
      record.without.push_back(name.Text());
  }
  record.sequence = root.At("sequence").Text();
  record.summary = root.At("summary").Text();
  record.program = root.At("program").Text();
  record.look = root.At("look").Text();
  record.command = root.At("command").Text();
  record.seed = root.At("seed").Unsigned64();
  record.is_short = root.At("is_short").Bool();
  record.without_people = root.At("without_people").Bool();
  record.width_px = root.At("width_px").IntegerIn(1, kMaxSidePx);
  record.height_px = root.At("height_px").IntegerIn(1, kMaxSidePx);
  record.fps = root.At("fps").NumberIn(0.0, kMaxFps);
  record.num_frames = root.At("num_frames").IntegerIn(1, kMaxFrames);
  record.story_duration_s = root.At("story_duration_s").NumberIn(0.0, kMaxDurationS);
  record.noise = ReadNoise(root.At("noise"));
  record.people = ReadPeople(root.At("people"));
  return record;
}

void WriteRenderRecord(const std::filesystem::path& file, const RenderRecord& record) {
  AtomicFile out(file);
  out.Write(TruthHeader(kFormat, record.sequence));
  out.Print("  \"summary\": {},\n", JsonQuoted(record.summary));
  out.Print("  \"program\": {},\n", JsonQuoted(record.program));
  out.Print("  \"look\": {},\n", JsonQuoted(record.look));
  out.Print("  \"command\": {},\n", JsonQuoted(record.command));
  out.Print("  \"seed\": {},\n  \"is_short\": {},\n", record.seed, record.is_short);
  out.Print("  \"without_people\": {},\n", record.without_people);
  if (!record.without.empty()) out.Print("  \"without\": {},\n", JsonList(record.without));
  out.Print("  \"width_px\": {},\n  \"height_px\": {},\n", record.width_px, record.height_px);
  out.Print("  \"fps\": {},\n  \"num_frames\": {},\n  \"story_duration_s\": {},\n",
            JsonNumber(record.fps), record.num_frames, JsonNumber(record.story_duration_s));
  out.Print("  \"noise\": \"{}\",\n", NameOf(record.noise));
  out.Print(
      "  \"people\": {{\"min_mean_share\": {}, \"min_peak_share\": {}, \"leave_view\": {}}}\n}}\n",
      JsonNumber(record.people.min_mean_share), JsonNumber(record.people.min_peak_share),
      record.people.leave_view);
  out.Commit();
}

std::vector<std::string> Differences(const RenderRecord& there, const RenderRecord& wanted) {
  std::vector<std::string> differences;
  const auto compare = [&](std::string_view what, const auto& a, const auto& b) {
    if (a != b) differences.push_back(fmt::format("{} is {} there, {} was asked for", what, a, b));
  };
  const auto size = [](const RenderRecord& r) {
    return fmt::format("{}x{}", r.width_px, r.height_px);
  };
  compare("the sequence", there.sequence, wanted.sequence);
  compare("the seed", there.seed, wanted.seed);
  compare("the number of frames", there.num_frames, wanted.num_frames);
  compare("the rate", there.fps, wanted.fps);
  compare("the size", size(there), size(wanted));
  compare("the noise", NameOf(there.noise), NameOf(wanted.noise));
  compare("the short form", there.is_short, wanted.is_short);
  compare("leaving people out", there.without_people, wanted.without_people);
  compare("what is left out", fmt::format("[{}]", fmt::join(there.without, ", ")),
          fmt::format("[{}]", fmt::join(wanted.without, ", ")));
  compare("the look", there.look, wanted.look);
  compare("the program", there.program, wanted.program);
  return differences;
}

}  // namespace cslam
