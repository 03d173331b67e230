// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/model_store.h"

#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <map>
#include <system_error>
#include <utility>

namespace cslam {
namespace {

namespace fs = std::filesystem;

// From the best down: NanoDet-Plus is better than NanoDet-g and faster.
constexpr std::array<std::string_view, 2> kBestFirst{"nanodet-plus-m", "nanodet-g"};

std::string ValueOf(const GetEnvironment& get_environment, const char* name) {
  const char* const value = get_environment(name);
  return value == nullptr ? "" : value;
}

fs::path ModelsBelow(const fs::path& data_folder) {
  return data_folder / "changing-slam" / "models";
}

InstalledModel Inspect(const fs::path& file) {
  try {
    ModelDescription description = ReadModelDescription(file);
    std::error_code ignored;
    if (!fs::exists(description.onnx_file, ignored))
      return {file, std::nullopt, "there is no '" + description.onnx_file.string() + "'"};
    return {file, std::move(description), ""};
  } catch (const Error& error) {
    return {file, std::nullopt, error.what()};
  }
}

std::vector<fs::path> DescriptionsIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error); !error && it != fs::directory_iterator();
       it.increment(error)) {
    if (it->path().extension() == ".yaml") files.push_back(it->path());
  }
  std::ranges::sort(files);
  return files;
}

bool IsPath(std::string_view model) {
  return model.find('/') != std::string_view::npos || model.ends_with(".onnx") ||
         model.ends_with(".yaml");
}

ModelDescription FindByPath(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) throw Error("there is no model file '{}'", file.string());
  return ReadModelDescription(file);
}

}  // namespace

std::vector<fs::path> ModelFolders(const GetEnvironment& get_environment) {
  std::vector<fs::path> folders;
  const std::string data_home = ValueOf(get_environment, "XDG_DATA_HOME");
  const std::string home = ValueOf(get_environment, "HOME");
  if (!data_home.empty()) {
    folders.push_back(ModelsBelow(data_home));
  } else if (!home.empty()) {
    folders.push_back(ModelsBelow(fs::path(home) / ".local" / "share"));
  }
  std::string shared = ValueOf(get_environment, "XDG_DATA_DIRS");
  if (shared.empty()) shared = "/usr/local/share:/usr/share";
  std::string_view rest = shared;
  while (!rest.empty()) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    if (colon > 0) folders.push_back(ModelsBelow(rest.substr(0, colon)));
    rest.remove_prefix(std::min(colon + 1, rest.size()));
  }
  return folders;
}

std::vector<fs::path> ModelFolders() {
  return ModelFolders([](const char* name) { return std::getenv(name); });
}

std::vector<InstalledModel> ListModels(const std::vector<fs::path>& folders) {
  std::map<std::string, InstalledModel> by_name;
  for (const fs::path& folder : folders) {
    for (const fs::path& file : DescriptionsIn(folder))
      by_name.try_emplace(file.stem().string(), Inspect(file));
  }
  std::vector<InstalledModel> models;
  for (auto& [name, model] : by_name)
    models.push_back(std::move(model));
  return models;
}

ModelDescription FindModel(std::string_view model, const std::vector<fs::path>& folders) {
  if (IsPath(model)) return FindByPath(model);
  std::vector<std::string> names;
  for (InstalledModel& installed : ListModels(folders)) {
    names.push_back(installed.description_file.stem().string());
    if (names.back() != model) continue;
    if (!installed.description) throw Error("model '{}': {}", model, installed.problem);
    return *std::move(installed.description);
  }
  if (names.empty()) throw Error("there is no model '{}': {}", model, NoModelMessage());
  throw Error("there is no model '{}' in {}; installed: {}", model,
              folders.empty() ? "any folder" : folders.front().string(), fmt::join(names, ", "));
}

std::optional<ModelDescription> FindBestModel(const std::vector<fs::path>& folders) {
  std::vector<InstalledModel> models = ListModels(folders);
  std::erase_if(models, [](const InstalledModel& model) { return !model.description; });
  if (models.empty()) return std::nullopt;
  for (const std::string_view name : kBestFirst) {
    for (InstalledModel& model : models) {
      if (model.description_file.stem() == name) return *std::move(model.description);
    }
  }
  return *std::move(models.front().description);
}

std::string NoModelMessage() {
  return "no detector model is installed; get one with 'changing-slam model install'";
}

}  // namespace cslam
