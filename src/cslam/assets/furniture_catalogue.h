// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace cslam {

// What a Sweet Home 3D catalogue says about a model.
struct CatalogueEntry {
  std::string name;
  std::string creator;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();               // width, depth, height
  Eigen::Matrix3d R_upright_model = Eigen::Matrix3d::Identity();  // before all else; y is up
  std::optional<double> top_m;  // height of what things are put on
};

// The models of a PluginFurnitureCatalog.properties file, by their path in the archive
// ("/scopia/chair/chair.obj").
class FurnitureCatalogue {
 public:
  // Throws Error with file and line.
  static FurnitureCatalogue Read(const std::filesystem::path& path);

  // Throws Error that names the catalogue.
  const CatalogueEntry& Entry(std::string_view model) const;
  const std::map<std::string, CatalogueEntry, std::less<>>& entries() const { return entries_; }
  const std::string& license() const { return license_; }

 private:
  std::filesystem::path path_;
  std::string license_;
  std::map<std::string, CatalogueEntry, std::less<>> entries_;
};

}  // namespace cslam
