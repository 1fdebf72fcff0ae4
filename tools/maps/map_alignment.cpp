// SPDX-License-Identifier: BSD-3-Clause
#include "maps/map_alignment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

#include "ardrone_vslam/rotation.hpp"
#include "maps/map_parts.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kNoDistance_bits = 513;

int distance_bits(const DescriptorBits& a, const DescriptorBits& b) {
  int bits = 0;
  for (std::size_t i = 0; i < a.words.size(); ++i)
    bits += __builtin_popcountll(a.words[i] ^ b.words[i]);
  return bits;
}

/// The nearest one so far, and how near the second is.
struct Nearest {
  std::size_t index = 0;
  int bits = kNoDistance_bits;
  int second_bits = kNoDistance_bits;

  void offer(std::size_t other, int other_bits) {
    if (other_bits < bits) {
      second_bits = bits;
      bits = other_bits;
      index = other;
    } else {
      second_bits = std::min(second_bits, other_bits);
    }
  }
  bool isClear() const {
    constexpr int kMost_bits = 120;
    constexpr double kRatio = 0.85;
    return bits <= kMost_bits && bits < kRatio * second_bits;
  }
};

/// Both landmarks of a pair, b's in its own map.
struct Points {
  Eigen::Vector3d of_a;
  Eigen::Vector3d of_b;
  Eigen::Matrix3d covariance_a_m2;
  Eigen::Matrix3d covariance_b_m2;
};

std::vector<Points> pointsOf(const SavedMap& a, const SavedMap& b,
                             const std::vector<LandmarkPair>& pairs) {
  std::vector<Points> points;
  for (const LandmarkPair& pair : pairs) {
    const Landmark& of_a = a.landmarks[pair.of_a];
    const Landmark& of_b = b.landmarks[pair.of_b];
    points.push_back(
        {of_a.position_map, of_b.position_map,
         covarianceOf(a, of_a) + kOtherView_m * kOtherView_m * Eigen::Matrix3d::Identity(),
         covarianceOf(b, of_b)});
  }
  return points;
}

Eigen::Matrix3d weightOf(const Points& points, const Eigen::Matrix3d& R_a_b) {
  const Eigen::Matrix3d S =
      points.covariance_a_m2 + R_a_b * points.covariance_b_m2 * R_a_b.transpose();
  return S.inverse();
}

bool agree(const Points& points, const Eigen::Isometry3d& T_a_b) {
  constexpr double kMost = 11.345;  // of chi-square with three degrees of freedom, 99 %
  const Eigen::Vector3d rest = points.of_a - T_a_b * points.of_b;
  return rest.dot(weightOf(points, T_a_b.linear()) * rest) < kMost;
}

std::vector<std::size_t> agreeingOf(const std::vector<Points>& points,
                                    const Eigen::Isometry3d& T_a_b) {
  std::vector<std::size_t> agreeing;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (agree(points[i], T_a_b)) agreeing.push_back(i);
  }
  return agreeing;
}

/// By two points that are apart as far in both maps. @return false where they are not
bool byTwo(const Points& first, const Points& second, Eigen::Isometry3d& T_a_b) {
  constexpr double kLeastApart_m = 0.3;
  constexpr double kMostStretch = 0.3;  // as maps may differ in scale
  const Eigen::Vector3d in_a = second.of_a - first.of_a;
  const Eigen::Vector3d in_b = second.of_b - first.of_b;
  const double apart_m = std::max(in_a.head<2>().norm(), in_b.head<2>().norm());
  const double stretch_m = std::abs(in_a.head<2>().norm() - in_b.head<2>().norm());
  if (apart_m < kLeastApart_m || stretch_m > kMostStretch * apart_m ||
      std::abs(in_a.z() - in_b.z()) > kMostStretch * apart_m)
    return false;
  const double heading_rad = std::atan2(in_a.y(), in_a.x()) - std::atan2(in_b.y(), in_b.x());
  T_a_b.linear() = rotationAboutZ(heading_rad);
  T_a_b.translation() =
      0.5 * (first.of_a + second.of_a - T_a_b.linear() * (first.of_b + second.of_b));
  return true;
}

/// One step of Gauss and Newton about the middle of the points.
void improve(const std::vector<Points>& points, const std::vector<std::size_t>& agreeing,
             Eigen::Isometry3d& T_a_b) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::size_t i : agreeing)
    middle += points[i].of_a / static_cast<double>(agreeing.size());
  Eigen::Matrix4d information = Eigen::Matrix4d::Identity() * 1e-9;
  Eigen::Vector4d vector = Eigen::Vector4d::Zero();
  for (const std::size_t i : agreeing) {
    const Eigen::Vector3d in_a = T_a_b * points[i].of_b;
    Eigen::Matrix<double, 3, 4> J;
    J << Eigen::Matrix3d::Identity(), Eigen::Vector3d::UnitZ().cross(in_a - middle);
    const Eigen::Matrix3d weight = weightOf(points[i], T_a_b.linear());
    information += J.transpose() * weight * J;
    vector += J.transpose() * weight * (points[i].of_a - in_a);
  }
  const Eigen::Vector4d step = information.ldlt().solve(vector);
  Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
  move.linear() = rotationAboutZ(step(3));
  move.translation() = middle - move.linear() * middle + step.head<3>();
  T_a_b = move * T_a_b;
}

/// Whether so many of random pairs agree more often than once in a million trials of all
/// alignments by two pairs, which agree themselves (Chernoff's bound of the binomial tail).
bool isChance(const std::vector<Points>& points, std::size_t agreed,
              const Eigen::Isometry3d& T_a_b) {
  constexpr double kMostProbable = 1e-6;
  const std::size_t count = points.size();
  std::size_t trials = 0;
  std::size_t by_chance = 1;  // never none: they are few
  for (std::size_t shift = 1; shift < std::min<std::size_t>(count, 20); ++shift) {
    for (std::size_t i = 0; i < count; ++i, ++trials) {
      Points random = points[i];
      const Points& other = points[(i + shift) % count];
      random.of_b = other.of_b;
      random.covariance_b_m2 = other.covariance_b_m2;
      if (agree(random, T_a_b)) ++by_chance;
    }
  }
  if (trials == 0) return true;
  const double q = static_cast<double>(by_chance) / static_cast<double>(trials);
  const double n = static_cast<double>(count) - 2;
  const double p = (static_cast<double>(agreed) - 2) / n;
  if (!(p > q)) return true;
  double divergence = p * std::log(p / q);
  if (p < 1) divergence += (1 - p) * std::log((1 - p) / (1 - q));
  return std::log(n * n / 2) - n * divergence > std::log(kMostProbable);
}

}  // namespace

std::vector<LandmarkPair> pairsOf(const SavedMap& a, const SavedMap& b,
                                  const std::function<void(std::size_t)>& progress) {
  std::vector<Nearest> of_b(b.landmarks.size());
  std::vector<Nearest> of_a(a.landmarks.size());
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) {
    for (std::size_t j = 0; j < b.landmarks.size(); ++j) {
      const int bits = distance_bits(a.landmarks[i].descriptor, b.landmarks[j].descriptor);
      of_a[i].offer(j, bits);
      of_b[j].offer(i, bits);
    }
    if (progress) progress(i + 1);
  }
  std::vector<LandmarkPair> pairs;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const Nearest& nearest = of_a[i];
    if (nearest.isClear() && of_b[nearest.index].index == i && of_b[nearest.index].isClear())
      pairs.push_back({i, nearest.index});
  }
  return pairs;
}

bool areOfOneFlight(const SavedMap& a, const SavedMap& b, const std::vector<LandmarkPair>& pairs) {
  constexpr int kFewest = 3;
  const auto same = std::count_if(pairs.begin(), pairs.end(), [&](const LandmarkPair& pair) {
    return a.landmarks[pair.of_a].descriptor == b.landmarks[pair.of_b].descriptor;
  });
  return same >= kFewest;
}

MapAlignment align(const SavedMap& a, const SavedMap& b, const std::vector<LandmarkPair>& pairs) {
  constexpr int kTrials = 3000;
  constexpr int kSteps = 6;
  MapAlignment best;
  const std::vector<Points> points = pointsOf(a, b, pairs);
  if (points.size() < 2) return best;
  std::mt19937 random(1);
  std::vector<std::size_t> most;
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
    if (!byTwo(points[random() % points.size()], points[random() % points.size()], T_a_b)) continue;
    std::vector<std::size_t> agreeing = agreeingOf(points, T_a_b);
    if (agreeing.size() <= most.size()) continue;
    most = std::move(agreeing);
    best.T_a_b = T_a_b;
  }
  for (int i = 0; i < kSteps && most.size() >= 2; ++i) {
    improve(points, most, best.T_a_b);
    most = agreeingOf(points, best.T_a_b);
  }
  for (const std::size_t i : most) best.agreed.push_back(pairs[i]);
  best.is_chance = isChance(points, most.size(), best.T_a_b);
  return best;
}

}  // namespace ardrone_vslam
