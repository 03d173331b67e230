// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/json_object.h"

#include <gtest/gtest.h>

#include <limits>

namespace cslam {
namespace {

std::string Single(std::string_view text) {
  JsonObject json;
  json.Add("k", text);
  return json.Text();
}

TEST(JsonObject, KeepsOrderAndIndentsWhenNested) {
  JsonObject inner;
  inner.Add("z", 1);
  inner.Add("a", true);
  JsonObject json;
  json.Add("name", "x");
  json.Add("inner", inner);
  json.Add("list", std::vector<std::string>{"p", "q"});
  EXPECT_EQ(json.Text(),
            "{\n"
            "  \"name\": \"x\",\n"
            "  \"inner\": {\n"
            "    \"z\": 1,\n"
            "    \"a\": true\n"
            "  },\n"
            "  \"list\": [\n"
            "    \"p\",\n"
            "    \"q\"\n"
            "  ]\n"
            "}");
}

TEST(JsonObject, StaysShortWhenEmpty) {
  JsonObject json;
  EXPECT_EQ(json.Text(), "{}");
  json.Add("list", std::vector<std::string>());
  EXPECT_EQ(json.Text(), "{\n  \"list\": []\n}");
}

TEST(JsonObject, WritesNullWhenANumberIsNoneOrAbsent) {
  JsonObject json;
  json.Add("nan", std::numeric_limits<double>::quiet_NaN());
  json.Add("absent", std::optional<double>());
  json.Add("there", std::optional<double>(0.25));
  EXPECT_EQ(json.Text(), "{\n  \"nan\": null,\n  \"absent\": null,\n  \"there\": 0.25\n}");
}

TEST(JsonItems, StandOneAfterTheOther) {
  JsonObject item;
  item.Add("a", 1);
  EXPECT_EQ(JsonItems({}), "");
  EXPECT_EQ(JsonItems(std::vector{item, item}), "{\n  \"a\": 1\n},\n{\n  \"a\": 1\n}");
}

TEST(JsonObject, EscapesWhatWouldEndAText) {
  EXPECT_EQ(Single("a\"b\\c\n\x01"), "{\n  \"k\": \"a\\\"b\\\\c\\u000a\\u0001\"\n}");
}

TEST(JsonObject, KeepsUtf8AndReplacesOtherBytes) {
  EXPECT_EQ(Single("σ€😀"), "{\n  \"k\": \"σ€😀\"\n}");
  for (const char* const broken : {"\xff", "\xc3", "\xc0\x80", "\xed\xa0\x80", "\xf5\x80\x80\x80"})
    EXPECT_NE(Single(broken).find("\"\\ufffd"), std::string::npos) << broken;
}

}  // namespace
}  // namespace cslam
