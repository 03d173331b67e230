// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_map.h"

#include "cslam/atlas_io/map_export.h"
#include "cslam/atlas_io/map_file.h"
#include "cslam/atlas_io/map_summary.h"
#include "cslam/io/pcd_file.h"
#include "cslam/io/point_cloud_file.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/navigation/grid_file.h"
#include "cslam/util/text_table.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli_common.h"
#include "exit_codes.h"

namespace cslam {
namespace {

namespace fs = std::filesystem;

struct InfoArguments {
  fs::path file;
  bool json = false;
};

struct ExportArguments {
  fs::path file;
  fs::path out;
  std::optional<std::uint32_t> map_id;
  bool dense = false;
  DenseCloudOptions dense_options;
  fs::path grid;
  ConfigArguments config;  // of the grid
};

std::string SizeText(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return "-";
  const Eigen::Vector3d size = box.sizes();
  return fmt::format("{:.2f} x {:.2f} x {:.2f}", size.x(), size.y(), size.z());
}

std::string CameraText(const CameraConfig& config) {
  const Camera& c = config.camera;
  return fmt::format("{}{} x {} px, fx {}, fy {}, cx {}, cy {}{}",
                     config.name.empty() ? "" : config.name + ": ", c.width, c.height, c.fx, c.fy,
                     c.cx, c.cy, config.approximate ? " (approximate)" : "");
}

void PrintMaps(const std::vector<MapSummary>& maps) {
  if (maps.empty()) return;
  constexpr TextAlign kRight = TextAlign::kRight;
  TextTable table({{"map", kRight},
                   {"keyframes", kRight},
                   {"points", kRight},
                   {"path x, y, z [m]", kRight},
                   {"points x, y, z [m]", kRight},
                   {"first [s]", kRight},
                   {"last [s]", kRight}});
  for (const MapSummary& map : maps) {
    table.AddRow({fmt::format("{}", map.map.value()), fmt::format("{}", map.num_keyframes),
                  fmt::format("{}", map.num_points), SizeText(map.keyframes_box),
                  SizeText(map.points_box), FormatStamp(map.first), FormatStamp(map.last)});
  }
  fmt::print("\n{}", table.Text());
}

void PrintSessions(const std::vector<SessionSummary>& sessions) {
  if (sessions.size() < 2) return;
  constexpr TextAlign kRight = TextAlign::kRight;
  TextTable table(
      {{"session"}, {"keyframes", kRight}, {"first [s]", kRight}, {"last [s]", kRight}});
  for (const SessionSummary& session : sessions) {
    const bool has_stamps = session.num_keyframes > 0;
    table.AddRow({session.name, fmt::format("{}", session.num_keyframes),
                  has_stamps ? FormatStamp(session.first) : "-",
                  has_stamps ? FormatStamp(session.last) : "-"});
  }
  fmt::print("\n{}", table.Text());
}

int PrintInfo(const InfoArguments& arguments) {
  const SavedMap saved = LoadMap(arguments.file);
  const std::vector<MapSummary> maps = SummariseMaps(saved.map);
  const std::uintmax_t size_bytes = fs::file_size(arguments.file);
  if (arguments.json) {
    fmt::print("{}", FormatMapInfo(saved, size_bytes));
    return kExitOk;
  }
  TextTable table;
  table.AddRow({"file", arguments.file.string()});
  table.AddRow({"size", fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(size_bytes))});
  table.AddRow({"format", fmt::format("{}", saved.info.version)});
  table.AddRow({"written by", saved.info.program});
  table.AddRow({"created", saved.info.created.empty() ? "-" : saved.info.created});
  table.AddRow({"camera", CameraText(saved.info.camera)});
  table.AddRow({"maps", fmt::format("{}", maps.size())});
  table.AddRow({"keyframes", fmt::format("{}", saved.map.num_keyframes())});
  table.AddRow({"points", fmt::format("{}", saved.map.num_points())});
  table.AddRow({"objects", fmt::format("{}", saved.map.Objects().size())});
  table.AddRow({"loops", fmt::format("{}", saved.map.loops().size())});
  fmt::print("{}", table.Text());
  PrintMaps(maps);
  PrintSessions(SummariseSessions(saved));
  return kExitOk;
}

// The one asked for, else the largest; says so where there are others.
MapId ChooseMap(const ExportArguments& arguments, const std::vector<MapSummary>& maps) {
  if (!arguments.map_id) {
    const MapId largest = LargestMapOf(maps);
    if (maps.size() > 1) {
      fmt::print(stderr, "map {} of {} maps is the largest; --map-id chooses another\n",
                 largest.value(), maps.size());
    }
    return largest;
  }
  const MapId id(*arguments.map_id);
  std::string known;
  for (const MapSummary& map : maps) {
    if (map.map == id) return id;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", map.map.value());
  }
  throw UsageError(fmt::format("there is no map {} in '{}', but {}", id.value(),
                               arguments.file.string(), known.empty() ? "none" : known));
}

std::vector<ColoredPoint> MakeCloud(const ExportArguments& arguments, const SavedMap& saved,
                                    MapId map) {
  if (!arguments.dense) return SparseCloud(saved.map, map);
  return DenseCloud(saved.map, map, saved.info.camera.camera, arguments.dense_options);
}

void ExportCloud(const ExportArguments& arguments, const SavedMap& saved, MapId map) {
  const std::vector<ColoredPoint> cloud = MakeCloud(arguments, saved, map);
  if (arguments.out.extension() == ".pcd") {
    WritePcd(arguments.out, cloud);
  } else {
    WritePointCloud(arguments.out, cloud, saved.info.program + ", metres");
  }
  fmt::print(stderr, "{} points in '{}'\n", cloud.size(), arguments.out.string());
}

void ExportTrajectory(const ExportArguments& arguments, const SavedMap& saved, MapId map) {
  const Trajectory trajectory = KeyframeTrajectory(saved.map, map);
  WriteTrajectory(arguments.out, trajectory,
                  "keyframes: timestamp tx ty tz qx qy qz qw (seconds, metres, camera to world)");
  fmt::print(stderr, "{} keyframes in '{}'\n", trajectory.size(), arguments.out.string());
}

void ExportGrid(const ExportArguments& arguments, const SavedMap& saved, MapId map) {
  const OccupancyGridOptions options = LoadSlamOptions(arguments.config).grid;
  const auto grid = BuildOccupancyGrid(saved.map, map, saved.info.camera.camera,
                                       AbsentObjects(saved.map, map), options);
  if (!grid) {
    throw Error("there is no depth in map {} of '{}' to draw a grid of", map.value(),
                arguments.file.string());
  }
  WriteOccupancyGrid(arguments.grid, *grid);
  fmt::print(stderr, "{} x {} cells of {} m in '{}'{}\n", grid->width, grid->height,
             grid->resolution_m, arguments.grid.string(),
             grid->has_floor ? "" : "; no floor was seen, its height is assumed");
}

void CheckExport(const ExportArguments& arguments) {
  const fs::path& grid = arguments.grid;
  if (!grid.empty() && grid.extension() != ".yaml") {
    throw UsageError(fmt::format("--grid '{}' must end in .yaml", grid.string()));
  }
  if (arguments.out.empty()) {
    if (grid.empty()) throw UsageError("say what to write: --out FILE, --grid FILE, or both");
    if (arguments.dense) throw UsageError("--dense makes a cloud: --out with .ply or .pcd");
    return;
  }
  const std::string kind = arguments.out.extension().string();
  const bool is_cloud = kind == ".ply" || kind == ".pcd";
  if (!is_cloud && kind != ".txt" && kind != ".json") {
    throw UsageError(
        fmt::format("--out '{}' must end in .ply, .pcd, .txt or .json", arguments.out.string()));
  }
  if (arguments.dense && !is_cloud) throw UsageError("--dense makes a cloud: .ply or .pcd");
  if (arguments.map_id && kind == ".json") throw UsageError(".json holds all maps, no --map-id");
}

int Export(const ExportArguments& arguments) {
  CheckExport(arguments);
  const SavedMap saved = LoadMap(arguments.file);
  const std::string kind = arguments.out.extension().string();
  if (kind == ".json") {
    WriteMapJson(arguments.out, saved);
    fmt::print(stderr, "{} keyframes and {} points in '{}'\n", saved.map.num_keyframes(),
               saved.map.num_points(), arguments.out.string());
    if (arguments.grid.empty()) return kExitOk;
  }
  const MapId map = ChooseMap(arguments, SummariseMaps(saved.map));
  if (!arguments.grid.empty()) ExportGrid(arguments, saved, map);
  if (kind == ".txt") {
    ExportTrajectory(arguments, saved, map);
  } else if (kind == ".ply" || kind == ".pcd") {
    ExportCloud(arguments, saved, map);
  }
  return kExitOk;
}

void AddInfo(CLI::App& group, int& exit_code) {
  CLI::App* const app = group.add_subcommand("info", "Show what is in a saved map");
  const auto arguments = std::make_shared<InfoArguments>();
  app->add_option("FILE", arguments->file, "Saved map")->required();
  app->add_flag("--json", arguments->json, "Print JSON to stdout");
  AddExamples(*app, {"map info desk.map", "map info desk.map --json"});
  app->callback([arguments, &exit_code] { exit_code = PrintInfo(*arguments); });
}

void AddExport(CLI::App& group, int& exit_code) {
  CLI::App* const app = group.add_subcommand(
      "export",
      "Write a saved map as a point cloud, a trajectory of keyframes, JSON or an occupancy grid");
  const auto arguments = std::make_shared<ExportArguments>();
  app->add_option("FILE", arguments->file, "Saved map")->required();
  app->add_option("--out", arguments->out,
                  "What to write; its name tells the kind: .ply, .pcd, .txt (TUM format), .json")
      ->type_name("FILE");
  app->add_option("--grid", arguments->grid,
                  "Where a robot may drive, as ROS' map_server reads it: FILE, a .yaml, and its "
                  ".pgm beside it")
      ->type_name("FILE");
  AddConfigArguments(*app, arguments->config);
  app->add_option("--map-id", arguments->map_id, "Which map of several; default: the largest");
  CLI::Option* const dense = app->add_flag(
      "--dense", arguments->dense, "The keyframes' depth, without people, instead of map points");
  app->add_option("--voxel", arguments->dense_options.voxel_m, "One point per cube of this side")
      ->type_name("METRES")
      ->check(CLI::Range(0.001, 10.0))
      ->capture_default_str()
      ->needs(dense);
  app->add_option("--max-depth", arguments->dense_options.max_depth_m,
                  "Leave out readings beyond this, which scatter")
      ->type_name("METRES")
      ->check(CLI::Range(0.1, 65.0))
      ->capture_default_str()
      ->needs(dense);
  AddExamples(*app,
              {"map export desk.map --out desk.ply",
               "map export desk.map --out dense.pcd --dense --voxel 0.02",
               "map export desk.map --grid desk.yaml --set grid.resolution=0.1",
               "map export desk.map --out keyframes.txt", "map export desk.map --out desk.json"});
  app->callback([arguments, &exit_code] { exit_code = Export(*arguments); });
}

}  // namespace

CLI::App* AddMapCommand(CLI::App& root, int& exit_code) {
  CLI::App* const app = root.add_subcommand("map", "Saved maps: info, export");
  app->require_subcommand(1);
  AddInfo(*app, exit_code);
  AddExport(*app, exit_code);
  AddExamples(*app, {"map info desk.map", "map export desk.map --out desk.ply"});
  return app;
}

}  // namespace cslam
