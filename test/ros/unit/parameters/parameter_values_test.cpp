// SPDX-License-Identifier: BSD-3-Clause
#include "parameters/parameter_values.hpp"

#include <gtest/gtest.h>

#include <set>

namespace ardrone_vslam {
namespace {

struct SmallConfig {
  bool lights = true;
  int doors = 4;
  double height_m = 1.5;
};

template <class Visitor>
void visitParameters(SmallConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"lights", "switch", 0, 0, "it has some"}, c.lights);
  visit(ParameterInfo{"doors", "-", 1, 5, "how many"}, c.doors);
  visit(ParameterInfo{"height_m", "m", 1, 3, "of the roof"}, c.height_m);
}

TEST(ParameterValues, ComeBackAsTheyWere) {
  SmallConfig config;
  EXPECT_TRUE(takeOver(valuesOf(SmallConfig{false, 2, 2.5}), config).empty());
  EXPECT_FALSE(config.lights);
  EXPECT_EQ(config.doors, 2);
  EXPECT_EQ(config.height_m, 2.5);
}

TEST(ParameterValues, WhatIsNotGivenStays) {
  ParameterValues values;
  append("doors", 3, values);
  SmallConfig config{false, 2, 2.5};
  EXPECT_TRUE(takeOver(values, config).empty());
  EXPECT_FALSE(config.lights);
  EXPECT_EQ(config.doors, 3);
  EXPECT_EQ(config.height_m, 2.5);
}

TEST(ParameterValues, EveryFaultIsNamed) {
  ParameterValues values;
  append("door", 3, values);
  append("doors", 2.5, values);
  append("height_m", 0.5, values);
  append("lights", 1, values);
  SmallConfig config;
  const auto faults = takeOver(values, config);
  EXPECT_EQ(std::set<std::string>(faults.begin(), faults.end()),
            (std::set<std::string>{
                "door may not be changed in flight, or is none; did you mean doors?",
                "doors must not be a number with a point", "lights must not be a whole number",
                "height_m is 0.5 but must be between 1 and 3 [m]"}));
}

TEST(ParameterValues, TheDescriptionHasRangesAndDefaults) {
  const auto description = descriptionOf<SmallConfig>();
  ASSERT_EQ(description.groups.size(), 1U);
  const auto& parameters = description.groups.front().parameters;
  ASSERT_EQ(parameters.size(), 3U);
  EXPECT_EQ(parameters[0].type, "bool");
  EXPECT_EQ(parameters[1].type, "int");
  EXPECT_EQ(parameters[2].type, "double");
  EXPECT_EQ(parameters[2].description, "of the roof [m]");
  EXPECT_EQ(description.min.ints.front().value, 1);
  EXPECT_EQ(description.max.ints.front().value, 5);
  EXPECT_EQ(description.dflt.ints.front().value, 4);
  EXPECT_EQ(description.max.doubles.front().value, 3);
  EXPECT_EQ(description.min.bools.front().value, 0);
  EXPECT_EQ(description.max.bools.front().value, 1);
}

}  // namespace
}  // namespace ardrone_vslam
