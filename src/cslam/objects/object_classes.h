// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>

namespace cslam {

class OptionList;

// What is known of classes before anything is seen. Text, so that it can be set from outside.
struct ObjectClassOptions {
  // From the literature, and like things beside them.
  std::string distances =
      "bottle=0.2 wine_glass=0.2 cup=0.2 bowl=0.25 vase=0.3 book=0.3 mouse=0.2 keyboard=0.4 "
      "cell_phone=0.2 remote=0.2 clock=0.3 tv=0.5 laptop=0.5 teddy_bear=0.5 potted_plant=0.6 "
      "suitcase=0.6 backpack=0.6 umbrella=0.6 chair=1.0 couch=1.5 bench=1.0 bed=2.0 "
      "dining_table=1.5 "
      "refrigerator=1.0";
  double default_distance_m = 0.6;
  double min_extent = 0.3;
  // Largest side, from ... to ... metres, of those that are often taken for one another.
  std::string sizes =
      "chair=0.7:1.4 couch=1.0:3.0 bench=1.1:3.0 suitcase=0.3:0.95 backpack=0.3:0.8 "
      "handbag=0.15:0.6 "
      "cup=0.05:0.2 bowl=0.08:0.4 bottle=0.1:0.4 vase=0.1:0.8 tv=0.25:2.0 laptop=0.2:0.6 "
      "teddy_bear=0.1:0.9";
  double wrong_size_weight = 0.2;
  // Names that detectors use for one another.
  std::string alike =
      "chair+couch+bench tv+laptop cup+bowl+vase bottle+wine_glass suitcase+backpack+handbag "
      "potted_plant+vase teddy_bear+dog+cat+bear+sheep";
  // Living things are no part of a map.
  std::string left_out = "person bird cat dog horse sheep cow elephant bear zebra giraffe";
};
void Describe(OptionList& list, ObjectClassOptions& options);

// The same, ready for use.
class ObjectClasses {
 public:
  // Throws Error for a class or a number that cannot be read.
  explicit ObjectClasses(const ObjectClassOptions& options);

  // How far the centres of two sightings of one thing may lie apart (m).
  double DistanceM(int class_id) const;

  // What shows less than so many metres of itself is a piece of such a thing at best; 0 for classes
  // without a distance of their own.
  double MinExtentM(int class_id) const;

  // What a vote for the class counts if the thing's largest side is so long: 1 or less.
  double SizeWeight(int class_id, double largest_m) const;

  // Whether no such thing has a side so long, as far as its size is known.
  bool IsTooLarge(int class_id, double largest_m) const;

  // One class, or names for one another.
  bool AreAlike(int a, int b) const;

  // Whether things that a detector calls so may become objects of the map.
  bool IsMapped(int class_id) const;

 private:
  double default_distance_m_;
  double min_extent_;
  std::map<int, double> distances_m_;
  std::map<int, std::pair<double, double>> sizes_m_;  // of the largest side
  double wrong_size_weight_;
  std::map<int, unsigned> groups_;  // bit i: member of group i
  std::set<int> left_out_;
};

// The classes with these names, blanks between them. option: for the Error of a name that is none.
std::set<int> ClassesIn(const std::string& names, const std::string& option);

}  // namespace cslam
