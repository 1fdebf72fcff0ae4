// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/instruction_set.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace ardrone_vslam {
namespace {

TEST(InstructionSet, ScalarIsAlwaysThereAndTheFastestIsTheDefault) {
  const auto sets = supportedInstructionSets();
  ASSERT_FALSE(sets.empty());
  EXPECT_EQ(sets.front(), InstructionSet::kScalar);
  for (const char* request : {static_cast<const char*>(nullptr), ""}) {
    const auto choice = chooseInstructionSet(request);
    EXPECT_EQ(choice.set, sets.back());
    EXPECT_EQ(choice.fault, "");
  }
}

TEST(InstructionSet, ANameForcesIt) {
  for (const InstructionSet set : supportedInstructionSets()) {
    const auto choice = chooseInstructionSet(nameOf(set));
    EXPECT_EQ(choice.set, set);
    EXPECT_EQ(choice.fault, "");
  }
}

TEST(InstructionSet, AnUnknownNameIsAFaultThatListsTheKnown) {
  const auto choice = chooseInstructionSet("sse9");
  EXPECT_EQ(choice.set, supportedInstructionSets().back());
  EXPECT_NE(choice.fault.find("sse9"), std::string::npos);
  EXPECT_NE(choice.fault.find("ARDRONE_VSLAM_KERNELS"), std::string::npos);
  EXPECT_NE(choice.fault.find("scalar"), std::string::npos);
}

TEST(InstructionSet, TheProcessUsesWhatTheEnvironmentAsksFor) {
  EXPECT_EQ(instructionSetInUse().set,
            chooseInstructionSet(std::getenv("ARDRONE_VSLAM_KERNELS")).set);
}

}  // namespace
}  // namespace ardrone_vslam
