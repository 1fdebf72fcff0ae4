// SPDX-License-Identifier: BSD-3-Clause
#include "images/image_topics.hpp"

#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

bool says(const std::string& part, const std::string& silent,
          const std::vector<std::string>& published) {
  ros::master::V_TopicInfo topics;
  for (const auto& name : published) topics.emplace_back(name, "any");
  const std::string advice = adviceWithoutImages(silent, topics);
  EXPECT_NE(advice.find("no images on " + silent), std::string::npos) << advice;
  return advice.find(part) != std::string::npos;
}

bool namesCompressed(const std::vector<std::string>& published) {
  return says("image_transport:=compressed", "/cam/image", published);
}

TEST(AdviceWithoutImages, NamesCompressedOnlyWhereItHelps) {
  EXPECT_TRUE(namesCompressed({"/tf", "/cam/image/compressed"}));
  EXPECT_FALSE(namesCompressed({}));
  EXPECT_FALSE(namesCompressed({"/other/image/compressed"}));
  EXPECT_FALSE(namesCompressed({"/cam/image", "/cam/image/compressed"})) << "raw has a publisher";
}

TEST(AdviceWithoutImages, NamesRawOnlyWhereItHelps) {
  const std::string silent = "/cam/image/compressed", raw = "image_transport:=raw";
  EXPECT_TRUE(says(raw, silent, {"/tf", "/cam/image"}));
  EXPECT_FALSE(says(raw, silent, {}));
  EXPECT_FALSE(says(raw, silent, {"/cam/image", silent}));
}

TEST(AdviceWithoutImages, NamesTheOtherCameraWhereTheTopicHasAPublisher) {
  EXPECT_TRUE(says("togglecam", "/ardrone/bottom/image_raw",
                   {"/ardrone/image_raw", "/ardrone/bottom/image_raw"}));
  EXPECT_FALSE(says("togglecam", "/cam/image", {"/ardrone/image_raw"}));
}

}  // namespace
}  // namespace ardrone_vslam
