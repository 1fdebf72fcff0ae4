// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "arc_corners.hpp"
#include "measurements.hpp"
#include "pictures.hpp"

namespace ardrone_vslam::reproduction {
namespace {

constexpr double kNoise_grey = 12;
constexpr std::size_t kBudgets[] = {100, 250, 500, 1000};

/// The strongest corners, those of equal score in raster order.
std::vector<Eigen::Vector2d> strongest(const std::vector<Corner>& ranked, std::size_t budget) {
  std::vector<Eigen::Vector2d> pixels;
  for (std::size_t i = 0; i < std::min(budget, ranked.size()); ++i)
    pixels.emplace_back(ranked[i].x_px, ranked[i].y_px);
  return pixels;
}

std::vector<Corner> rankedCorners(const cv::Mat& image, int arc_length_px) {
  auto corners = arcCorners(image, arc_length_px, 1);
  const auto isOutside = [&](const Corner& c) {
    const auto border = static_cast<int>(quality::kBorder_px);
    return c.x_px < border || c.y_px < border || c.x_px >= image.cols - border ||
           c.y_px >= image.rows - border;
  };
  corners.erase(std::remove_if(corners.begin(), corners.end(), isOutside), corners.end());
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.score > b.score; });
  return corners;
}

}  // namespace

nlohmann::json measureRepeatability(bool quick) {
  const PicturePair& wall = wallPictures();
  nlohmann::json json = {{"what", wall.what}, {"noise_grey", kNoise_grey}};
  for (const double noise_grey : {0.0, kNoise_grey}) {
    const cv::Mat first = withNoise(wall.first, noise_grey, 1);
    const cv::Mat second = withNoise(wall.second, noise_grey, 2);
    for (int s = 9; s <= 16; ++s) {
      if (quick && s != 9 && s != 12 && s != 16) continue;
      const auto first_corners = rankedCorners(first, s);
      const auto second_corners = rankedCorners(second, s);
      for (const std::size_t budget : kBudgets) {
        if (quick && budget != 500) continue;
        const quality::PairTruth truth(strongest(first_corners, budget),
                                       strongest(second_corners, budget), wall.geometry);
        json["points"].push_back({{"s", s},
                                  {"noise_grey", noise_grey},
                                  {"budget", budget},
                                  {"corners", std::min(first_corners.size(), budget)},
                                  {"repeatability", truth.measure({}).repeatability}});
      }
    }
  }
  return json;
}

}  // namespace ardrone_vslam::reproduction
