// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/sim/scene_builder.h"

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace cslam {

// COCO class indices of what stands in the rooms.
enum CocoClass {
  kCocoCup = 41,
  kCocoChair = 56,
  kCocoCouch = 57,
  kCocoTv = 62,
  kCocoKeyboard = 66,
  kCocoBook = 73
};

// Furnishes a scene. Every piece stands on the point of its pose (bottom centre), its front
// towards -y of the pose; sizes in metres (width, depth, height).
class Furnisher {
 public:
  Furnisher(SceneBuilder& scene, double texels_per_m);

  void Desk(const Se3& T_world_desk, double width_m);
  void Monitor(const Se3& T_world_monitor, double width_m);
  void Keyboard(const Se3& T_world_keyboard);
  void Shelf(const Se3& T_world_shelf, const Eigen::Vector3d& size_m, int levels);
  void Cabinet(const Se3& T_world_cabinet, const Eigen::Vector3d& size_m, int drawers);
  void Sofa(const Se3& T_world_sofa, double width_m);
  void Chair(const Se3& T_world_chair);
  void Table(const Se3& T_world_table, const Eigen::Vector3d& size_m);
  void Carton(const Se3& T_world_carton, const Eigen::Vector3d& size_m);
  void Package(const Se3& T_world_package, const Eigen::Vector3d& size_m);
  void Page(const Se3& T_world_page);
  void BookPile(const Se3& T_world_pile, int num_books);
  void Cup(const Se3& T_world_cup);

  // Random small things on a rectangle of the given size around the pose.
  void Clutter(const Se3& T_world_surface, double width_m, double depth_m, int count);

  // Something flat on a wall, its bottom centre at the pose, 15 mm thick.
  void OnWall(const char* name, const Se3& T_world_item, double width_m, double height_m,
              const cv::Mat& image);

 private:
  void Books(const Se3& T_world_board, double width_m, double height_m, double depth_m);
  int Picture(const cv::Mat& image) { return scene_.AddPicture(image); }
  int AnyWood();
  cv::Size Texels(double width_m, double height_m) const;

  SceneBuilder& scene_;
  double texels_per_m_;
  std::vector<int> woods_;
  int paper_ = 0;
  int metal_ = 0;
  int dark_ = 0;
};

}  // namespace cslam
