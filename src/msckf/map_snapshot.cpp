// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/map_snapshot.hpp"

#include <limits>
#include <unordered_map>
#include <utility>

namespace ardrone_vslam {
namespace {

static_assert(SavedMap::kAnchor == WindowState::kAnchor, "a file has the filter's coordinates");

/// Poses that landmarks belong to, and how a file's coordinates follow from the filter's.
class Gathering {
 public:
  Gathering(const WindowState& state, const std::vector<Landmark>& landmarks) : state_(state) {
    for (const Landmark& landmark : landmarks) place_of_id_.emplace(landmark.anchor_id, 0);
    for (std::size_t i = 0; i < state.anchors().size(); ++i)
      take(state.anchors()[i], state.anchorCoordinate(i), true);
    for (std::size_t i = 0; i < state.frames().size(); ++i)
      take(state.frames()[i], state.frameCoordinate(i), false);
  }

  SavedMap map() const {
    SavedMap map;
    map.stamp_ns = state_.newest().stamp_ns;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(
        SavedMap::kAnchor * static_cast<Eigen::Index>(poses_.size()), state_.covariance().rows());
    for (const Pose& pose : poses_) {
      MapAnchor anchor;
      anchor.T_map_rig.translation() = pose.clone->position_map;
      anchor.T_map_rig.linear() = pose.clone->R_map_rig;
      anchor.stamp_ns = pose.clone->stamp_ns;
      const auto row = SavedMap::kAnchor * static_cast<Eigen::Index>(map.anchors.size());
      J.block<6, 6>(row, pose.coordinate).setIdentity();
      addStretch(pose, J.row(row + WindowState::kFrame));
      map.anchors.push_back(anchor);
    }
    const Eigen::MatrixXd P = J * state_.covariance() * J.transpose();
    map.anchor_covariance = 0.5 * (P + P.transpose());
    return map;
  }

  /// @return 0: it is not among the poses
  std::uint32_t numberOf(std::uint32_t id) const {
    const auto place = place_of_id_.find(id);
    return place == place_of_id_.end() ? 0 : place->second;
  }

 private:
  struct Pose {
    const Clone* clone;
    int coordinate;
    bool is_anchor;
  };

  void take(const Clone& clone, int coordinate, bool is_anchor) {
    const auto place = place_of_id_.find(clone.id);
    if (place == place_of_id_.end()) return;
    poses_.push_back({&clone, coordinate, is_anchor});
    place->second = static_cast<std::uint32_t>(poses_.size());
  }

  /// Of this flight's landmarks all distances err with its scale, and by the bias of their time.
  void addStretch(const Pose& pose, Eigen::MatrixXd::RowXpr row) const {
    if (!pose.clone->is_loaded) row(WindowState::kScale) = 1;
    if (pose.is_anchor) {
      row(pose.coordinate + WindowState::kFrame) = 1;
    } else {
      row.segment<3>(WindowState::kBias) = pose.clone->stretch_by_bias_s_m.transpose();
    }
  }

  const WindowState& state_;
  std::vector<Pose> poses_;
  std::unordered_map<std::uint32_t, std::uint32_t> place_of_id_;  // 1 + index; 0: not there
};

}  // namespace

SavedMap savedMapOf(const WindowState& state, const std::vector<Landmark>& landmarks) {
  if (state.frames().empty()) return {};  // nothing was seen yet
  const Gathering gathering(state, landmarks);
  SavedMap map = gathering.map();
  map.landmarks.reserve(landmarks.size());
  for (const Landmark& landmark : landmarks) {
    const std::uint32_t number = gathering.numberOf(landmark.anchor_id);
    if (number == 0) continue;
    map.landmarks.push_back(landmark);
    map.landmarks.back().anchor_id = number;
  }
  return map;
}

LoadedAnchors anchorsOf(const SavedMap& map) {
  LoadedAnchors loaded;
  loaded.covariance = map.anchor_covariance;
  for (const MapAnchor& anchor : map.anchors) {
    Clone clone;
    clone.stamp_ns = anchor.stamp_ns;
    clone.position_map = anchor.T_map_rig.translation();
    clone.R_map_rig = anchor.T_map_rig.linear();
    clone.is_loaded = true;
    clone.id = std::numeric_limits<std::uint32_t>::max() -
               static_cast<std::uint32_t>(loaded.anchors.size());
    loaded.anchors.push_back(clone);
  }
  return loaded;
}

std::vector<Landmark> landmarksOf(SavedMap&& map, const LoadedAnchors& anchors, std::int64_t now_ns,
                                  double fix_min_age_s) {
  constexpr double kBeforeTheFlight_s = 60;
  const std::int64_t ended_ns =
      now_ns - static_cast<std::int64_t>((kBeforeTheFlight_s + fix_min_age_s) * 1e9);
  std::vector<Landmark> landmarks = std::move(map.landmarks);
  for (Landmark& landmark : landmarks) {
    landmark.anchor_id = anchors.anchors[landmark.anchor_id - 1].id;
    landmark.track_id = kNoTrack;
    for (std::int64_t* seen_ns : {&landmark.first_seen_ns, &landmark.last_seen_ns})
      *seen_ns += ended_ns - map.stamp_ns;
  }
  return landmarks;
}

}  // namespace ardrone_vslam
