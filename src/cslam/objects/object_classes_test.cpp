// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_classes.h"

#include "cslam/semantics/coco.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

int Class(const char* name) {
  return FindCocoClass(name).value();
}

TEST(ObjectClasses, KnowTheDistancesOfThePaper) {
  const ObjectClasses classes{ObjectClassOptions{}};
  EXPECT_DOUBLE_EQ(classes.DistanceM(Class("bottle")), 0.2);
  EXPECT_DOUBLE_EQ(classes.DistanceM(Class("tv")), 0.5);
  EXPECT_DOUBLE_EQ(classes.DistanceM(Class("chair")), 1.0);
  EXPECT_DOUBLE_EQ(classes.DistanceM(Class("umbrella")), 0.6) << "the default";
}

TEST(ObjectClasses, KnowHowMuchOfAThingIsMoreThanAPiece) {
  const ObjectClasses classes{ObjectClassOptions{}};
  EXPECT_NEAR(classes.MinExtentM(Class("chair")), 0.3, 1e-9);
  EXPECT_EQ(classes.MinExtentM(Class("spoon")), 0.0) << "it has no distance of its own";
}

TEST(ObjectClasses, WeighVotesBySize) {
  const ObjectClasses classes{ObjectClassOptions{}};
  EXPECT_EQ(classes.SizeWeight(Class("chair"), 0.9), 1.0);
  EXPECT_LT(classes.SizeWeight(Class("chair"), 0.6), 0.5) << "as high as a suitcase";
  EXPECT_EQ(classes.SizeWeight(Class("suitcase"), 0.6), 1.0);
  EXPECT_EQ(classes.SizeWeight(Class("spoon"), 5.0), 1.0) << "of which nothing is known";
}

TEST(ObjectClasses, KnowWhatIsTooLargeForAThing) {
  ObjectClassOptions options;
  options.sizes = "cup=0.05:0.2";
  const ObjectClasses classes(options);
  EXPECT_FALSE(classes.IsTooLarge(Class("cup"), 0.19));
  EXPECT_TRUE(classes.IsTooLarge(Class("cup"), 0.21));
  EXPECT_FALSE(classes.IsTooLarge(Class("chair"), 9.0)) << "nothing is known of it";
}

TEST(ObjectClasses, RefuseSizesThatCannotBeRead) {
  for (const char* sizes : {"chair", "chair=1", "chair=2:1", "char=0.5:1"}) {
    ObjectClassOptions options;
    options.sizes = sizes;
    EXPECT_THROW(ObjectClasses{options}, Error) << sizes;
  }
}

TEST(ObjectClasses, AreAlikeWithinAGroupOnly) {
  const ObjectClasses classes{ObjectClassOptions{}};
  EXPECT_TRUE(classes.AreAlike(Class("chair"), Class("couch")));
  EXPECT_TRUE(classes.AreAlike(Class("umbrella"), Class("umbrella")));
  EXPECT_FALSE(classes.AreAlike(Class("chair"), Class("teddy bear")));
  EXPECT_FALSE(classes.AreAlike(Class("umbrella"), Class("oven"))) << "neither is in a group";
}

TEST(ObjectClasses, AreNotAlikeThroughAThirdOne) {
  const ObjectClasses classes{ObjectClassOptions{.alike = "cup+vase vase+potted_plant"}};
  EXPECT_TRUE(classes.AreAlike(Class("vase"), Class("cup")));
  EXPECT_TRUE(classes.AreAlike(Class("vase"), Class("potted plant")));
  EXPECT_FALSE(classes.AreAlike(Class("cup"), Class("potted plant")));
}

TEST(ObjectClasses, LeaveLivingThingsAndTheNamelessOutOfTheMap) {
  const ObjectClasses classes{ObjectClassOptions{}};
  EXPECT_TRUE(classes.IsMapped(Class("chair")));
  EXPECT_FALSE(classes.IsMapped(Class("person")));
  EXPECT_FALSE(classes.IsMapped(-1));
}

// What a text of options is answered with.
std::string ErrorOf(const ObjectClassOptions& options) {
  try {
    const ObjectClasses classes(options);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(ObjectClasses, SayWhichOptionCannotBeRead) {
  EXPECT_NE(ErrorOf({.distances = "chair=much"}).find("chair=much"), std::string::npos);
  EXPECT_NE(ErrorOf({.distances = "chair"}).find("class=metres"), std::string::npos);
  EXPECT_NE(ErrorOf({.distances = "chair=-1"}).find("chair=-1"), std::string::npos);
  EXPECT_NE(ErrorOf({.distances = "chiar=1.0"}).find("'chiar'"), std::string::npos);
  EXPECT_NE(ErrorOf({.alike = "chair+sofabed"}).find("classes.alike"), std::string::npos);
  EXPECT_NE(ErrorOf({.left_out = "ghost"}).find("classes.left_out"), std::string::npos);
}

TEST(ObjectClasses, RefuseMoreGroupsThanFit) {
  std::string alike;
  for (int i = 0; i < 33; ++i)
    alike += "chair+couch ";
  EXPECT_NE(ErrorOf({.alike = alike}).find("groups"), std::string::npos);
}

TEST(ObjectClasses, TakeEmptyTextsForNothing) {
  const ObjectClasses classes{ObjectClassOptions{.distances = "", .alike = "", .left_out = ""}};
  EXPECT_DOUBLE_EQ(classes.DistanceM(Class("chair")), 0.6);
  EXPECT_FALSE(classes.AreAlike(Class("chair"), Class("couch")));
  EXPECT_TRUE(classes.IsMapped(Class("person")));
}

}  // namespace
}  // namespace cslam
