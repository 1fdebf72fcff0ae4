// SPDX-License-Identifier: BSD-3-Clause
// Worlds, their light and moving things, and what a camera makes of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sequences/drone_cameras.hpp"
#include "sequences/sequence.hpp"
#include "world/block_artefacts.hpp"
#include "world/world.hpp"
#include "world/world_camera.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam {
namespace {

Eigen::Isometry3d lookAlongX(double x_m, double y_m, double z_m) {
  return Eigen::Translation3d(x_m, y_m, z_m) * forwardCamera();
}

cv::Mat shoot(const Scene& scene, const CameraEffects& effects,
              const Eigen::Isometry3d& T_world_cam = lookAlongX(-1, 0, 1.2)) {
  const WorldCamera camera(arDroneFrontCamera(), effects);
  return camera.shoot(
      scene, [&](double) { return T_world_cam; }, 3);
}

double meanOf(const cv::Mat& image) {
  return cv::mean(image)[0];
}

double meanDifference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  return meanOf(difference);
}

CameraEffects noiseless() {
  CameraEffects effects;
  effects.noise_grey = 0;
  return effects;
}

TEST(World, NamesWhatItDoesNotKnow) {
  EXPECT_THROW(makeWorld("cellar", "steady", 0), std::invalid_argument);
  EXPECT_THROW(makeWorld("room", "disco", 0), std::invalid_argument);
  EXPECT_THROW(cameraNamed("side"), std::invalid_argument);
  WorldOptions options;
  options.world = "corridor";
  EXPECT_THROW(WorldSequence{options}, std::invalid_argument) << "laps would leave the corridor";
}

TEST(World, LightFadesAsSaid) {
  const World world = makeWorld("room", "fading", 0);
  const double before = meanOf(shoot(world.at(19), noiseless()));
  EXPECT_GT(before, 80);
  EXPECT_NEAR(meanOf(shoot(world.at(25), noiseless())), 0.03 * before, 0.6);
  EXPECT_NEAR(meanOf(shoot(world.at(40), noiseless())), 0.35 * before, 0.6);
}

TEST(World, AMovingLampBrightensWhatIsNearIt) {
  const World steady = makeWorld("room", "steady", 0), moving = makeWorld("room", "moving", 0);
  cv::Mat painted = shoot(steady.at(0), noiseless());
  for (const double t_s : {1.0, 9.0}) {
    const Lighting light = moving.at(t_s).lighting;
    const cv::Mat lit = shoot(moving.at(t_s), noiseless());
    const Eigen::Vector3d on_wall(4, 0, 1.2);  // the wall before the camera's middle
    const double distance_m = (on_wall - light.lamp_m).norm();
    const double share =
        light.even + light.lamp / (1 + std::pow(distance_m / light.lamp_reach_m, 2));
    const cv::Rect middle(316, 176, 9, 9);
    EXPECT_NEAR(meanOf(lit(middle)), share * meanOf(painted(middle)), 2) << t_s;
  }
}

TEST(World, ThingsMoveAndTheRestStands) {
  const World world = makeWorld("moving", "steady", 0);
  const Scene early = world.at(2), late = world.at(3);
  ASSERT_EQ(early.surfaces.size(), late.surfaces.size());
  std::size_t moved = 0;
  double fastest_m_s = 0;
  for (std::size_t i = 0; i < early.surfaces.size(); ++i) {
    const double displacement_m = (early.surfaces[i].corner - late.surfaces[i].corner).norm();
    moved += displacement_m > 0 ? 1 : 0;
    fastest_m_s = std::max(fastest_m_s, displacement_m);
  }
  EXPECT_EQ(moved, 15U) << "three boxes of five faces";
  EXPECT_LT(fastest_m_s, 1.5);
  const World standing = makeWorld("furnished", "steady", 0);
  EXPECT_EQ(standing.at(2).surfaces.size() + 15, early.surfaces.size());
}

TEST(World, AFloorSeenFromAHandsBreadthHasDetail) {
  const CameraChoice& bottom = cameraNamed("bottom");
  const World world = makeWorld("furnished", "steady", 0);
  const WorldCamera camera(bottom.intrinsics, noiseless());
  for (const double height_m : {0.3, 1.0, 2.5}) {
    const Eigen::Isometry3d T_world_cam =
        Eigen::Translation3d(-2.6, 0.3, height_m) * bottom.T_body_cam;
    const cv::Mat image = camera.shoot(
        world.at(0), [&](double) { return T_world_cam; }, 0);
    cv::Scalar mean, sigma;
    cv::Mat slope;
    cv::absdiff(image(cv::Rect(0, 0, 312, 240)), image(cv::Rect(8, 0, 312, 240)), slope);
    EXPECT_GT(meanOf(slope), 5) << height_m;  // 8 pixels are 8 mm and more
  }
}

TEST(WorldCamera, TheBottomCameraLooksDownAsItsDriverSays) {
  const CameraChoice& bottom = cameraNamed("bottom");
  EXPECT_TRUE((bottom.T_body_cam.linear().col(2)).isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE((bottom.T_body_cam.linear().col(0)).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_NEAR(bottom.T_body_cam.linear().determinant(), 1, 1e-12);
}

TEST(WorldCamera, CamerasHaveTheirFieldsOfView) {
  const auto across_deg = [](const std::string& name) {
    const CameraIntrinsics& c = cameraNamed(name).intrinsics;
    Eigen::Vector3d first, last;
    EXPECT_TRUE(exactDirection(c, {0, 0}, first));
    EXPECT_TRUE(exactDirection(c, {c.width_px, c.height_px}, last));
    return std::acos(first.normalized().dot(last.normalized())) * 180 / M_PI;
  };
  EXPECT_NEAR(across_deg("front"), 80, 1);
  EXPECT_NEAR(across_deg("front_wide"), 92, 0.5);
  EXPECT_NEAR(across_deg("bottom"), 64, 0.5);
  for (const char* name : {"front_wide", "bottom"}) {
    const CameraModel model(cameraNamed(name).intrinsics);
    EXPECT_GT(model.foldRadius(), 1.03) << name;
  }
}

TEST(WorldCamera, ADronesPathGoesOnAsItsStateDoes) {
  const auto flight = makeFlight("fast_blur", std::nullopt);
  const Eigen::Isometry3d T_body_cam = arDroneFrontMount();
  for (double t_s = 22; t_s < 50; t_s += 0.7) {
    const CameraPath path = pathThrough(flight->state(t_s), T_body_cam);
    for (const double offset_s : {-0.02, 0.0, 0.02}) {
      const Eigen::Isometry3d truth = flight->pose(t_s + offset_s) * T_body_cam;
      EXPECT_LT((path(offset_s).translation() - truth.translation()).norm(), 1e-3);
      const Eigen::Matrix3d off = path(offset_s).linear().transpose() * truth.linear();
      EXPECT_LT(Eigen::AngleAxisd(off).angle(), 2e-3) << "of 0.05 rad on the way";
    }
  }
}

TEST(WorldCamera, GainBrightensAndAmplifiesNoise) {
  const World world = makeWorld("room", "fading", 0);
  CameraEffects effects;
  const cv::Mat dim = shoot(world.at(40), effects);
  effects.gain = 2;
  const cv::Mat bright = shoot(world.at(40), effects);
  EXPECT_NEAR(meanOf(bright), 2 * meanOf(dim), 1.5);
  const auto noiseOf = [&](double gain) {
    CameraEffects noisy, clean = noiseless();
    noisy.gain = clean.gain = gain;
    cv::Mat difference;
    cv::subtract(shoot(world.at(40), noisy), shoot(world.at(40), clean), difference, cv::noArray(),
                 CV_32F);
    cv::Scalar mean, sigma;
    cv::meanStdDev(difference, mean, sigma);
    return sigma[0];
  };
  EXPECT_NEAR(noiseOf(2), 4, 0.3);
  EXPECT_NEAR(noiseOf(1), 2, 0.2);
}

TEST(WorldCamera, AutomaticGainReachesForAMeanGrey) {
  const World world = makeWorld("room", "fading", 0);
  CameraEffects effects = noiseless();
  effects.gain.reset();
  EXPECT_NEAR(meanOf(shoot(world.at(40), effects)), 110, 8);
  EXPECT_NEAR(meanOf(shoot(world.at(5), effects)), 110, 8);
  EXPECT_LT(meanOf(shoot(world.at(25), effects)), 40) << "it has its limit";
}

TEST(BlockArtefacts, GrowWithTheQuantiserAndLieInBlocks) {
  const cv::Mat image = shoot(makeWorld("room", "steady", 0).at(0), noiseless());
  double last = 0;
  for (const int quantiser : {10, 22, 34, 46}) {
    cv::Mat coded = image.clone();
    addBlockArtefacts(quantiser, coded);
    const double difference = meanDifference(image, coded);
    EXPECT_GT(difference, 1.2 * last) << quantiser;
    last = difference;
  }
  EXPECT_LT(last, 20);
  cv::Mat coded = image.clone();
  addBlockArtefacts(40, coded);
  // Steps between neighbours: larger across the blocks' borders than within them, unlike before.
  const auto stepRatio = [](const cv::Mat& picture) {
    double within = 0, across = 0;
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 4; x + 1 < picture.cols; ++x) {
        const double step =
            std::abs(picture.at<std::uint8_t>(y, x) - picture.at<std::uint8_t>(y, x - 1));
        (x % 4 == 0 ? across : within) += step / (x % 4 == 0 ? 1 : 3);
      }
    }
    return across / within;
  };
  EXPECT_NEAR(stepRatio(image), 1, 0.05);
  EXPECT_GT(stepRatio(coded), 1.3);
}

TEST(BlockArtefacts, LeaveAPlainPictureAndOddBordersAlone) {
  cv::Mat plain(30, 33, CV_8UC1, cv::Scalar(128));
  const cv::Mat before = plain.clone();
  addBlockArtefacts(51, plain);
  EXPECT_EQ(cv::norm(plain, before, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace ardrone_vslam
