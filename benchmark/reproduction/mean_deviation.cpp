// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <vector>

#include "map/landmark_locator.hpp"
#include "measurements.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam::reproduction {
namespace {

constexpr double kExponent = 0.7642;

/// (6.5) with the weights a sigma^-b that appendix C fitted; `a` cancels.
double printedDeviation(const std::vector<double>& sigmas) {
  double above = 0, below = 0;
  for (const double sigma : sigmas) {
    const double weight = std::pow(sigma, -kExponent);
    above += weight * weight * sigma * sigma;
    below += weight * weight;
  }
  return std::sqrt(above / below);
}

/// The same with W the square of the sum, as a mean has it.
double mendedDeviation(const std::vector<double>& sigmas) {
  double above = 0, sum = 0;
  for (const double sigma : sigmas) {
    const double weight = std::pow(sigma, -kExponent);
    above += weight * weight * sigma * sigma;
    sum += weight;
  }
  return std::sqrt(above) / sum;
}

/// (C.2), which the thesis makes of (C.1) with the weights 1 / sigma.
double reducedDeviation(const std::vector<double>& sigmas) {
  double sum = 0;
  for (const double sigma : sigmas) sum += 1 / sigma;
  return std::sqrt(static_cast<double>(sigmas.size()) / sum);
}

/// (C.1) with the weights 1 / sigma: the "conventional" one of figure C.1.
double conventionalDeviation(const std::vector<double>& sigmas) {
  double below = 0;
  for (const double sigma : sigmas) below += 1 / (sigma * sigma);
  return std::sqrt(static_cast<double>(sigmas.size()) / below);
}

/// What the package says: a fix of landmarks straight ahead, whose errors across the ray are the
/// positions' (a mean over one axis of it, as appendix C).
double packageDeviation(const std::vector<double>& sigmas) {
  ThesisFilterConfig config;
  config.min_landmarks = 1;
  config.fix_sigma_floor_m = 0;
  config.fix_angle_floor_deg = 0;
  std::vector<Observation> observations;
  for (const double sigma : sigmas) observations.push_back({{5, 0, 0}, {1, 0, 0}, sigma, 0});
  const auto fix = LandmarkLocator(config).locate(observations, Eigen::Vector3d::Zero(), 0);
  return std::sqrt(fix->covariance(1, 1));
}

/// The scatter of the weighted mean (6.4).
double scatter(const std::vector<double>& sigmas, int runs, RandomSource& random) {
  double weights = 0;
  for (const double sigma : sigmas) weights += 1 / sigma;
  double squares = 0;
  for (int run = 0; run < runs; ++run) {
    double sum = 0;
    for (std::size_t i = 0; i < sigmas.size(); ++i) sum += random.normal();  // sigma over sigma
    squares += sum * sum / (weights * weights);
  }
  return std::sqrt(squares / runs);
}

struct Fix {
  double error_m = 0, claimed_m = 0;
};

/// The observer is half a metre off along the optical axis: what the fix leaves of it.
Fix fixOfWrongObserver(MeanKind mean, int runs) {
  ThesisFilterConfig config;
  config.mean = mean;
  config.min_landmarks = 1;
  config.fix_sigma_floor_m = 0;
  config.fix_angle_floor_deg = 0;
  config.outlier_sigmas = 0;
  const LandmarkLocator locator(config);
  Fix fix;
  for (int run = 0; run < runs; ++run) {
    RandomSource random(static_cast<std::uint64_t>(run));
    std::vector<Observation> observations;
    for (int i = 0; i < 50; ++i) {
      const double y = std::tan(random.uniform(-40, 40) * M_PI / 180);
      const double z = std::tan(random.uniform(-26, 26) * M_PI / 180);
      Observation s;
      s.direction_map = Eigen::Vector3d(1, y, z).normalized();
      s.landmark_map = random.uniform(2, 10) * s.direction_map + 0.02 * random.normal3();
      s.landmark_sigma_m = 0.02;
      observations.push_back(s);
    }
    const auto found = locator.locate(observations, {0.5, 0, 0}, 1.0 / 570);
    fix.error_m += std::abs(found->position_map.x()) / runs;
    fix.claimed_m += std::sqrt(found->covariance(0, 0)) / runs;
  }
  return fix;
}

}  // namespace

nlohmann::json measureMeanDeviation(bool quick) {
  const int inputs = quick ? 5 : 50, runs = quick ? 1000 : 5000;
  nlohmann::json json = {{"inputs", inputs}, {"runs", runs}};
  RandomSource random(1);
  for (const int count : {1, 2, 3, 5, 8, 12, 20, 30, 50, 75, 100}) {
    double truth = 0, printed = 0, mended = 0, reduced = 0, conventional = 0, exact = 0;
    for (int input = 0; input < inputs; ++input) {
      std::vector<double> sigmas;
      for (int i = 0; i < count; ++i) sigmas.push_back(random.uniform(0.01, 1));
      const double true_deviation = scatter(sigmas, runs, random);
      truth += true_deviation / inputs;
      printed += std::abs(printedDeviation(sigmas) - true_deviation) / inputs;
      mended += std::abs(mendedDeviation(sigmas) - true_deviation) / inputs;
      reduced += std::abs(reducedDeviation(sigmas) - true_deviation) / inputs;
      conventional += std::abs(conventionalDeviation(sigmas) - true_deviation) / inputs;
      exact += std::abs(packageDeviation(sigmas) - true_deviation) / inputs;
    }
    json["against_landmarks"].push_back({{"landmarks", count},
                                         {"sigma_m", truth},
                                         {"error_printed_m", printed},
                                         {"error_mended_m", mended},
                                         {"error_reduced_m", reduced},
                                         {"error_conventional_m", conventional},
                                         {"error_exact_m", exact}});
  }
  for (const auto& [name, mean] :
       {std::pair("printed", MeanKind::kPrinted), std::pair("exact", MeanKind::kExact)}) {
    const Fix fix = fixOfWrongObserver(mean, quick ? 50 : 500);
    json["wrong_observer"][name] = {{"error_m", fix.error_m}, {"claimed_m", fix.claimed_m}};
  }
  return json;
}

}  // namespace ardrone_vslam::reproduction
