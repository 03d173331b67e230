// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/readme_text.h"

#include "cslam/dataset/change_text.h"
#include "cslam/dataset/sequence_folder.h"
#include "cslam/util/text_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cslam {
namespace {

constexpr char kFiles[] =
    R"(rgb/               colour images, 8-bit PNG, named by time stamp
depth/             distance along the optical axis, 16-bit PNG, 5000 units per metre, 0: none
instances/         which object each pixel shows: its instance id, 0: the room; 8-bit PNG, or
                   16-bit if there are more than 255 objects; exact even where depth is noisy
rgb.txt, depth.txt, instances.txt    time stamps and names of the images
associations.txt   which colour and depth images belong together
groundtruth.txt    exact poses of the camera: stamp tx ty tz qx qy qz qw (s, m, unit quaternion;
                   camera x right, y down, z forward; world z up)
camera.yaml        intrinsics in px and depth scale; written last: without it, this is incomplete
detections.json    for each frame: instance id, COCO class, box and visible pixels of each object
objects.json       each object's name, COCO class, box, and where it is from when to when
changes.json       what was removed, added, moved or replaced, when, from where and to where
contact_sheet.png  pictures from the whole sequence at one glance
render.json        the parameters of this rendering
)";

constexpr char kPackagesLook[] =
    R"(Models, textures and posters come from Debian packages (sweethome3d-furniture,
morse-simulator-data, ufoai-textures, plasma-workspace-wallpapers) under free licences of their own,
some of which ask that authors be named or that copies keep the licence. Before passing these images
on, see docs/assets.md of Changing-SLAM, which lists each asset with author and licence.
)";
constexpr char kProceduralLook[] =
    R"(Everything in the images is drawn by the program itself; nothing of others is in them.
)";

std::string Poses(const TrueChange& change) {
  const auto place = [](const std::optional<Se3>& pose) -> std::string {
    if (!pose) return "";
    const Eigen::Vector3d& p = pose->translation;
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", p.x(), p.y(), p.z());
  };
  const std::string from = place(change.from);
  const std::string to = place(change.to);
  if (from.empty()) return "at " + to;
  if (to.empty()) return "at " + from;
  return from + " -> " + to;
}

std::string StoryTable(const TrueObjects& objects, const TrueChanges& changes) {
  if (changes.changes.empty()) return "Nothing that rests changes its place.\n";
  TextTable table({{"time [s]", TextAlign::kRight}, {"what"}, {"where [m]"}, {"how"}});
  for (const TrueChange& change : changes.changes) {
    table.AddRow({fmt::format("{:.2f}", change.time_s), Describe(change, objects), Poses(change),
                  change.is_carried_in_view ? "carried" : "at once"});
  }
  return table.Text();
}

std::string Heading(std::string_view title) {
  return fmt::format("\n{}\n{}\n", title, std::string(title.size(), '-'));
}

std::string Parameters(const RenderRecord& record, const Camera& camera) {
  const double duration_s = record.num_frames / record.fps;
  TextTable table;
  table.AddRow(
      {"frames", fmt::format("{} at {} Hz: {:.1f} s of a story of {:.1f} s{}", record.num_frames,
                             record.fps, duration_s, record.story_duration_s,
                             record.is_short ? " (its short form)" : "")});
  table.AddRow({"camera",
                fmt::format("{}x{} px, fx {:.2f}, fy {:.2f}, cx {:.2f}, cy {:.2f} px", camera.width,
                            camera.height, camera.fx, camera.fy, camera.cx, camera.cy)});
  table.AddRow({"sensor noise", std::string(NameOf(record.noise))});
  table.AddRow({"seed", std::to_string(record.seed)});
  table.AddRow({"look", record.look});
  if (record.without_people) table.AddRow({"people", "left out; what they carry moves by itself"});
  if (!record.without.empty())
    table.AddRow({"left out", fmt::format("{}", fmt::join(record.without, ", "))});
  if (!record.program.empty()) table.AddRow({"program", record.program});
  return table.Text();
}

}  // namespace

std::string FormatReadme(const RenderRecord& record, const Camera& camera,
                         const TrueObjects& objects, const TrueChanges& changes) {
  std::string text =
      fmt::format("{}: an RGB-D sequence rendered by Changing-SLAM\n", record.sequence);
  if (!record.summary.empty()) text += fmt::format("\n{}\n", record.summary);
  text += fmt::format("\n{}", Parameters(record, camera));
  if (!record.command.empty())
    text += fmt::format("{}{}\n", Heading("To render it again"), record.command);
  text += Heading("What happens") + StoryTable(objects, changes);
  text += Heading("Files") + kFiles;
  text += "\nThe files' formats: docs/formats.md and docs/datasets.md of Changing-SLAM.\n";
  text += Heading("Licence") + (record.look == "procedural" ? kProceduralLook : kPackagesLook);
  return text;
}

}  // namespace cslam
