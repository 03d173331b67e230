// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/navigation/occupancy_grid.h"

#include "cslam/navigation/layered_cells.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr int kRayStepPx = 2;  // neighbouring rays pass through the same cells
constexpr int kStandingLayers = 2;
constexpr double kFlattestSine =
    0.1;                             // of a ray to the surface; the sines of flatter ones are noise
constexpr double kMaxCells = 150e6;  // two bytes each

double LogOdds(double probability) {
  return std::log(probability / (1.0 - probability));
}

// z up from the floor below the world's origin, x along the world's z as far as it is level.
Se3 GridFromWorld(const Floor& floor) {
  const Eigen::Vector3d& up = floor.up_world;
  Eigen::Vector3d forward = Eigen::Vector3d::UnitZ() - up.z() * up;
  if (forward.norm() < 0.1)
    forward = Eigen::Vector3d::UnitX() - up.x() * up;  // looks straight down
  forward.normalize();
  Eigen::Matrix3d R_grid_world;
  R_grid_world << forward.transpose(), up.cross(forward).transpose(), up.transpose();
  return {Eigen::Quaterniond(R_grid_world), Eigen::Vector3d(0.0, 0.0, -floor.offset_m)};
}

struct Reading {
  Eigen::Vector3d p_grid;
  bool is_ray = false;  // of the lattice along which rays are cast
  bool is_gone = false;
  // How far before its end a ray stops to tell anything: from there on it runs within a layer of
  // the surface it meets, as over a table it sees at a flat angle.
  double unclear_m = 0.0;
};

// Reads the depth of keyframes into the grid frame.
class Reader {
 public:
  Reader(const PixelRays& rays, const Se3& T_grid_world, std::span<const ClearedRegion> cleared,
         const OccupancyGridOptions& options)
      : rays_(rays), T_grid_world_(T_grid_world), cleared_(cleared), options_(options) {}

  std::vector<Reading> Read(const Keyframe& keyframe) const {
    const cv::Mat& depth_mm = keyframe.data->depth_small_mm;
    const Se3 T_grid_camera = T_grid_world_ * keyframe.T_world_camera;
    const Eigen::Matrix3d R_grid_camera = T_grid_camera.R();
    const std::vector<Box> gone = BoxesGone(keyframe.id);
    std::vector<Reading> readings;
    readings.reserve(depth_mm.total());
    for (int v = 0; v < depth_mm.rows; ++v) {
      const auto* row = depth_mm.ptr<std::uint16_t>(v);
      for (int u = 0; u < depth_mm.cols; ++u) {
        const double depth_m = 1e-3 * row[u];
        if (depth_m <= 0.0 || depth_m > options_.max_depth_m) continue;
        const Eigen::Vector3d p_grid =
            R_grid_camera * (depth_m * rays_.At(u, v)) + T_grid_camera.translation;
        const bool is_ray = u % kRayStepPx == 0 && v % kRayStepPx == 0;
        const double sine = is_ray ? std::max(SineToSurface(depth_mm, u, v), kFlattestSine) : 1.0;
        readings.push_back({.p_grid = p_grid,
                            .is_ray = is_ray,
                            .is_gone = IsInAny(gone, p_grid),
                            .unclear_m = options_.layer_m / sine});
      }
    }
    return readings;
  }

  Eigen::Vector3d Camera(const Keyframe& keyframe) const {
    return T_grid_world_ * keyframe.T_world_camera.translation;
  }

 private:
  // Of the angle between a pixel's ray and the surface it meets; 1 where its neighbours do not
  // tell.
  double SineToSurface(const cv::Mat& depth_mm, int u, int v) const {
    if (u < 1 || v < 1 || u + 1 >= depth_mm.cols || v + 1 >= depth_mm.rows) return 1.0;
    bool has_all = true;
    const auto point = [&](int at_u, int at_v) {
      const double depth_m = 1e-3 * depth_mm.at<std::uint16_t>(at_v, at_u);
      has_all = has_all && depth_m > 0.0;
      return Eigen::Vector3d(depth_m * rays_.At(at_u, at_v));
    };
    const Eigen::Vector3d right = point(u + 1, v) - point(u - 1, v);
    const Eigen::Vector3d down = point(u, v + 1) - point(u, v - 1);
    const Eigen::Vector3d normal = right.cross(down).normalized();
    return has_all ? std::abs(normal.dot(rays_.At(u, v).normalized())) : 1.0;
  }

  struct Box {
    Se3 T_box_grid;
    Eigen::Array3d half_m;
  };

  std::vector<Box> BoxesGone(KeyframeId keyframe) const {
    std::vector<Box> boxes;
    for (const ClearedRegion& region : cleared_) {
      if (region.last_seen.valid() && keyframe > region.last_seen) continue;
      boxes.push_back({.T_box_grid = (T_grid_world_ * region.T_world_box).Inverse(),
                       .half_m = 0.5 * region.size_m.array() + options_.region_margin_m});
    }
    return boxes;
  }

  static bool IsInAny(const std::vector<Box>& boxes, const Eigen::Vector3d& p_grid) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
      return ((box.T_box_grid * p_grid).array().abs() <= box.half_m).all();
    });
  }

  const PixelRays& rays_;
  const Se3 T_grid_world_;
  const std::span<const ClearedRegion> cleared_;
  const OccupancyGridOptions& options_;
};

// The lowest layer is that of the floor, up to where obstacles begin.
LayeredCells MakeCells(const std::vector<const Keyframe*>& keyframes, const Reader& reader,
                       const OccupancyGridOptions& options) {
  Eigen::AlignedBox3d extent;
  for (const Keyframe* keyframe : keyframes) {
    extent.extend(reader.Camera(*keyframe));
    for (const Reading& reading : reader.Read(*keyframe))
      extent.extend(reading.p_grid);
  }
  const double side_m = options.resolution_m;
  const Eigen::Array2d low = (extent.min().head<2>().array() / side_m).floor();
  const Eigen::Array2d size = (extent.max().head<2>().array() / side_m).floor() - low + 1.0;
  const double layers =
      1.0 +
      std::max(1.0,
               std::ceil((options.max_height_m - options.min_height_m) / options.layer_m - 1e-9));
  if (!(size.prod() * layers < kMaxCells)) {
    throw Error(
        "a grid of {:.0f} x {:.0f} m does not fit in memory with cells of {} m; raise "
        "grid.resolution",
        size.x() * side_m, size.y() * side_m, side_m);
  }
  const LayeredCells::Shape shape{
      .corner_m = {low.x() * side_m, low.y() * side_m, options.min_height_m - options.layer_m},
      .size = {static_cast<int>(size.x()), static_cast<int>(size.y()), static_cast<int>(layers)},
      .cell_m = {side_m, side_m, options.layer_m}};
  return {shape,
          {.hit = LogOdds(options.hit_probability),
           .miss = LogOdds(options.miss_probability),
           .limit = LogOdds(options.max_belief),
           .min_readings = options.min_readings}};
}

void Cast(const std::vector<Reading>& readings, const Eigen::Vector3d& camera,
          const OccupancyGridOptions& options, LayeredCells& cells) {
  for (const Reading& reading : readings) {
    if (reading.p_grid.z() >= options.min_height_m && !reading.is_gone) {
      cells.AddHit(reading.p_grid);
    }
  }
  for (const Reading& reading : readings) {
    if (!reading.is_ray) continue;
    const Eigen::Vector3d way = reading.p_grid - camera;
    const double clear_share = 1.0 - reading.unclear_m / way.norm();
    if (clear_share > 0.0) cells.AddRay(camera, camera + clear_share * way);
    const bool is_floor = std::abs(reading.p_grid.z()) < options.min_height_m;
    if (!is_floor) continue;
    const double in_floor_layer_m = options.min_height_m - 0.5 * options.layer_m;
    cells.AddFree({reading.p_grid.x(), reading.p_grid.y(), in_floor_layer_m});
  }
  cells.Apply();
}

// Occupied where any layer is. Free where one can stand: what is free above a table says nothing,
// so it must be the floor's layer or the one over it.
CellState StateOf(const LayeredCells& cells, int x, int y, const OccupancyGridOptions& options) {
  const double occupied = LogOdds(options.occupied_belief);
  const double free = LogOdds(options.free_belief);
  bool is_free = false;
  for (int z = 0; z < cells.shape().size.z(); ++z) {
    const double log_odds = cells.At(x, y, z);
    if (log_odds >= occupied) return CellState::kOccupied;
    is_free = is_free || (z < kStandingLayers && log_odds <= free);
  }
  return is_free ? CellState::kFree : CellState::kUnknown;
}

OccupancyGrid Project(const LayeredCells& cells, const OccupancyGridOptions& options) {
  OccupancyGrid grid;
  grid.resolution_m = options.resolution_m;
  grid.width = cells.shape().size.x();
  grid.height = cells.shape().size.y();
  grid.origin_m = cells.shape().corner_m.head<2>();
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x)
      grid.cells.push_back(StateOf(cells, x, y, options));
  }
  return grid;
}

}  // namespace

void Describe(OptionList& list, OccupancyGridOptions& o) {
  list.Add("resolution", o.resolution_m, {0.01, 1.0}, "m", "Side of a cell.");
  list.Add("layer", o.layer_m, {0.02, 1.0}, "m",
           "Cells are counted in layers so thick: what is seen over a table does not clear it.");
  list.Add("min_height", o.min_height_m, {0.01, 2.0}, "m",
           "Lowest obstacle above the floor; less is noise, or can be driven over.");
  list.Add("max_height", o.max_height_m, {0.02, 10.0}, "m",
           "What hangs above this is passed under.");
  list.Add("max_depth", o.max_depth_m, {0.1, 65.0}, "m",
           "Farther readings are left out: those of structured light scatter over cells.");
  list.Add("hit", o.hit_probability, {0.51, 0.99}, "",
           "Belief that a cell is occupied after one keyframe with readings in it.");
  list.Add("miss", o.miss_probability, {0.01, 0.49}, "",
           "The same after one whose rays only pass through.");
  list.Add("max_belief", o.max_belief, {0.6, 0.998}, "",
           "Many readings amount to this at most, so that a change is learned within a few more.");
  list.Add("occupied", o.occupied_belief, {0.5, 0.99}, "",
           "A cell is occupied from this belief on: two hits, as one may be a stray reading.");
  list.Add("free", o.free_belief, {0.01, 0.5}, "", "... and free up to this one: two rays.");
  list.Add("min_readings", o.min_readings, {1, 100}, "px",
           "Readings of a keyframe in one cell that make a hit; edges scatter single ones.");
  list.Add("region_margin", o.region_margin_m, {0.0, 1.0}, "m",
           "Around objects that are gone, what was read is left out as well: depth noise.");
  list.Group("floor", o.floor);
}

CellState OccupancyGrid::At(const Eigen::Vector2d& p_grid) const {
  const Eigen::Vector2d cell = ((p_grid - origin_m) / resolution_m).array().floor();
  if (!(cell.x() >= 0.0 && cell.y() >= 0.0 && cell.x() < width && cell.y() < height)) {
    return CellState::kUnknown;
  }
  return cells[static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(cell.x())];
}

std::vector<ClearedRegion> AbsentObjects(const MapView& map, MapId map_id) {
  std::vector<ClearedRegion> regions;
  for (const ObjectId id : map.Objects()) {
    const MapObject& object = map.ObjectSlot(id.index());
    if (object.map != map_id || object.state != ObjectState::kAbsent) continue;
    const auto T_world_reference = map.T_world_keyframe(object.reference);
    if (!T_world_reference) continue;
    regions.push_back(
        {.T_world_box = *T_world_reference * Se3(object.box.rotation, object.box.center),
         .size_m = object.box.size_m,
         .last_seen = object.last_keyframe});
  }
  return regions;
}

std::optional<OccupancyGrid> BuildOccupancyGrid(const MapView& map, MapId map_id,
                                                const Camera& camera,
                                                std::span<const ClearedRegion> cleared,
                                                const OccupancyGridOptions& options) {
  const std::vector<const Keyframe*> keyframes = KeyframesWithDepth(map, map_id);
  if (keyframes.empty()) return std::nullopt;
  const PixelRays rays(camera, keyframes.front()->data->depth_small_mm.size());
  const Floor floor = EstimateFloor(keyframes, rays, options.max_depth_m, options.floor);
  const Se3 T_grid_world = GridFromWorld(floor);
  const Reader reader(rays, T_grid_world, cleared, options);
  LayeredCells cells = MakeCells(keyframes, reader, options);
  for (const Keyframe* keyframe : keyframes)
    Cast(reader.Read(*keyframe), reader.Camera(*keyframe), options, cells);
  OccupancyGrid grid = Project(cells, options);
  grid.T_grid_world = T_grid_world;
  grid.has_floor = floor.is_seen;
  return grid;
}

}  // namespace cslam
