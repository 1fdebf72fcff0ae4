// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/reference_image.hpp"

#include <algorithm>
#include <cmath>

#include "linear/portable_math.hpp"
#include "matching/hamming.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kSameCorner_bits = 90;  // descriptors of one corner at rest
constexpr double kReachJumps = 10;    // as far as it is looked for

}  // namespace

void ReferenceImage::take(const ImageFeatures& features) {
  corners_.clear();
  order_.reset(features);
  for (const TrackedFeature& one : order_) {
    corners_.push_back({one.track_id, features.bearing_cam[one.feature].cast<double>(),
                        features.descriptor[one.feature]});
  }
}

const ReferenceImage::Corner* ReferenceImage::find(std::uint32_t track_id) const {
  const auto corner =
      std::lower_bound(corners_.begin(), corners_.end(), track_id,
                       [](const Corner& c, std::uint32_t id) { return c.track_id < id; });
  return corner == corners_.end() || corner->track_id != track_id ? nullptr : &*corner;
}

std::vector<BearingPair> ReferenceImage::pairsWith(const ImageFeatures& features) const {
  std::vector<BearingPair> pairs;
  pairs.reserve(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (const Corner* corner = find(features.track_id[i]))
      pairs.push_back({corner->bearing, features.bearing_cam[i].cast<double>()});
  }
  return pairs;
}

void ReferenceImage::findAgain(const ImageFeatures& features,
                               const Eigen::Matrix3d& R_reference_now) {
  std::vector<std::size_t> begun;  // features whose tracks are not the reference's
  std::vector<char> is_held(corners_.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (const Corner* corner = find(features.track_id[i])) {
      is_held[static_cast<std::size_t>(corner - corners_.data())] = 1;
    } else {
      begun.push_back(i);
    }
  }
  std::vector<const Corner*> lost;  // in the order of x, as only near ones are compared
  for (std::size_t i = 0; i < corners_.size(); ++i)
    if (!is_held[i]) lost.push_back(&corners_[i]);
  std::sort(lost.begin(), lost.end(),
            [](const Corner* a, const Corner* b) { return a->bearing.x() < b->bearing.x(); });

  const double reach_rad = kReachJumps * kCornerJump_px / features.focal_length_px;
  std::vector<Corner> found;
  for (const std::size_t i : begun) {
    const Eigen::Vector3d bearing = R_reference_now * features.bearing_cam[i].cast<double>();
    const auto best = sameCorner(bearing, features.descriptor[i], reach_rad, lost);
    if (best == lost.end()) continue;
    found.push_back({features.track_id[i], (*best)->bearing, (*best)->descriptor});
    lost.erase(best);
  }
  corners_.insert(corners_.end(), found.begin(), found.end());
  std::sort(corners_.begin(), corners_.end(),
            [](const Corner& a, const Corner& b) { return a.track_id < b.track_id; });
}

std::vector<const ReferenceImage::Corner*>::iterator ReferenceImage::sameCorner(
    const Eigen::Vector3d& bearing, const Descriptor& descriptor, double reach_rad,
    std::vector<const Corner*>& lost) {
  const double nearest_cosine = portable::cos(reach_rad);
  int fewest = kSameCorner_bits;
  auto best = lost.end();
  auto corner =
      std::lower_bound(lost.begin(), lost.end(), bearing.x() - reach_rad,
                       [](const Corner* c, double least_x) { return c->bearing.x() < least_x; });
  for (; corner != lost.end() && (*corner)->bearing.x() <= bearing.x() + reach_rad; ++corner) {
    if (bearing.dot((*corner)->bearing) < nearest_cosine) continue;
    const int bits = hammingDistance(descriptor, (*corner)->descriptor);
    if (bits > fewest || bits == kSameCorner_bits) continue;
    // Of equal ones the first one is taken.
    if (bits == fewest && (*corner)->track_id > (*best)->track_id) continue;
    fewest = bits;
    best = corner;
  }
  return best;
}

}  // namespace ardrone_vslam
