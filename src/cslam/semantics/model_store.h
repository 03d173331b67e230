// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/model_description.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

// The value of an environment variable; null if it is not set. std::getenv is one.
using GetEnvironment = std::function<const char*(const char*)>;

// "<data folder>/changing-slam/models" for XDG_DATA_HOME (else ~/.local/share), where models are
// installed, and then for each of XDG_DATA_DIRS (else /usr/local/share, /usr/share).
std::vector<std::filesystem::path> ModelFolders(const GetEnvironment& get_environment);
std::vector<std::filesystem::path> ModelFolders();  // of this process

// A model in one of the folders, or why it cannot be used.
struct InstalledModel {
  std::filesystem::path description_file;
  std::optional<ModelDescription> description;
  std::string problem;  // one line; empty if there is a description
};

// By name; of equal names the one of the earlier folder.
std::vector<InstalledModel> ListModels(const std::vector<std::filesystem::path>& folders);

// model: a name, or the path of an .onnx or .yaml file. Throws Error that says what is missing and
// how to get it.
ModelDescription FindModel(std::string_view model,
                           const std::vector<std::filesystem::path>& folders);

// The best of the installed models that can be used: those that are known to be good at people
// first, then any, by name. nullopt if there is none.
std::optional<ModelDescription> FindBestModel(const std::vector<std::filesystem::path>& folders);

// "no detector model is installed; get one with 'changing-slam model install'"
std::string NoModelMessage();

}  // namespace cslam
