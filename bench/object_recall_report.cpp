// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Which things of rendered sequences detectors find, and what they see that is not there. Prints
// two Markdown tables; folders whose names differ only in what follows the last '-' are one row:
//
//   recall: of each object of a COCO class, over the views in which it is large and not mostly
//           hidden
//   false:  what fixed things (posters, furniture) are taken for
//
//   cslam_object_recall_report --models MODEL... --rendered FOLDER...
#include "cslam/dataset/truth_lookup.h"
#include "cslam/io/dataset.h"
#include "cslam/io/instance_image.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/io/truth_files.h"
#include "cslam/semantics/coco.h"
#include "cslam/semantics/dnn_detector.h"
#include "cslam/semantics/model_store.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace cslam {
namespace {

namespace fs = std::filesystem;

constexpr double kMinPictureShare = 0.02;  // of an object that counts
constexpr double kMinSeenShare = 0.5;      // of the object's box as if nothing hid it
constexpr double kMinIou = 0.5;            // of a box that counts as found
constexpr double kMinFalseIou = 0.3;       // with the thing that was taken for something else
constexpr double kNearM = 0.05;            // nearer corners cannot be projected

struct Share {
  std::size_t num_views = 0;
  std::vector<std::size_t> num_found;  // by model
};
struct Tables {
  std::map<std::tuple<std::string, std::string>, Share> recall;  // by story and object
  std::map<std::tuple<std::string, std::string>, std::size_t> views;
  std::map<std::tuple<std::string, std::string, std::string>, Share> mistakes;  // and class
};

std::string StoryOf(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name.substr(0, name.rfind('-'));
}

// Around the object's box as if nothing hid it; empty if part of it is beside the camera.
Box Outline(const TrueObject& object, const Se3& T_camera_object, const Camera& camera) {
  Box box{1e9, 1e9, -1e9, -1e9};
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d side((corner & 1) - 0.5, ((corner >> 1) & 1) - 0.5, (corner >> 2) - 0.5);
    const Eigen::Vector3d p =
        T_camera_object * (object.box_center + side.cwiseProduct(object.box_size_m));
    if (p.z() < kNearM) return {};
    const Eigen::Vector2d uv = Project(camera, p);
    box = {std::min(box.x_min, uv.x()), std::min(box.y_min, uv.y()), std::max(box.x_max, uv.x()),
           std::max(box.y_max, uv.y())};
  }
  return box;
}

// Boxes and pixels of all instances of an image.
struct SeenThing {
  Box box{1e9, 1e9, -1e9, -1e9};
  int num_px = 0;
};
std::map<int, SeenThing> ThingsIn(const cv::Mat& instances) {
  std::map<int, SeenThing> things;
  for (int y = 0; y < instances.rows; ++y) {
    for (int x = 0; x < instances.cols; ++x) {
      SeenThing& thing = things[instances.at<std::uint16_t>(y, x)];
      ++thing.num_px;
      thing.box = {std::min(thing.box.x_min, 1.0 * x), std::min(thing.box.y_min, 1.0 * y),
                   std::max(thing.box.x_max, x + 1.0), std::max(thing.box.y_max, y + 1.0)};
    }
  }
  things.erase(0);  // the room
  return things;
}

class Folder {
 public:
  Folder(const fs::path& folder, Tables& tables, std::size_t num_models)
      : folder_(folder),
        tables_(tables),
        num_models_(num_models),
        dataset_(OpenDataset(folder)),
        objects_(ReadTrueObjects(folder / "objects.json")),
        truth_(ReadDetections(folder / "detections.json")),
        path_(ReadTrajectory(folder / "groundtruth.txt")) {
    if (path_.size() != dataset_->size() || truth_.frames.size() != dataset_->size())
      throw Error("'{}' has more or fewer frames than poses or detections", folder.string());
  }

  void Add(std::vector<std::unique_ptr<DnnDetector>>& detectors) {
    for (std::size_t i = 0; i < dataset_->size(); ++i) {
      const LoadResult loaded = dataset_->Load(i);
      if (!loaded.frame) throw Error("{}", loaded.problem);
      std::vector<Detections> found;
      for (const auto& detector : detectors)
        found.push_back(detector->Detect(*loaded.frame));
      AddRecall(i, found);
      AddMistakes(i, found);
    }
  }

 private:
  std::string NameOf(int instance) const {
    const TrueObject* object = FindObject(objects_, instance);
    return object == nullptr ? "?" : object->name;
  }

  bool IsWellSeen(const RecordedDetection& seen, std::size_t frame) const {
    const Camera& camera = dataset_->camera().camera;
    if (seen.visible_px < kMinPictureShare * camera.width * camera.height) return false;
    const TrueObject* object = FindObject(objects_, seen.instance);
    if (object == nullptr) return false;
    if (object->is_deformable) return true;
    const Placement state = StateAt(*object, TimeOf(objects_, truth_.frames[frame].stamp));
    const Box whole =
        Outline(*object, path_[frame].T_world_camera.Inverse() * state.T_world_object, camera);
    return !whole.empty() && seen.box.area() >= kMinSeenShare * whole.area();
  }

  void AddRecall(std::size_t frame, const std::vector<Detections>& found) {
    for (const RecordedDetection& seen : truth_.frames[frame].detections) {
      if (seen.class_id < 0 || !IsWellSeen(seen, frame)) continue;
      Share& share = tables_.recall[{StoryOf(folder_), NameOf(seen.instance)}];
      ++share.num_views;
      share.num_found.resize(num_models_);
      for (std::size_t m = 0; m < num_models_; ++m)
        share.num_found[m] +=
            static_cast<std::size_t>(std::ranges::any_of(found[m].objects, [&](const Detection& d) {
              return d.class_id == seen.class_id && Iou(d.box, seen.box) >= kMinIou;
            }));
    }
  }

  // The fixed thing that a wrong detection shows; 0 if none.
  int Mistaken(const Detection& d, std::size_t frame,
               const std::map<int, SeenThing>& things) const {
    for (const RecordedDetection& seen : truth_.frames[frame].detections)
      if (seen.class_id == d.class_id && Iou(d.box, seen.box) >= kMinFalseIou) return 0;
    double best = kMinFalseIou;
    int result = 0;
    for (const auto& [instance, thing] : things) {
      if (Iou(thing.box, d.box) < best) continue;
      best = Iou(thing.box, d.box);
      result = instance;
    }
    return result;
  }

  void AddMistakes(std::size_t frame, const std::vector<Detections>& found) {
    const std::string stamp = FormatStamp(truth_.frames[frame].stamp);
    const std::map<int, SeenThing> things =
        ThingsIn(ReadInstanceImage(folder_ / "instances" / (stamp + ".png")));
    const Camera& camera = dataset_->camera().camera;
    for (const auto& [instance, thing] : things)
      if (thing.num_px >= kMinPictureShare * camera.width * camera.height)
        ++tables_.views[{StoryOf(folder_), NameOf(instance)}];
    for (std::size_t m = 0; m < num_models_; ++m) {
      for (const Detection& d : found[m].objects) {
        const int instance = Mistaken(d, frame, things);
        if (instance == 0) continue;
        Share& share = tables_.mistakes[{StoryOf(folder_), NameOf(instance),
                                         std::string(CocoClassName(d.class_id))}];
        share.num_found.resize(num_models_);
        ++share.num_found[m];
      }
    }
  }

  fs::path folder_;
  Tables& tables_;
  std::size_t num_models_;
  std::unique_ptr<DatasetReader> dataset_;
  TrueObjects objects_;
  DetectionRecord truth_;
  Trajectory path_;
};

void Print(const Tables& tables, const std::vector<std::string>& models) {
  fmt::print("| story | object | views | {} |\n|---|---|---|{}\n", fmt::join(models, " | "),
             fmt::join(std::vector<std::string>(models.size(), "---|"), ""));
  for (const auto& [key, share] : tables.recall) {
    fmt::print("| {} | {} | {} |", std::get<0>(key), std::get<1>(key), share.num_views);
    for (const std::size_t count : share.num_found)
      fmt::print(" {:.0f} % |",
                 100.0 * static_cast<double>(count) / static_cast<double>(share.num_views));
    fmt::print("\n");
  }
  fmt::print("\n| story | thing | large in views | taken for | {} |\n|---|---|---|---|{}\n",
             fmt::join(models, " | "),
             fmt::join(std::vector<std::string>(models.size(), "---|"), ""));
  for (const auto& [key, share] : tables.mistakes) {
    const auto& [story, thing, taken_for] = key;
    const auto views = tables.views.find({story, thing});
    fmt::print("| {} | {} | {} | {} |", story, thing,
               views == tables.views.end() ? 0 : views->second, taken_for);
    for (const std::size_t count : share.num_found)
      fmt::print(" {} |", count);
    fmt::print("\n");
  }
}

int Run(const std::vector<std::string>& words) {
  std::map<std::string, std::vector<std::string>> values;
  std::string option;
  for (const std::string& word : words) {
    if (word.starts_with("--"))
      option = word;
    else
      values[option].push_back(word);
  }
  const std::vector<std::string>& models = values["--models"];
  const std::vector<std::string>& folders = values["--rendered"];
  if (models.empty() || folders.empty())
    throw Error("models or folders missing; see the top of bench/object_recall_report.cpp");
  std::vector<std::unique_ptr<DnnDetector>> detectors;
  for (const std::string& model : models)
    detectors.push_back(std::make_unique<DnnDetector>(FindModel(model, ModelFolders())));
  Tables tables;
  for (const std::string& folder : folders)
    Folder(folder, tables, models.size()).Add(detectors);
  Print(tables, models);
  return 0;
}

}  // namespace
}  // namespace cslam

int main(int argc, char** argv) {
  try {
    return cslam::Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "cslam_object_recall_report: error: {}\n", error.what());
    return 2;
  }
}
