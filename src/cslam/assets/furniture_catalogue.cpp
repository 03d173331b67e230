// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/furniture_catalogue.h"

#include "cslam/io/text_lines.h"
#include "cslam/util/check.h"

#include <charconv>
#include <string>
#include <utility>

namespace cslam {
namespace {

constexpr double kMetresPerCentimetre = 0.01;

// Where a property stands, and its value.
struct Property {
  int line = 0;
  std::string value;
};
using Properties = std::map<std::string, Property, std::less<>>;

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path) {}

  // The properties of all models by their number, those of the catalogue under 0.
  std::map<int, Properties> ReadAll() const {
    const std::string text = ReadBytes(path_, "catalogue");
    std::map<int, Properties> result;
    int number = 0;
    std::size_t start = 0;
    while (start < text.size()) {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      const std::string_view line = Trimmed(std::string_view(text).substr(start, end - start));
      start = end + 1;
      ++number;
      const std::size_t equals = line.find('=');
      if (line.empty() || line.front() == '#' || equals == std::string_view::npos) continue;
      const std::string_view key = Trimmed(line.substr(0, equals));
      const std::size_t hash = key.find('#');
      const int model = hash == std::string_view::npos
                            ? 0
                            : static_cast<int>(Number(key.substr(hash + 1), number));
      result[model][std::string(key.substr(0, hash))] = {
          number, std::string(Trimmed(line.substr(equals + 1)))};
    }
    return result;
  }

  CatalogueEntry MakeEntry(const Properties& properties) const {
    CatalogueEntry entry;
    const auto text = [&](std::string_view key) {
      const auto found = properties.find(key);
      return found == properties.end() ? std::string() : found->second.value;
    };
    entry.name = text("name");
    entry.creator = text("creator");
    const double width_cm = Length(properties, "width");
    const double depth_cm = Length(properties, "depth");
    const double height_cm = Length(properties, "height");
    entry.size_m = kMetresPerCentimetre * Eigen::Vector3d(width_cm, depth_cm, height_cm);
    if (const auto found = properties.find("dropOnTopElevation"); found != properties.end()) {
      const double top_cm = Number(found->second.value, found->second.line);
      if (top_cm > 0.0) entry.top_m = kMetresPerCentimetre * top_cm;
    }
    if (const auto found = properties.find("modelRotation"); found != properties.end())
      entry.R_upright_model = Rotation(found->second);
    return entry;
  }

 private:
  double Number(std::string_view text, int line) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      throw Error("{}:{}: '{}' is not a number", path_.string(), line, Excerpt(text));
    return value;
  }

  double Length(const Properties& properties, std::string_view key) const {
    const auto found = properties.find(key);
    if (found == properties.end())
      throw Error("{}:{}: a model without {}", path_.string(),
                  properties.empty() ? 0 : properties.begin()->second.line, key);
    const double length_cm = Number(found->second.value, found->second.line);
    if (!(length_cm > 0.0))
      throw Error("{}:{}: {} must be positive", path_.string(), found->second.line, key);
    return length_cm;
  }

  Eigen::Matrix3d Rotation(const Property& property) const {
    const std::vector<TextLine> lines = SplitTextLines(property.value);
    if (lines.size() != 1 || lines[0].fields.size() != 9)
      throw Error("{}:{}: modelRotation must have nine numbers", path_.string(), property.line);
    Eigen::Matrix3d R;
    for (Eigen::Index i = 0; i < 9; ++i)
      R(i / 3, i % 3) = Number(lines[0].fields[static_cast<std::size_t>(i)], property.line);
    return R;
  }

  const std::filesystem::path& path_;
};

}  // namespace

FurnitureCatalogue FurnitureCatalogue::Read(const std::filesystem::path& path) {
  FurnitureCatalogue catalogue;
  catalogue.path_ = path;
  const Reader reader(path);
  for (const auto& [number, properties] : reader.ReadAll()) {
    if (number == 0) {
      const auto license = properties.find("license");
      if (license != properties.end()) catalogue.license_ = license->second.value;
      continue;
    }
    const auto model = properties.find("model");
    if (model != properties.end())
      catalogue.entries_[model->second.value] = reader.MakeEntry(properties);
  }
  return catalogue;
}

const CatalogueEntry& FurnitureCatalogue::Entry(std::string_view model) const {
  const auto found = entries_.find(model);
  if (found == entries_.end())
    throw Error("catalogue '{}' does not list model '{}'", path_.string(), model);
  return found->second;
}

}  // namespace cslam
