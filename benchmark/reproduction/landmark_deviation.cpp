// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "map/triangulation.hpp"
#include "measurements.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam::reproduction {
namespace {

// Table D.1.
constexpr double kPosition_m = 0.01;
constexpr double kAngle_rad = 0.001;
constexpr double kBaseline_m = 1;
constexpr std::size_t kDrawn = 600;  // points of the picture

/// A unit vector turned a little, by angles about both axes across it.
Eigen::Vector3d disturbed(const Eigen::Vector3d& direction, RandomSource& random) {
  const Eigen::Vector3d across = direction.unitOrthogonal();
  return (direction +
          kAngle_rad * (random.normal() * across + random.normal() * direction.cross(across)))
      .normalized();
}

Ray disturbed(const Ray& ray, RandomSource& random) {
  return {ray.origin_map + kPosition_m * random.normal3(), disturbed(ray.direction_map, random)};
}

nlohmann::json atAngle(double theta_deg, int runs) {
  // The rays meet half a baseline to the side, under 2 theta.
  const auto turned = [&](double sign) {
    return Eigen::AngleAxisd(sign * theta_deg * M_PI / 180, Eigen::Vector3d::UnitZ()) *
           Eigen::Vector3d::UnitY();
  };
  const Ray first{{0, 0, 0}, turned(-1)}, present{{kBaseline_m, 0, 0}, turned(1)};
  const TriangulatedPoint truth = *triangulate(first, present);
  RandomSource random(2);
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector2d squares_image = Eigen::Vector2d::Zero();
  double squares_across = 0, squares_along = 0;
  int found = 0;
  nlohmann::json cloud = nlohmann::json::array();
  for (int run = 0; run < runs; ++run) {
    const auto point = triangulate(disturbed(first, random), disturbed(present, random));
    if (!point) continue;
    ++found;
    const Eigen::Vector3d error = point->position_map - truth.position_map;
    squares += error.cwiseAbs2();
    // On the image plane at y = 1 before the present position (figure D.3).
    const Eigen::Vector3d seen = point->position_map - present.origin_map;
    const Eigen::Vector3d expected = truth.position_map - present.origin_map;
    const Eigen::Vector2d image(seen.x() / seen.y() - expected.x() / expected.y(),
                                seen.z() / seen.y());
    squares_image += image.cwiseAbs2();
    const double along = error.dot(present.direction_map);
    squares_along += along * along;
    squares_across += (error.squaredNorm() - along * along) / 2;  // per axis
    if (cloud.size() < kDrawn)
      cloud.push_back({error.x(), error.y(), error.z(), image.x(), image.y()});
  }
  const Eigen::Vector3d deviation = (squares / found).cwiseSqrt();
  const Eigen::Vector2d deviation_image = (squares_image / found).cwiseSqrt();
  const double formula_m = measurementSigma_m(kPosition_m, truth.depth_m, kAngle_rad);
  return {{"theta_deg", theta_deg},
          {"parallax_deg", 2 * theta_deg},
          {"depth_m", truth.depth_m},
          {"without_point", runs - found},
          {"sigma_m", {deviation.x(), deviation.y(), deviation.z()}},
          {"across_m", std::sqrt(squares_across / found)},
          {"along_m", std::sqrt(squares_along / found)},
          {"image", {deviation_image.x(), deviation_image.y()}},
          {"formula_m", formula_m},
          {"formula_along_m", depthSigma_m(formula_m, truth.parallax_rad)},
          {"cloud", cloud}};
}

}  // namespace

nlohmann::json measureLandmarkDeviation(bool quick) {
  const int runs = quick ? 2000 : 20000;
  nlohmann::json json = {{"runs", runs}};
  for (const double theta_deg : {45.0, 20.0, 5.0, 1.0})
    json["angles"].push_back(atAngle(theta_deg, runs));
  return json;
}

}  // namespace ardrone_vslam::reproduction
