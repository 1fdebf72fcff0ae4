// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/relocation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"
#include "map_update/level_pose.hpp"
#include "map_update/observation_rays.hpp"
#include "window/rays.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kMostSamples = 1000;  // a tenth of right matches are found in nearly every frame
constexpr double kLeastAttitude_rad = 0.0175;
constexpr double kParallelSine = 0.03;           // of two rays that tell no distance
constexpr double kMostByChanceWhileLost = 1e-6;  // a lost drone asks in every frame
constexpr std::size_t kFewest = 4;               // three of them are taken by the pose

enum class Heading { kPredicted, kUnknown };

class Relocator {
 public:
  Relocator(const Clone& predicted, const Eigen::Vector3d& camera_rig,
            const std::vector<MapObservation>& observations, double sigma_a, double attitude_rad,
            Heading heading = Heading::kPredicted)
      : predicted_(predicted),
        camera_rig_(camera_rig),
        observations_(observations),
        sigma_a_(sigma_a),
        attitude_rad_(std::max(attitude_rad, kLeastAttitude_rad)),
        heading_(heading) {}

  /// The pose that most observations agree with, and which; nothing when chance explains it.
  std::optional<ObservationConsensus> consensus() const;
  /// @return the pose that most observations agree with
  std::optional<Clone> search() const;
  std::vector<std::size_t> agreeing(const Clone& pose, double slack_rad) const;
  /// Probability that a wrong match agrees with a pose.
  double shareByChance(const Clone& pose) const;

 private:
  /// The poses that a pair gives: one, or two where the heading is unknown.
  template <class Visit>
  void forEachPose(std::size_t a, std::size_t b, const Visit& visit) const;
  std::optional<Clone> poseOf(std::size_t a, std::size_t b) const;
  Clone refined(Clone pose) const;
  double off(const Clone& pose, std::size_t i, double slack_rad) const {
    return offRay(observations_[i], pose.R_map_rig * observations_[i].bearing_rig,
                  pose.position_map + pose.R_map_rig * camera_rig_, sigma_a_, slack_rad);
  }
  double score(const Clone& pose, double slack_rad) const {
    double sum = 0;
    for (std::size_t i = 0; i < observations_.size(); ++i)
      sum += std::max(0.0, 1 - off(pose, i, slack_rad) / kInlier);
    return sum;
  }

  const Clone& predicted_;
  const Eigen::Vector3d& camera_rig_;
  const std::vector<MapObservation>& observations_;
  double sigma_a_;
  double attitude_rad_;
  Heading heading_;
};

template <class Visit>
void Relocator::forEachPose(std::size_t a, std::size_t b, const Visit& visit) const {
  if (heading_ == Heading::kPredicted) {
    if (const auto pose = poseOf(a, b)) visit(*pose);
    return;
  }
  const MapObservation& one = observations_[a];
  const MapObservation& other = observations_[b];
  for (const LevelPose& level :
       posesOfPair(predicted_.R_map_rig * one.bearing_rig, one.point_map,
                   predicted_.R_map_rig * other.bearing_rig, other.point_map)) {
    Clone pose = predicted_;
    pose.R_map_rig = rotationAboutZ(level.heading_rad) * predicted_.R_map_rig;
    pose.position_map = level.camera_map - pose.R_map_rig * camera_rig_;
    visit(pose);
  }
}

std::optional<Clone> Relocator::poseOf(std::size_t a, std::size_t b) const {
  const Eigen::Vector3d ray_a = predicted_.R_map_rig * observations_[a].bearing_rig;
  const Eigen::Vector3d ray_b = predicted_.R_map_rig * observations_[b].bearing_rig;
  if (!(ray_a.cross(ray_b).norm() > kParallelSine)) return std::nullopt;
  const Eigen::Vector3d camera = nearestToRays(observations_[a], ray_a, observations_[b], ray_b);
  if (!camera.allFinite()) return std::nullopt;
  Clone pose = predicted_;
  pose.position_map = camera - predicted_.R_map_rig * camera_rig_;
  // Two rays have one angle to spare: most wrong pairs end here.
  if (!(off(pose, a, attitude_rad_) < kInlier && off(pose, b, attitude_rad_) < kInlier))
    return std::nullopt;
  return pose;
}

Clone Relocator::refined(Clone pose) const {
  // The prediction's attitude errs alike for all, so it is found; then what agrees is told better.
  const Eigen::Matrix3d R_prior = pose.R_map_rig;
  for (const double slack_rad : {attitude_rad_, 0.5 * attitude_rad_, kSlack_rad, kSlack_rad}) {
    Matrix6d matrix = Matrix6d::Zero();
    Vector6d vector = Vector6d::Zero();
    Eigen::Vector3d weights = Eigen::Vector3d::Constant(1 / (attitude_rad_ * attitude_rad_));
    if (heading_ == Heading::kUnknown) weights.z() = 0;
    matrix.diagonal().tail<3>() = weights;
    vector.tail<3>() = weights.cwiseProduct(rotationVectorOf(R_prior * pose.R_map_rig.transpose()));
    for (const std::size_t i : agreeing(pose, slack_rad)) {
      const MapObservation& s = observations_[i];
      const auto ray = rayResidual(pose, camera_rig_, s.bearing_rig, s.point_map);
      if (!ray) continue;
      const Eigen::Matrix2d noise = sigma_a_ * sigma_a_ * Eigen::Matrix2d::Identity() +
                                    ray->point * s.covariance_m2 * ray->point.transpose();
      const Eigen::Matrix<double, 6, 2> weighted = ray->pose.transpose() * noise.inverse();
      matrix += weighted * ray->pose;
      vector += weighted * ray->residual;
    }
    const Vector6d step = matrix.ldlt().solve(vector);
    if (!step.allFinite()) break;
    pose.position_map += step.head<3>();
    pose.R_map_rig = rotationOf(step.tail<3>()) * pose.R_map_rig;
  }
  return pose;
}

std::vector<std::size_t> Relocator::agreeing(const Clone& pose, double slack_rad) const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    if (off(pose, i, slack_rad) < kInlier) indices.push_back(i);
  }
  return indices;
}

std::optional<Clone> Relocator::search() const {
  std::optional<Clone> best;
  double best_rough = 0;
  double best_score = 0;
  double samples = kMostSamples;
  const auto judge = [&](const Clone& pose) {
    const double rough = score(pose, attitude_rad_);
    if (rough <= best_rough) return;
    best_rough = rough;
    const Clone better = refined(pose);
    const double its_score = score(better, kSlack_rad);
    if (its_score <= best_score) return;
    best_score = its_score;
    best = better;
    // Until two right ones have been drawn with a probability of 0.999; of these every other pair
    // lies well.
    const double share = its_score / static_cast<double>(observations_.size());
    samples = std::min(samples, portable::log(0.001) / portable::log1p(-0.5 * share * share));
  };
  Draws draws;
  for (int k = 0; k < samples; ++k) {
    const std::size_t a = draws.below(observations_.size());
    const std::size_t b = draws.below(observations_.size());
    if (a == b) continue;
    forEachPose(a, b, judge);
  }
  return best;
}

double Relocator::shareByChance(const Clone& pose) const {
  const Eigen::Vector3d camera = pose.position_map + pose.R_map_rig * camera_rig_;
  const std::size_t count = observations_.size();
  // Anywhere in its window ..
  double by_window = 0;
  for (const MapObservation& s : observations_) {
    const Eigen::Vector3d offset = s.point_map - camera;
    const double sigmas_rad2 = acrossSigmas_rad2(s, offset, sigma_a_, kSlack_rad);
    by_window += std::min(1.0, kInlier * sigmas_rad2 / (s.window_rad * s.window_rad));
  }
  // .. but corners and landmarks stand in groups: so often do the same ones agree in other pairs.
  constexpr std::size_t kRounds = 20;
  std::size_t trials = 0;
  std::size_t by_pairs = 0;
  for (std::size_t round = 1; round <= kRounds; ++round) {
    const std::size_t shift = round * count / (kRounds + 1);
    if (shift == 0) continue;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d ray = pose.R_map_rig * observations_[(i + shift) % count].bearing_rig;
      by_pairs += offRay(observations_[i], ray, camera, sigma_a_, kSlack_rad) < kInlier ? 1U : 0U;
      ++trials;
    }
  }
  return std::max(by_window / static_cast<double>(count),
                  static_cast<double>(by_pairs + 1) / static_cast<double>(trials + 1));
}

}  // namespace

double agreementsByChance(std::size_t matches, std::size_t agreeing, double share) {
  const double poses = static_cast<double>(matches) * static_cast<double>(matches) *
                       static_cast<double>(matches) / 6;
  if (agreeing < kFewest || matches < agreeing || !(share < 1)) return poses;
  const double others = static_cast<double>(matches - 3);
  const double q = static_cast<double>(agreeing - 3) / others;
  if (q <= share) return poses;
  double divergence = q * portable::log(q / share);
  if (q < 1) divergence += (1 - q) * portable::log((1 - q) / (1 - share));
  return poses * portable::exp(-others * divergence);
}

bool chanceExplains(const Clone& pose, const Eigen::Vector3d& camera_rig,
                    const std::vector<MapObservation>& observations, std::size_t agreeing,
                    double angle_sigma_rad, double most_by_chance) {
  const Relocator relocator(pose, camera_rig, observations, angle_sigma_rad, 0);
  return agreementsByChance(observations.size(), agreeing, relocator.shareByChance(pose)) >
         most_by_chance;
}

std::optional<ObservationConsensus> Relocator::consensus() const {
  if (observations_.size() < kFewest) return std::nullopt;
  const auto pose = search();
  if (!pose) return std::nullopt;
  const std::vector<std::size_t> indices = agreeing(*pose, kSlack_rad);
  if (chanceExplains(*pose, camera_rig_, observations_, indices.size(), sigma_a_,
                     kMostByChanceWhileLost))
    return std::nullopt;
  ObservationConsensus consensus;
  consensus.position_map = pose->position_map;
  consensus.R_map_rig = pose->R_map_rig;
  for (const std::size_t i : indices) consensus.observations.push_back(observations_[i]);
  return consensus;
}

std::optional<ObservationConsensus> relocate(const Clone& predicted,
                                             const Eigen::Vector3d& camera_rig,
                                             const std::vector<MapObservation>& observations,
                                             double angle_sigma_rad, double attitude_sigma_rad) {
  return Relocator(predicted, camera_rig, observations, angle_sigma_rad, attitude_sigma_rad)
      .consensus();
}

std::optional<ObservationConsensus> relocateAnywhere(
    const Clone& gravity, const Eigen::Vector3d& camera_rig,
    const std::vector<MapObservation>& observations, double angle_sigma_rad,
    double tilt_sigma_rad) {
  return Relocator(gravity, camera_rig, observations, angle_sigma_rad, tilt_sigma_rad,
                   Heading::kUnknown)
      .consensus();
}

}  // namespace ardrone_vslam
