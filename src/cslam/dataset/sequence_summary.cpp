// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/sequence_summary.h"

#include "cslam/dataset/contact_sheet.h"
#include "cslam/dataset/readme_text.h"
#include "cslam/dataset/sequence_folder.h"
#include "cslam/dataset/truth_builder.h"
#include "cslam/io/camera_file.h"
#include "cslam/io/image_codec.h"
#include "cslam/io/instance_image.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/util/atomic_file.h"

#include <fmt/format.h>

#include <string>

namespace cslam {
namespace {

namespace fs = std::filesystem;

void WriteLists(const SimulatedSequence& sequence, const fs::path& folder) {
  std::string rgb = "# color images\n# timestamp filename\n";
  std::string depth = "# depth maps\n# timestamp filename\n";
  std::string instances = "# instance images\n# timestamp filename\n";
  std::string associations;
  Trajectory trajectory;
  for (int i = 0; i < sequence.size(); ++i) {
    const Stamp stamp = sequence.stamp(i);
    const auto entry = [&](const char* kind) {
      return fmt::format("{} {}", FormatStamp(stamp), ImageName(kind, stamp));
    };
    rgb += entry("rgb") + "\n";
    depth += entry("depth") + "\n";
    instances += entry("instances") + "\n";
    associations += fmt::format("{} {}\n", entry("rgb"), entry("depth"));
    trajectory.push_back({stamp, sequence.T_world_camera(i)});
  }
  WriteFileAtomically(folder / "rgb.txt", rgb);
  WriteFileAtomically(folder / "depth.txt", depth);
  WriteFileAtomically(folder / "instances.txt", instances);
  WriteFileAtomically(folder / "associations.txt", associations);
  WriteTrajectory(folder / "groundtruth.txt", trajectory,
                  "exact poses of the camera\ntimestamp tx ty tz qx qy qz qw");
}

DetectionRecord CollectDetections(const SimulatedSequence& sequence, const RenderRecord& record,
                                  const fs::path& folder) {
  DetectionRecord detections{.sequence = record.sequence,
                             .width_px = record.width_px,
                             .height_px = record.height_px,
                             .frames = {}};
  for (int i = 0; i < sequence.size(); ++i) {
    const Stamp stamp = sequence.stamp(i);
    const cv::Mat instances = ReadInstanceImage(folder / ImageName("instances", stamp));
    detections.frames.push_back({stamp, BuildDetections(instances, sequence.scene())});
  }
  return detections;
}

CameraConfig DescribeCamera(const SimulatedSequence& sequence, const RenderRecord& record) {
  CameraConfig config;
  config.camera = sequence.camera();
  config.depth_units_per_m = kDepthUnitsPerM;
  config.name = fmt::format("rendered {}, noise {}, {} look", record.sequence, NameOf(record.noise),
                            record.look);
  return config;
}

}  // namespace

void WriteSequenceSummary(const SimulatedSequence& sequence, const RenderRecord& record,
                          const fs::path& folder) {
  WriteLists(sequence, folder);
  WriteDetections(folder / "detections.json", CollectDetections(sequence, record, folder));
  const TrueObjects objects = BuildTrueObjects(sequence, record.sequence);
  const TrueChanges changes = BuildTrueChanges(sequence, record.sequence);
  WriteTrueObjects(folder / "objects.json", objects);
  WriteTrueChanges(folder / "changes.json", changes);
  std::vector<SheetFrame> frames;
  for (int i = 0; i < sequence.size(); ++i)
    frames.push_back({sequence.time_s(i), folder / ImageName("rgb", sequence.stamp(i))});
  WritePng(folder / "contact_sheet.png", MakeContactSheet(frames, objects, changes));
  WriteFileAtomically(folder / "README.txt",
                      FormatReadme(record, sequence.camera(), objects, changes));
  WriteCameraFile(folder / kCameraFile, DescribeCamera(sequence, record));
}

}  // namespace cslam
