// SPDX-License-Identifier: BSD-3-Clause
#include "image_topics.hpp"

#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

bool namesCompressed(const std::vector<std::string>& published) {
  ros::master::V_TopicInfo topics;
  for (const auto& name : published) topics.emplace_back(name, "any");
  const std::string advice = adviceWithoutImages("/cam/image", topics);
  EXPECT_NE(advice.find("no images on /cam/image"), std::string::npos) << advice;
  return advice.find("image_transport:=compressed") != std::string::npos;
}

TEST(AdviceWithoutImages, NamesCompressedOnlyWhereItHelps) {
  EXPECT_TRUE(namesCompressed({"/tf", "/cam/image/compressed"}));
  EXPECT_FALSE(namesCompressed({}));
  EXPECT_FALSE(namesCompressed({"/other/image/compressed"}));
  EXPECT_FALSE(namesCompressed({"/cam/image", "/cam/image/compressed"})) << "raw has a publisher";
}

}  // namespace
}  // namespace ardrone_vslam
