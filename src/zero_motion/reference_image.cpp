// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/reference_image.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

std::vector<std::size_t> ReferenceImage::lostIn(const ImageFeatures& features) const {
  std::vector<std::size_t> lost(corners_.size());
  std::iota(lost.begin(), lost.end(), std::size_t{0});
  const auto isThere = [&](std::size_t corner) {
    return std::find(features.track_id.begin(), features.track_id.end(),
                     corners_[corner].track_id) != features.track_id.end();
  };
  lost.erase(std::remove_if(lost.begin(), lost.end(), isThere), lost.end());
  return lost;
}

void ReferenceImage::findAgain(const ImageFeatures& features,
                               const Eigen::Matrix3d& R_reference_now) {
  std::vector<std::size_t> lost = lostIn(features);
  const double nearest_cosine = std::cos(kReachJumps * kCornerJump_px / features.focal_length_px);
  std::vector<Corner> found;
  for (std::size_t i = 0; i < features.size() && !lost.empty(); ++i) {
    const std::uint32_t id = features.track_id[i];
    if (find(id)) continue;
    const Eigen::Vector3d bearing = R_reference_now * features.bearing_cam[i].cast<double>();
    int fewest = kSameCorner_bits;
    auto best = lost.end();
    for (auto corner = lost.begin(); corner != lost.end(); ++corner) {
      if (bearing.dot(corners_[*corner].bearing) < nearest_cosine) continue;
      const int bits = hammingDistance(features.descriptor[i], corners_[*corner].descriptor);
      if (bits >= fewest) continue;
      fewest = bits;
      best = corner;
    }
    if (best == lost.end()) continue;
    found.push_back({id, corners_[*best].bearing, corners_[*best].descriptor});
    lost.erase(best);
  }
  corners_.insert(corners_.end(), found.begin(), found.end());
  std::sort(corners_.begin(), corners_.end(),
            [](const Corner& a, const Corner& b) { return a.track_id < b.track_id; });
}

}  // namespace ardrone_vslam
