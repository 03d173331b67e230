// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cslam {

// Reads the options a YAML file names into the structs behind the list; nested maps stand for
// the dots of the keys, and a file need not name every option. Throws Error "file:line: ..." for
// broken YAML, an unknown or repeated key, and a value of the wrong type or outside its range.
// After a throw the options before the faulty line are already set.
void LoadYaml(const std::filesystem::path& path, OptionList& list);

// Applies "key=value" texts in their order. Throws Error like OptionList::Set().
void ApplyOverrides(const std::vector<std::string>& assignments, OptionList& list);

// All options as YAML that LoadYaml() takes back without loss, each with a comment that gives
// meaning, unit and range.
std::string DumpYaml(const OptionList& list);

// All options as an aligned table for the terminal. Where a value differs from the one in
// defaults (which must list the same keys in the same order), the default is shown as well.
std::string DumpTable(const OptionList& list, const OptionList& defaults);

// All options as a page of Markdown, one table for each group.
std::string DumpMarkdown(const OptionList& list);

}  // namespace cslam
