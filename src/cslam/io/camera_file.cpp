// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/camera_file.h"

#include "cslam/io/text_lines.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

namespace cslam {
namespace {

struct Key {
  const char* name;
  double Camera::*field;
  bool is_required;
};

constexpr std::array kCameraKeys{
    Key{"fx", &Camera::fx, true},  Key{"fy", &Camera::fy, true},  Key{"cx", &Camera::cx, true},
    Key{"cy", &Camera::cy, true},  Key{"k1", &Camera::k1, false}, Key{"k2", &Camera::k2, false},
    Key{"p1", &Camera::p1, false}, Key{"p2", &Camera::p2, false}, Key{"k3", &Camera::k3, false}};

// Beyond these a depth scale is a slip: 1 is a camera that tells metres only, 100000 one that
// ends at 0.65 m.
constexpr double kMinDepthScale = 1.0;
constexpr double kMaxDepthScale = 100'000.0;

std::vector<std::string> KeyNames() {
  std::vector<std::string> names{"name", "width", "height", "depth_scale"};
  for (const Key& key : kCameraKeys)
    names.emplace_back(key.name);
  return names;
}

// The scalars of a flat YAML map, with the lines they stand on.
class ScalarMap {
 public:
  explicit ScalarMap(const std::filesystem::path& path) : path_(path) {
    const std::string text = ReadBytes(path, "camera file");
    YAML::Node root;
    try {
      root = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      throw Error("{}:{}: {}", path.string(), error.mark.line + 1, error.msg);
    }
    if (!root.IsMap()) {
      throw Error("{}: expected lines 'key: value' with the keys {}", path.string(),
                  fmt::join(KeyNames(), ", "));
    }
    for (const auto& entry : root)
      Add(entry.first, entry.second);
  }

  bool Has(std::string_view key) const { return Find(key) != nullptr; }

  std::string Text(std::string_view key) const { return Require(key).text; }

  double Number(std::string_view key) const {
    const Entry& entry = Require(key);
    std::string_view text = entry.text;
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
      throw Error("{}:{}: {} must be a finite number, found '{}'", path_.string(), entry.line, key,
                  Excerpt(entry.text));
    }
    return value;
  }

  int Integer(std::string_view key) const {
    const double value = Number(key);
    if (value != std::floor(value) || std::abs(value) > 1e6) {
      throw Error("{}:{}: {} must be a whole number of pixels, found '{}'", path_.string(),
                  Line(key), key, Text(key));
    }
    return static_cast<int>(value);
  }

  int Line(std::string_view key) const { return Require(key).line; }

 private:
  struct Entry {
    std::string key;
    std::string text;
    int line = 0;
  };

  void Add(const YAML::Node& key_node, const YAML::Node& value_node) {
    const int line = key_node.Mark().line + 1;
    const std::vector<std::string> known = KeyNames();
    const std::string key = key_node.IsScalar() ? key_node.Scalar() : "";
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw Error("{}:{}: unknown key '{}'; did you mean '{}'?", path_.string(), line, Excerpt(key),
                  NearestName(key, known));
    }
    if (const Entry* earlier = Find(key)) {
      throw Error("{}:{}: '{}' is already given in line {}", path_.string(), line, key,
                  earlier->line);
    }
    if (!value_node.IsScalar()) {
      throw Error("{}:{}: '{}' needs a single value", path_.string(), line, key);
    }
    entries_.push_back({.key = key, .text = value_node.Scalar(), .line = line});
  }

  const Entry* Find(std::string_view key) const {
    const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& e) { return e.key == key; });
    return entry == entries_.end() ? nullptr : &*entry;
  }

  const Entry& Require(std::string_view key) const {
    const Entry* entry = Find(key);
    if (entry == nullptr) throw Error("{}: '{}' is missing", path_.string(), key);
    return *entry;
  }

  std::filesystem::path path_;
  std::vector<Entry> entries_;
};

CameraConfig MakePreset(std::string name, const Camera& camera, double depth_units_per_m,
                        bool approximate = false) {
  return {.camera = camera,
          .depth_units_per_m = depth_units_per_m,
          .name = std::move(name),
          .source = "preset",
          .approximate = approximate};
}

// The numbers as their publishers print them; see docs/datasets.md.
std::vector<CameraConfig> MakePresets() {
  const Camera fr1{.fx = 517.3,
                   .fy = 516.5,
                   .cx = 318.6,
                   .cy = 255.3,
                   .k1 = 0.2624,
                   .k2 = -0.9531,
                   .p1 = -0.0054,
                   .p2 = 0.0026,
                   .k3 = 1.1633};
  const Camera fr2{.fx = 520.9,
                   .fy = 521.0,
                   .cx = 325.1,
                   .cy = 249.7,
                   .k1 = 0.2312,
                   .k2 = -0.7849,
                   .p1 = -0.0033,
                   .p2 = -0.0001,
                   .k3 = 0.9172};
  const Camera fr3{.fx = 535.4, .fy = 539.2, .cx = 320.1, .cy = 247.6};
  const Camera bonn{.fx = 542.822841,
                    .fy = 542.576870,
                    .cx = 315.593520,
                    .cy = 237.756098,
                    .k1 = 0.039903,
                    .k2 = -0.099343,
                    .p1 = -0.000730,
                    .p2 = -0.000144};
  const Camera d435i{.fx = 606.0, .fy = 606.0, .cx = 320.0, .cy = 240.0};
  return {MakePreset("tum_fr1", fr1, 5000.0), MakePreset("tum_fr2", fr2, 5000.0),
          MakePreset("tum_fr3", fr3, 5000.0), MakePreset("bonn", bonn, 5000.0),
          MakePreset("d435i", d435i, 1000.0, true)};
}

// What in a folder's name speaks of which preset.
struct FolderHint {
  std::string_view word;
  std::string_view preset;
};

constexpr std::array kFolderHints{
    FolderHint{"freiburg1", "tum_fr1"}, FolderHint{"freiburg2", "tum_fr2"},
    FolderHint{"freiburg3", "tum_fr3"}, FolderHint{"fr1", "tum_fr1"},
    FolderHint{"fr2", "tum_fr2"},       FolderHint{"fr3", "tum_fr3"},
    FolderHint{"bonn", "bonn"}};

// Whether text has word with no digit behind it: fr10 is not fr1.
bool HasWord(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string_view::npos;
       at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if (end == text.size() || text[end] < '0' || text[end] > '9') return true;
  }
  return false;
}

// A name that speaks of two presets tells nothing.
std::optional<FolderHint> HintOf(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  std::optional<FolderHint> found;
  for (const FolderHint& hint : kFolderHints) {
    if (!HasWord(name, hint.word)) continue;
    if (found && found->preset != hint.preset) return std::nullopt;
    if (!found) found = hint;
  }
  return found;
}

std::optional<CameraConfig> PresetByFolderName(const std::filesystem::path& folder) {
  std::filesystem::path rest = std::filesystem::absolute(folder).lexically_normal();
  if (!rest.has_filename()) rest = rest.parent_path();
  for (int level = 0; level < 2 && rest.has_filename(); ++level, rest = rest.parent_path()) {
    const std::string name = rest.filename().string();
    const std::optional<FolderHint> hint = HintOf(name);
    if (!hint) continue;
    std::optional<CameraConfig> config = FindCameraPreset(hint->preset);
    CSLAM_CHECK(config.has_value());
    config->source = fmt::format("'{}' in the folder name '{}'", hint->word, name);
    return config;
  }
  return std::nullopt;
}

CameraConfig CameraByArgument(const std::string& argument) {
  if (std::optional<CameraConfig> preset = FindCameraPreset(argument)) {
    preset->source = "preset chosen with --camera";
    return *preset;
  }
  std::error_code ignored;
  if (!std::filesystem::exists(argument, ignored)) {
    throw Error("--camera '{}' is neither a file nor a preset; the presets are {}", argument,
                DescribeCameraPresets());
  }
  CameraConfig config = ReadCameraFile(argument);
  config.source = fmt::format("file '{}' chosen with --camera", argument);
  return config;
}

std::optional<CameraConfig> CameraOfFolder(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "camera.yaml";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return PresetByFolderName(folder);
  CameraConfig config = ReadCameraFile(file);
  config.source = "camera.yaml in the folder";
  return config;
}

void CheckDepthScale(double units_per_m) {
  if (units_per_m >= kMinDepthScale && units_per_m <= kMaxDepthScale) return;
  throw Error("--depth-scale {} is outside {} to {} units per metre", units_per_m, kMinDepthScale,
              kMaxDepthScale);
}

}  // namespace

const std::vector<CameraConfig>& CameraPresets() {
  static const std::vector<CameraConfig> kPresets = MakePresets();
  return kPresets;
}

std::string DescribeCameraPresets() {
  std::vector<std::string> names;
  for (const CameraConfig& preset : CameraPresets())
    names.push_back(preset.name + (preset.approximate ? " (approximate)" : ""));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::optional<CameraConfig> FindCameraPreset(std::string_view name) {
  for (const CameraConfig& preset : CameraPresets()) {
    if (preset.name == name) return preset;
  }
  return std::nullopt;
}

CameraConfig ReadCameraFile(const std::filesystem::path& path) {
  const ScalarMap map(path);
  CameraConfig config;
  config.camera.width = map.Integer("width");
  config.camera.height = map.Integer("height");
  for (const Key& key : kCameraKeys) {
    if (key.is_required || map.Has(key.name)) config.camera.*key.field = map.Number(key.name);
  }
  config.depth_units_per_m = map.Number("depth_scale");
  config.name = map.Has("name") ? map.Text("name") : path.filename().string();
  config.source = fmt::format("file '{}'", path.string());
  if (config.depth_units_per_m < kMinDepthScale || config.depth_units_per_m > kMaxDepthScale) {
    throw Error("{}:{}: depth_scale {} is outside {} to {} units per metre", path.string(),
                map.Line("depth_scale"), config.depth_units_per_m, kMinDepthScale, kMaxDepthScale);
  }
  if (const std::string problem = WhyInvalid(config.camera); !problem.empty()) {
    throw Error("{}: {}", path.string(), problem);
  }
  return config;
}

std::string FormatCamera(const CameraConfig& config) {
  const Camera& camera = config.camera;
  YAML::Emitter name;
  name << YAML::DoubleQuoted << config.name;
  std::string text = "# Pinhole with Brown-Conrady distortion; pixels. See docs/datasets.md.\n";
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "name: {}\nwidth: {}\nheight: {}\n", name.c_str(), camera.width,
                 camera.height);
  for (const Key& key : kCameraKeys) {
    const double value = camera.*key.field;
    if (key.is_required || value != 0.0) fmt::format_to(out, "{}: {}\n", key.name, value);
  }
  fmt::format_to(out, "depth_scale: {}  # depth image units per metre\n", config.depth_units_per_m);
  return text;
}

void WriteCameraFile(const std::filesystem::path& path, const CameraConfig& config) {
  WriteFileAtomically(path, FormatCamera(config));
}

std::optional<CameraConfig> FindCamera(const std::filesystem::path& folder,
                                       const CameraChoice& choice) {
  if (choice.depth_units_per_m) CheckDepthScale(*choice.depth_units_per_m);
  std::optional<CameraConfig> config =
      choice.camera.empty() ? CameraOfFolder(folder) : CameraByArgument(choice.camera);
  if (config && choice.depth_units_per_m) config->depth_units_per_m = *choice.depth_units_per_m;
  return config;
}

std::string MissingCameraMessage(const std::filesystem::path& folder) {
  return fmt::format(
      "no camera known for '{}': it has no camera.yaml and its name tells none; pass --camera FILE "
      "or one of the presets {}",
      folder.string(), DescribeCameraPresets());
}

CameraConfig ResolveCamera(const std::filesystem::path& folder, const CameraChoice& choice) {
  std::optional<CameraConfig> config = FindCamera(folder, choice);
  if (!config) throw Error("{}", MissingCameraMessage(folder));
  return *std::move(config);
}

}  // namespace cslam
