// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_classes.h"

#include "cslam/semantics/coco.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <sstream>
#include <vector>

namespace cslam {
namespace {

constexpr std::size_t kMaxGroups = 32;

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

int ClassCalled(const std::string& name, const std::string& option) {
  const auto id = FindCocoClass(name);
  if (!id) throw Error("{}: '{}' is no COCO class", option, name);
  return *id;
}

}  // namespace

void Describe(OptionList& list, ObjectClassOptions& o) {
  list.Add("distances", o.distances,
           "How far two sightings of one thing may lie apart, in m: class=distance, with blanks "
           "between.");
  list.Add("default_distance", o.default_distance_m, {0.01, 10.0}, "m",
           "The same for all other classes.");
  list.Add("min_extent", o.min_extent, {0.0, 1.0}, "",
           "What shows less than this share of its distance, across the view, is a piece of "
           "something half hidden: no new object; nor is one of which no more is left. Only for "
           "classes in 'distances'.");
  list.Add(
      "sizes", o.sizes,
      "Usual lengths of the largest side, in m: class=from:to, with blanks between. What shows "
      "more of itself is no such thing.");
  list.Add("wrong_size_weight", o.wrong_size_weight, {0.0, 1.0}, "",
           "What a detection counts as vote for a class if the thing is larger or smaller: a "
           "suitcase is not as high as a chair.");
  list.Add("alike", o.alike, "Classes that detectors take for one another: chair+couch ...");
  list.Add("left_out", o.left_out, "Classes that never become objects of the map.");
}

ObjectClasses::ObjectClasses(const ObjectClassOptions& options)
    : default_distance_m_(options.default_distance_m),
      min_extent_(options.min_extent),
      wrong_size_weight_(options.wrong_size_weight) {
  for (const std::string& entry : Split(options.distances, ' ')) {
    const auto parts = Split(entry, '=');
    std::istringstream number(parts.size() == 2 ? parts[1] : "");
    double distance_m = 0.0;
    if (!(number >> distance_m) || distance_m <= 0.0) {
      throw Error("classes.distances: '{}' is not class=metres", entry);
    }
    distances_m_[ClassCalled(parts[0], "classes.distances")] = distance_m;
  }
  for (const std::string& entry : Split(options.sizes, ' ')) {
    const auto parts = Split(entry, '=');
    std::istringstream numbers(parts.size() == 2 ? parts[1] : "");
    double from_m = 0.0;
    double to_m = 0.0;
    char colon = 0;
    if (!(numbers >> from_m >> colon >> to_m) || colon != ':' || from_m < 0.0 || to_m <= from_m)
      throw Error("classes.sizes: '{}' is not class=from:to in metres", entry);
    sizes_m_[ClassCalled(parts[0], "classes.sizes")] = {from_m, to_m};
  }
  const auto groups = Split(options.alike, ' ');
  if (groups.size() > kMaxGroups) throw Error("classes.alike: more than {} groups", kMaxGroups);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const std::string& name : Split(groups[i], '+'))
      groups_[ClassCalled(name, "classes.alike")] |= 1U << i;
  }
  left_out_ = ClassesIn(options.left_out, "classes.left_out");
}

std::set<int> ClassesIn(const std::string& names, const std::string& option) {
  std::set<int> classes;
  for (const std::string& name : Split(names, ' '))
    classes.insert(ClassCalled(name, option));
  return classes;
}

double ObjectClasses::DistanceM(int class_id) const {
  const auto it = distances_m_.find(class_id);
  return it == distances_m_.end() ? default_distance_m_ : it->second;
}

double ObjectClasses::MinExtentM(int class_id) const {
  const auto it = distances_m_.find(class_id);
  return it == distances_m_.end() ? 0.0 : min_extent_ * it->second;
}

double ObjectClasses::SizeWeight(int class_id, double largest_m) const {
  const auto it = sizes_m_.find(class_id);
  if (it == sizes_m_.end()) return 1.0;
  return largest_m >= it->second.first && largest_m <= it->second.second ? 1.0 : wrong_size_weight_;
}

bool ObjectClasses::IsTooLarge(int class_id, double largest_m) const {
  const auto it = sizes_m_.find(class_id);
  return it != sizes_m_.end() && largest_m > it->second.second;
}

bool ObjectClasses::AreAlike(int a, int b) const {
  if (a == b) return true;
  const auto group_a = groups_.find(a);
  const auto group_b = groups_.find(b);
  return group_a != groups_.end() && group_b != groups_.end() &&
         (group_a->second & group_b->second) != 0U;
}

bool ObjectClasses::IsMapped(int class_id) const {
  return class_id >= 0 && !left_out_.contains(class_id);
}

}  // namespace cslam
