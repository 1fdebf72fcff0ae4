// SPDX-License-Identifier: BSD-3-Clause
#include "match_metrics.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ardrone_vslam::quality {
namespace {

bool isInside(const Eigen::Vector2d& pixel_px, const Eigen::Vector2d& size_px) {
  return (pixel_px.array() >= kBorder_px).all() &&
         (pixel_px.array() <= size_px.array() - 1 - kBorder_px).all();
}

PixelMap mapBy(const Eigen::Matrix3d& H) {
  return [H](const Eigen::Vector2d& pixel_px) -> std::optional<Eigen::Vector2d> {
    const Eigen::Vector3d mapped = H * pixel_px.homogeneous();
    if (!(mapped.z() > 0)) return std::nullopt;  // beyond the plane's horizon
    return mapped.hnormalized();
  };
}

/// Pairs each of one set with at most one of the other, as many as can be: augmenting paths. Taking
/// the nearest first would give fewer where a detector finds a point at several scales, and so
/// fewer than a matcher finds.
class Pairing {
 public:
  /// @param partners  who may be paired with each of the first set
  Pairing(std::vector<std::vector<std::size_t>> partners, std::size_t others)
      : partners_(std::move(partners)), paired_with_(others, kNobody), asked_(others, kNobody) {}

  int count() {
    int count = 0;
    for (std::size_t i = 0; i < partners_.size(); ++i) count += findPartner(i, i) ? 1 : 0;
    return count;
  }

 private:
  static constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

  /// @param round  in which each of the others is asked once
  bool findPartner(std::size_t i, std::size_t round) {
    for (const std::size_t j : partners_[i]) {
      if (asked_[j] == round) continue;
      asked_[j] = round;
      if (paired_with_[j] != kNobody && !findPartner(paired_with_[j], round)) continue;
      paired_with_[j] = i;
      return true;
    }
    return false;
  }

  std::vector<std::vector<std::size_t>> partners_;
  std::vector<std::size_t> paired_with_;
  std::vector<std::size_t> asked_;
};

double ratio(int part, int whole) {
  return whole > 0 ? static_cast<double>(part) / whole : 0;
}

}  // namespace

PairGeometry planeGeometry(const Eigen::Matrix3d& H_b_a, const Eigen::Vector2d& size_a_px,
                           const Eigen::Vector2d& size_b_px) {
  // The sign of a homography is free; that of its horizon test is not.
  const Eigen::Vector3d middle = (size_a_px / 2).homogeneous();
  const double sign = (H_b_a * middle).z() < 0 ? -1 : 1;
  const Eigen::Matrix3d H = sign * H_b_a;
  Eigen::Matrix3d H_back = H.inverse();
  if ((H_back * (H * middle)).z() < 0) H_back = -H_back;
  return {mapBy(H), mapBy(H_back), size_a_px, size_b_px};
}

PairTruth::PairTruth(const std::vector<Eigen::Vector2d>& a_px,
                     const std::vector<Eigen::Vector2d>& b_px, const PairGeometry& geometry)
    : a_(place(a_px, geometry.a_to_b, geometry.size_a_px, geometry.size_b_px)),
      b_(place(b_px, geometry.b_to_a, geometry.size_b_px, geometry.size_a_px)) {}

std::vector<PairTruth::Feature> PairTruth::place(const std::vector<Eigen::Vector2d>& pixels_px,
                                                 const PixelMap& map,
                                                 const Eigen::Vector2d& own_size_px,
                                                 const Eigen::Vector2d& other_size_px) {
  std::vector<Feature> features;
  features.reserve(pixels_px.size());
  for (const auto& pixel_px : pixels_px) {
    const auto other_px = map(pixel_px);
    const bool is_common =
        other_px && isInside(pixel_px, own_size_px) && isInside(*other_px, other_size_px);
    features.push_back({pixel_px, other_px, is_common});
  }
  return features;
}

bool PairTruth::isSame(const Feature& a, const Feature& b) {
  if (!a.other_px || !b.other_px) return false;
  const double in_b = (*a.other_px - b.own_px).squaredNorm();
  const double in_a = (*b.other_px - a.own_px).squaredNorm();
  return std::min(in_a, in_b) <= kSamePoint_px * kSamePoint_px;
}

bool PairTruth::isSamePoint(int a, int b) const {
  return isSame(a_[static_cast<std::size_t>(a)], b_[static_cast<std::size_t>(b)]);
}

int PairTruth::countRepeated() const {
  std::vector<std::vector<std::size_t>> partners(a_.size());
  for (std::size_t i = 0; i < a_.size(); ++i) {
    if (!a_[i].is_common) continue;
    for (std::size_t j = 0; j < b_.size(); ++j) {
      if (b_[j].is_common && isSame(a_[i], b_[j])) partners[i].push_back(j);
    }
  }
  return Pairing(std::move(partners), b_.size()).count();
}

PairMetrics PairTruth::measure(const std::vector<IndexPair>& matches) const {
  const auto isCommon = [](const Feature& feature) { return feature.is_common; };
  PairMetrics metrics;
  metrics.features = static_cast<int>(std::min(std::count_if(a_.begin(), a_.end(), isCommon),
                                               std::count_if(b_.begin(), b_.end(), isCommon)));
  metrics.matches = static_cast<int>(matches.size());
  int correct_common = 0;
  for (const auto& [a, b] : matches) {
    if (!isSamePoint(a, b)) continue;
    ++metrics.correct;
    if (a_[static_cast<std::size_t>(a)].is_common && b_[static_cast<std::size_t>(b)].is_common) {
      ++correct_common;
    }
  }
  metrics.repeatability = ratio(countRepeated(), metrics.features);
  metrics.matching_score = ratio(correct_common, metrics.features);
  metrics.precision = ratio(metrics.correct, metrics.matches);
  return metrics;
}

PairMetrics meanOf(const std::vector<PairMetrics>& pairs) {
  PairMetrics mean;
  if (pairs.empty()) return mean;
  const auto count = static_cast<double>(pairs.size());
  double features = 0, matches = 0, correct = 0;
  for (const auto& pair : pairs) {
    features += pair.features / count;
    matches += pair.matches / count;
    correct += pair.correct / count;
    mean.repeatability += pair.repeatability / count;
    mean.matching_score += pair.matching_score / count;
    mean.precision += pair.precision / count;
  }
  mean.features = static_cast<int>(std::lround(features));
  mean.matches = static_cast<int>(std::lround(matches));
  mean.correct = static_cast<int>(std::lround(correct));
  return mean;
}

}  // namespace ardrone_vslam::quality
