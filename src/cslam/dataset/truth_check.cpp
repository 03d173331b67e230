// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/truth_check.h"

#include "cslam/dataset/truth_lookup.h"
#include "cslam/io/dataset_info.h"

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cslam {
namespace {

constexpr std::size_t kMaxListed = 5;        // of one kind of finding
constexpr double kBoxMarginM = 0.005;        // rounding of depth, of boxes and of meshes' corners
constexpr double kMovingMarginM = 0.03;      // poses of moving objects are samples
constexpr double kMarginTolerances = 3.0;    // of depth
constexpr int kMinPosedPixels = 20;          // fewer say nothing about a share
constexpr std::int64_t kSameStampNs = 1000;  // stamps are whole microseconds

// Series of findings by kind, so that one kind does not hide the others.
struct Series {
  Findings images;
  Findings unknown;
  Findings presence;
  Findings regions;
  Findings classes;
  Findings places;
};

class TruthChecker {
 public:
  TruthChecker(const CheckFrames& frames, const SequenceTruth& truth,
               const TruthCheckOptions& options)
      : frames_(frames), truth_(truth), options_(options) {}

  TruthCheckResult Run() {
    CheckClasses();
    CheckStamps();
    if (frames_.has_instances()) {
      const std::size_t count = options_.num_samples.value_or(frames_.size());
      for (const std::size_t i : EvenSample(frames_.size(), count))
        CheckFrame(i);
    }
    AppendShortened(result_.errors, series_.images, "instance images that cannot be used");
    AppendShortened(result_.errors, series_.unknown, "unknown instances");
    AppendShortened(result_.errors, series_.presence, "instances seen while away");
    AppendShortened(result_.errors, series_.regions, "wrong detections");
    AppendShortened(result_.errors, series_.classes, "wrong classes");
    AppendShortened(result_.errors, series_.places, "objects outside their boxes");
    return result_;
  }

 private:
  void CheckClasses() {
    if (!truth_.detections || !truth_.objects) return;
    std::map<int, int> told;  // so that one wrong object is told once
    for (std::size_t i = 0; i < truth_.detections->frames.size(); ++i) {
      for (const RecordedDetection& d : truth_.detections->frames[i].detections) {
        const TrueObject* object = FindObject(*truth_.objects, d.instance);
        const int expected = object != nullptr ? object->class_id : kNoClass;
        if (expected == d.class_id || !told.emplace(d.instance, d.class_id).second) continue;
        series_.classes.push_back(fmt::format(
            "detections.json, frame {}: instance {} has class {}, but {} in objects.json", i,
            d.instance, d.class_id, object != nullptr ? std::to_string(expected) : "is not"));
      }
    }
  }

  void CheckStamps() {
    if (!truth_.detections) return;
    const auto& recorded = truth_.detections->frames;
    if (recorded.size() != frames_.size()) {
      series_.regions.push_back(fmt::format("detections.json has {} frames, but the sequence {}",
                                            recorded.size(), frames_.size()));
    }
    for (std::size_t i = 0; i < std::min(recorded.size(), frames_.size()); ++i) {
      if (std::abs(recorded[i].stamp.ns - frames_.stamp(i).ns) <= kSameStampNs) continue;
      series_.regions.push_back(
          fmt::format("detections.json, frame {}: stamp {}, but the image's is {}", i,
                      FormatStamp(recorded[i].stamp), FormatStamp(frames_.stamp(i))));
      return;  // all later ones are shifted, too
    }
  }

  void CheckFrame(std::size_t i) {
    const cv::Mat instances = frames_.Instances(i);
    const Camera& camera = frames_.camera();
    if (instances.empty()) {
      series_.images.push_back(
          fmt::format("frame {}: the instance image is missing or cannot be read", i));
      return;
    }
    if (instances.cols != camera.width || instances.rows != camera.height) {
      series_.images.push_back(fmt::format("frame {}: the instance image is {}x{}, not {}x{}", i,
                                           instances.cols, instances.rows, camera.width,
                                           camera.height));
      return;
    }
    const std::map<int, VisibleRegion> regions = VisibleRegions(instances);
    ++result_.num_frames;
    result_.num_regions += regions.size();
    if (truth_.objects) CheckPresence(i, regions);
    if (truth_.detections) CheckRegions(i, regions);
    if (truth_.objects) CheckPlaces(i, instances, regions);
  }

  void CheckPresence(std::size_t i, const std::map<int, VisibleRegion>& regions) {
    const double time_s = TimeOf(*truth_.objects, frames_.stamp(i));
    for (const auto& [instance, region] : regions) {
      const TrueObject* object = FindObject(*truth_.objects, instance);
      if (object == nullptr) {
        series_.unknown.push_back(
            fmt::format("frame {}: instance {} is seen, but not in objects.json", i, instance));
      } else if (!IsAtBoundary(*object, time_s) &&
                 StateAt(*object, time_s).presence == Presence::kAway) {
        series_.presence.push_back(fmt::format(
            "frame {} ({:.3f} s): '{}' (instance {}) is seen while objects.json has it away", i,
            time_s, object->name, instance));
      }
    }
  }

  // Whether detections.json must have the instance: those of no class are left out there.
  bool IsDetectable(int instance) const {
    if (!truth_.objects) return true;
    const TrueObject* object = FindObject(*truth_.objects, instance);
    return object != nullptr && object->class_id >= 0;
  }

  void CheckRegions(std::size_t i, const std::map<int, VisibleRegion>& regions) {
    if (i >= truth_.detections->frames.size()) return;
    std::map<int, VisibleRegion> missing = regions;
    for (const RecordedDetection& d : truth_.detections->frames[i].detections) {
      const auto seen = regions.find(d.instance);
      missing.erase(d.instance);
      if (seen == regions.end()) {
        series_.regions.push_back(fmt::format(
            "frame {}: instance {} is in detections.json, but not in the image", i, d.instance));
      } else if (!(seen->second.box == d.box)) {
        series_.regions.push_back(
            fmt::format("frame {}: the box of instance {} is {}, but detections.json says {}", i,
                        d.instance, TextOf(seen->second.box), TextOf(d.box)));
      } else if (seen->second.num_px != d.visible_px) {
        series_.regions.push_back(fmt::format(
            "frame {}: {} pixels of instance {} are visible, but detections.json says {}", i,
            seen->second.num_px, d.instance, d.visible_px));
      }
    }
    for (const auto& [instance, region] : missing) {
      if (!truth_.objects || !IsDetectable(instance)) continue;
      series_.regions.push_back(fmt::format(
          "frame {}: instance {} is in the image, but not in detections.json", i, instance));
    }
  }

  static std::string TextOf(const Box& box) {
    return fmt::format("[{:g} {:g} {:g} {:g}]", box.x_min, box.y_min, box.x_max, box.y_max);
  }

  void CheckPlaces(std::size_t i, const cv::Mat& instances,
                   const std::map<int, VisibleRegion>& regions) {
    const std::optional<Se3> T_world_camera = frames_.T_world_camera(i);
    if (!T_world_camera || regions.empty()) return;
    const cv::Mat depth_m = frames_.DepthM(i);
    if (depth_m.size() != instances.size()) return;
    const double time_s = TimeOf(*truth_.objects, frames_.stamp(i));
    for (const auto& [instance, region] : regions) {
      const TrueObject* object = FindObject(*truth_.objects, instance);
      if (object == nullptr || object->is_deformable || IsAtBoundary(*object, time_s)) continue;
      const Placement state = StateAt(*object, time_s);
      if (state.presence == Presence::kAway) continue;
      JudgePlace(i, *object, state,
                 OutsideShare(*object, state, *T_world_camera, instances, depth_m, region.box));
    }
  }

  // Share of the object's pixels whose points lie outside its box; nothing if they are too few.
  std::optional<double> OutsideShare(const TrueObject& object, const Placement& state,
                                     const Se3& T_world_camera, const cv::Mat& instances,
                                     const cv::Mat& depth_m, const Box& box) const {
    const Camera& camera = frames_.camera();
    const double margin_m =
        kBoxMarginM + (state.presence == Presence::kMoving ? kMovingMarginM : 0.0);
    int num_pixels = 0;
    int num_outside = 0;
    for (int y = static_cast<int>(box.y_min); y < static_cast<int>(box.y_max); ++y) {
      for (int x = static_cast<int>(box.x_min); x < static_cast<int>(box.x_max); ++x) {
        const auto z_m = static_cast<double>(depth_m.at<float>(y, x));
        if (instances.at<std::uint16_t>(y, x) != object.instance || !(z_m > 0.0)) continue;
        ++num_pixels;
        const Eigen::Vector2d raw(x, y);
        const Eigen::Vector2d ideal = camera.HasDistortion() ? Undistort(camera, raw) : raw;
        const Eigen::Vector3d p_world = T_world_camera * Unproject(camera, ideal, z_m);
        const double allowed_m = margin_m + kMarginTolerances * options_.tolerance.At(z_m);
        if (DistanceToBox(object, state.T_world_object, p_world) > allowed_m) ++num_outside;
      }
    }
    if (num_pixels < kMinPosedPixels) return std::nullopt;
    return static_cast<double>(num_outside) / num_pixels;
  }

  void JudgePlace(std::size_t i, const TrueObject& object, const Placement& state,
                  std::optional<double> outside_share) {
    if (!outside_share) return;
    ++result_.num_posed;
    result_.max_outside_share = std::max(result_.max_outside_share, *outside_share);
    if (*outside_share <= options_.max_outside_share) return;
    series_.places.push_back(fmt::format(
        "frame {}: {:.1f} % of the pixels of '{}' (instance {}, {}) lie outside its box in "
        "objects.json",
        i, 100.0 * *outside_share, object.name, object.instance,
        state.presence == Presence::kMoving ? "moving" : "resting"));
  }

  const CheckFrames& frames_;
  const SequenceTruth& truth_;
  const TruthCheckOptions& options_;
  TruthCheckResult result_;
  Series series_;
};

}  // namespace

std::map<int, VisibleRegion> VisibleRegions(const cv::Mat& instances) {
  struct Extent {
    int x_min = 0, y_min = 0, x_max = -1, y_max = -1;
    int num_px = 0;
  };
  std::vector<Extent> extents;
  for (int y = 0; y < instances.rows; ++y) {
    const auto* row = instances.ptr<std::uint16_t>(y);
    for (int x = 0; x < instances.cols; ++x) {
      if (row[x] == 0) continue;
      if (row[x] >= extents.size()) extents.resize(row[x] + std::size_t{1});
      Extent& extent = extents[row[x]];
      if (extent.num_px++ == 0) extent = {x, y, x, y, 1};
      extent.x_min = std::min(extent.x_min, x);
      extent.x_max = std::max(extent.x_max, x);
      extent.y_max = y;
    }
  }
  std::map<int, VisibleRegion> regions;
  for (std::size_t id = 1; id < extents.size(); ++id) {
    const Extent& e = extents[id];
    if (e.num_px == 0) continue;
    const Box box{static_cast<double>(e.x_min), static_cast<double>(e.y_min),
                  static_cast<double>(e.x_max + 1), static_cast<double>(e.y_max + 1)};
    regions.emplace(static_cast<int>(id), VisibleRegion{.box = box, .num_px = e.num_px});
  }
  return regions;
}

TruthCheckResult CheckTruth(const CheckFrames& frames, const SequenceTruth& truth,
                            const TruthCheckOptions& options) {
  return TruthChecker(frames, truth, options).Run();
}

void AppendShortened(Findings& to, const Findings& series, const std::string& what) {
  const std::size_t count = std::min(series.size(), kMaxListed);
  to.insert(to.end(), series.begin(), series.begin() + static_cast<std::ptrdiff_t>(count));
  if (series.size() > count)
    to.push_back(fmt::format("... and {} more {}", series.size() - count, what));
}

}  // namespace cslam
