// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/landmark_worth.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ardrone_vslam {
namespace {

constexpr double kHalfWorth_s = 120;      // not seen for so long
constexpr double kHalfWorthSigma = 0.02;  // of the distance
constexpr double kCell = 0.1;             // of the distance

/// A cube of space: the exponent of its side in ten bits, and eighteen for each coordinate. Cubes
/// that lie 2^18 sides apart are taken for one.
using Cell = std::uint64_t;

struct Candidate {
  Cell cell;
  double worth;
  std::uint32_t id;
};

double distanceOf(const Landmark& landmark) {
  return landmark.seen_distance_m > 0 ? landmark.seen_distance_m : 1;
}

Cell cellOf(const Landmark& landmark) {
  int exponent = 0;
  std::frexp(kCell * distanceOf(landmark), &exponent);
  Cell cell = static_cast<Cell>(exponent);
  for (int axis = 0; axis < 3; ++axis) {
    const double place =
        std::fmod(std::floor(std::ldexp(landmark.position_map[axis], -exponent)), 1 << 18);
    cell = cell << 18 | (static_cast<Cell>(static_cast<std::int64_t>(place)) & 0x3FFFF);
  }
  return cell;
}

double worthOf(const Landmark& landmark, std::int64_t now_ns) {
  // Its logarithm: an hour before one wall must not keep the map from the next room.
  int use = 0;
  std::frexp(landmark.times_seen, &use);
  const double unseen = static_cast<double>(now_ns - landmark.last_seen_ns) * 1e-9 / kHalfWorth_s;
  const double sigma = landmark.sigma_m / (kHalfWorthSigma * distanceOf(landmark));
  return (1 + use) / ((1 + unseen) * (1 + sigma * sigma));
}

}  // namespace

std::vector<std::uint32_t> leastWorth(const Landmarks& landmarks, std::size_t count) {
  std::int64_t now_ns = 0;
  for (const Landmark& landmark : landmarks) now_ns = std::max(now_ns, landmark.last_seen_ns);
  std::vector<Candidate> candidates;
  candidates.reserve(landmarks.size());
  for (const Landmark& landmark : landmarks)
    candidates.push_back({cellOf(landmark), worthOf(landmark, now_ns), landmark.id});
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.cell, b.worth, b.id) < std::tie(b.cell, a.worth, a.id);
  });
  int place = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    place = i > 0 && candidates[i].cell == candidates[i - 1].cell ? place + 1 : 1;
    candidates[i].worth /= place;
  }
  count = std::min(count, candidates.size());
  const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(count);
  std::partial_sort(candidates.begin(), end, candidates.end(),
                    [](const Candidate& a, const Candidate& b) {
                      return std::tie(a.worth, a.id) < std::tie(b.worth, b.id);
                    });
  std::vector<std::uint32_t> ids;
  for (auto candidate = candidates.begin(); candidate != end; ++candidate)
    ids.push_back(candidate->id);
  return ids;
}

}  // namespace ardrone_vslam
