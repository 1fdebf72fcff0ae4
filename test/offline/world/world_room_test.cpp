// SPDX-License-Identifier: BSD-3-Clause
// What the room is made of: textures, painting, the box of its surfaces.
#include "world/scene/world_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>
#include <vector>

#include "world/scene/world_furniture.hpp"
#include "world/scene/world_paint.hpp"
#include "world/scene/world_posters.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam {
namespace {

TEST(MipTexture, FineDetailSeenFromAfarIsGreyAndNotAliased) {
  cv::Mat checks(512, 512, CV_8UC1);
  for (int y = 0; y < checks.rows; ++y) {
    for (int x = 0; x < checks.cols; ++x) checks.at<std::uint8_t>(y, x) = (x + y) % 2 ? 255 : 0;
  }
  const MipTexture texture(checks);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2f at(20.0F + 1.37F * static_cast<float>(i), 100.3F);
    EXPECT_NEAR(texture.sample(at, {3.1F, 0}, {0, 3.1F}), 127.5F, 2);
    EXPECT_NEAR(texture.sample(at, {2.1F, 2.1F}, {-9, 9}), 127.5F, 2);
  }
}

TEST(MipTexture, KeepsSharpWhatIsNear) {
  cv::Mat edge(64, 64, CV_8UC1, cv::Scalar(0));
  edge.colRange(32, 64).setTo(200);
  const MipTexture texture(edge);
  const Eigen::Vector2f right(0.8F, 0), down(0, 0.8F);
  EXPECT_FLOAT_EQ(texture.sample({31.4F, 20}, right, down), 0);
  EXPECT_NEAR(texture.sample({32, 20}, right, down), 100, 0.01);
  EXPECT_FLOAT_EQ(texture.sample({32.6F, 20}, right, down), 200);
  // Seen flat: the edge stays sharp across although each pixel is eight texels long.
  EXPECT_LT(texture.sample({30.5F, 20}, right, {0, 8}), 25);
}

/// In metres, of what is painted in these texels.
Eigen::Vector2d centroid(const cv::Mat& picture, const cv::Rect& texels) {
  const cv::Moments m = cv::moments(picture(texels));
  return Eigen::Vector2d(texels.x + 0.5 + m.m10 / m.m00, texels.y + 0.5 + m.m01 / m.m00) /
         Painter::kTexelsPerMetre;
}

TEST(Painter, PutsThingsWhereItIsTold) {
  Painter painter(1, 1, 0, 0);
  painter.fill({0, 0, 1, 1}, 0);
  painter.ellipse({0.3, 0.4}, {0.05, 0.05}, 0, 255);
  painter.polygon({{0.6, 0.6}, {0.8, 0.6}, {0.8, 0.8}, {0.6, 0.8}}, 255);
  const Eigen::Vector2d ellipse = centroid(painter.picture(), {50, 75, 50, 50});
  const Eigen::Vector2d square = centroid(painter.picture(), {130, 130, 90, 90});
  EXPECT_LT((ellipse - Eigen::Vector2d(0.3, 0.4)).norm(), 0.001);
  // OpenCV's polygons are up to a texel larger on two sides.
  EXPECT_LT((square - Eigen::Vector2d(0.7, 0.7)).norm(), 0.003);
}

Eigen::Isometry3d lookAround(int view) {
  const auto turn = [&](double angle_rad, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle_rad, axis);
  };
  return Eigen::Translation3d(1.3, -0.7, 1.1) * turn(0.26 * view, Eigen::Vector3d::UnitZ()) *
         turn(1 - 0.09 * view, Eigen::Vector3d::UnitY()) *
         turn(0.23 * view, Eigen::Vector3d::UnitX()) * forwardCamera();
}

TEST(WorldRoom, ItsSurfacesCloseTheBoxSeenFromInside) {
  Scene room = makeRoom(0);
  ASSERT_EQ(room.surfaces.size(), 6U);
  std::set<std::vector<long>> corners;
  const Eigen::Vector3d middle(0, 0, kRoomHeight_m / 2);
  const auto white = std::make_shared<MipTexture>(cv::Mat(64, 64, CV_8UC1, cv::Scalar(200)));
  for (auto& surface : room.surfaces) {
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d corner = surface.corner + surface.right * (i % 2) * surface.width_m +
                                     surface.down * (i / 2) * surface.height_m;
      corners.insert({std::lround(corner.x() * 1e6), std::lround(corner.y() * 1e6),
                      std::lround(corner.z() * 1e6)});
    }
    EXPECT_GT(surface.right.cross(surface.down).dot(surface.corner - middle), 0);
    surface.texture = white;
  }
  EXPECT_EQ(corners.size(), 8U);
  const WorldRenderer renderer(arDroneFrontCamera(), 0);
  for (int i = 0; i < 24; ++i) {
    const cv::Mat image = renderer.render(room, lookAround(i), 0);
    EXPECT_EQ(cv::countNonZero(image != 200), 0) << "view " << i;
  }
}

bool looksAlike(const Surface& a, const Surface& b) {
  const Eigen::Vector2f right(1, 0), down(0, 1);
  for (int i = 0; i < 400; ++i) {
    const int row = i / 20;
    const Eigen::Vector2f at(10 + 7.3F * static_cast<float>(i % 20),
                             10 + 5.1F * static_cast<float>(row));
    if (a.texture->sample(at, right, down) != b.texture->sample(at, right, down)) return false;
  }
  return true;
}

TEST(HotelRoom, HasItsOwnWallsAndTheFurnitureOfAllOthers) {
  const Scene one = makeHotelRoom(1), other = makeHotelRoom(2);
  constexpr std::size_t kWalls = 6;  // with floor and ceiling
  ASSERT_EQ(one.surfaces.size(), other.surfaces.size());
  ASSERT_GT(one.surfaces.size(), kWalls);
  for (std::size_t i = 0; i < one.surfaces.size(); ++i) {
    EXPECT_EQ(looksAlike(one.surfaces[i], other.surfaces[i]), i >= kWalls) << i;
    EXPECT_EQ(one.surfaces[i].corner, other.surfaces[i].corner) << i;
  }
}

TEST(HotelRoom, ItsPostersAreTheSameForEverySeed) {
  constexpr double kWall_m = 30, kPoster_m = 0.5;
  const auto posters = [&](std::uint64_t seed) {
    Painter painter(kWall_m, kPoster_m, seed, 0);
    std::vector<std::vector<std::uint8_t>> pictures;
    for (double x = 0; x + kPoster_m <= kWall_m; x += kPoster_m) {
      painter.fill({x, 0, kPoster_m, kPoster_m}, 0);
      paintPosterOfCatalogue(painter, {x, 0, kPoster_m, kPoster_m});
      const auto texels = [](double m) { return static_cast<int>(m * Painter::kTexelsPerMetre); };
      const cv::Mat poster =
          painter.picture()({texels(x), 0, texels(kPoster_m), texels(kPoster_m)}).clone();
      pictures.emplace_back(poster.datastart, poster.dataend);
    }
    return pictures;
  };
  const auto one = posters(1), other = posters(2);
  EXPECT_NE(one, other);  // in another order
  const std::set<std::vector<std::uint8_t>> ones(one.begin(), one.end());
  EXPECT_LE(ones.size(), 30U);  // of 60: 24, and a few twice, where a texel is rounded otherwise
  const auto known = std::count_if(other.begin(), other.end(),
                                   [&](const auto& poster) { return ones.count(poster) > 0; });
  EXPECT_GT(known, 40);  // of 60
}

}  // namespace
}  // namespace ardrone_vslam
