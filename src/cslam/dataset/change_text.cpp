// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/change_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace cslam {

std::string NameOfObject(const TrueObjects& objects, int instance) {
  const auto found = std::ranges::find(objects.objects, instance, &TrueObject::instance);
  return found == objects.objects.end() ? fmt::format("object {}", instance) : found->name;
}

std::string Describe(const TrueChange& change, const TrueObjects& objects) {
  const std::string text =
      fmt::format("{} {}", NameOfObject(objects, change.instance), NameOf(change.kind));
  if (change.kind != ChangeKind::kReplaced) return text;
  return fmt::format("{} by {}", text, NameOfObject(objects, change.new_instance));
}

}  // namespace cslam
