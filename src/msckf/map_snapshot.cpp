// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/map_snapshot.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace ardrone_vslam {
namespace {

static_assert(SavedMap::kAnchor == WindowState::kAnchor, "a file has the filter's coordinates");

/// How a file's coordinates follow from the filter's.
class Gathering {
 public:
  explicit Gathering(const WindowState& state) : covariance_(state.covariance()) {}

  void add(const Clone& clone, int coordinate, bool is_anchor, MapSnapshot& snapshot) {
    poses_.push_back({coordinate, is_anchor, clone.is_loaded, clone.stretch_by_bias_s_m});
    MapAnchor& anchor = snapshot.all_but_landmarks.anchors.emplace_back();
    anchor.T_map_rig.translation() = clone.position_map;
    anchor.T_map_rig.linear() = clone.R_map_rig;
    anchor.stamp_ns = clone.stamp_ns;
    snapshot.anchor_ids.push_back(clone.id);
  }

  /// J P J^T, J being the file's coordinates by the filter's.
  Eigen::MatrixXd covariance() const {
    const Eigen::MatrixXd P = timesJacobian(timesJacobian(covariance_).transpose());
    return 0.5 * (P + P.transpose());
  }

 private:
  struct Pose {
    int coordinate;
    bool is_anchor;
    bool is_loaded;
    Eigen::Vector3d stretch_by_bias_s_m;
  };

  /// J M: most rows of J have a single one.
  Eigen::MatrixXd timesJacobian(const Eigen::MatrixXd& M) const {
    Eigen::MatrixXd product(SavedMap::kAnchor * static_cast<Eigen::Index>(poses_.size()), M.cols());
    Eigen::Index row = 0;
    for (const Pose& pose : poses_) {
      product.middleRows<6>(row) = M.middleRows<6>(pose.coordinate);
      product.row(row + WindowState::kFrame) = stretchOf(pose, M);
      row += SavedMap::kAnchor;
    }
    return product;
  }

  /// Of this flight's landmarks all distances err with its scale, and by the bias of their time.
  static Eigen::RowVectorXd stretchOf(const Pose& pose, const Eigen::MatrixXd& M) {
    Eigen::RowVectorXd stretch = Eigen::RowVectorXd::Zero(M.cols());
    if (!pose.is_loaded) stretch += M.row(WindowState::kScale);
    if (pose.is_anchor) {
      stretch += M.row(pose.coordinate + WindowState::kFrame);
    } else {
      stretch += pose.stretch_by_bias_s_m.transpose() * M.middleRows<3>(WindowState::kBias);
    }
    return stretch;
  }

  Eigen::MatrixXd covariance_;
  std::vector<Pose> poses_;
};

Eigen::Index coordinateOf(std::size_t anchor) {
  return SavedMap::kAnchor * static_cast<Eigen::Index>(anchor);
}

}  // namespace

MapSnapshot snapshotOf(const WindowState& state, const Landmarks& landmarks) {
  MapSnapshot snapshot;
  if (state.frames().empty()) return snapshot;  // nothing was seen yet
  Gathering gathering(state);
  for (std::size_t i = 0; i < state.anchors().size(); ++i)
    gathering.add(state.anchors()[i], state.anchorCoordinate(i), true, snapshot);
  for (std::size_t i = 0; i < state.frames().size(); ++i)
    gathering.add(state.frames()[i], state.frameCoordinate(i), false, snapshot);
  snapshot.all_but_landmarks.stamp_ns = state.newest().stamp_ns;
  snapshot.anchor_covariance = [g = std::move(gathering)] { return g.covariance(); };
  snapshot.landmarks = landmarks;
  return snapshot;
}

MapSnapshot::MapSnapshot(SavedMap map)
    : all_but_landmarks(std::move(map)),
      anchor_ids(all_but_landmarks.anchors.size()),
      anchor_covariance([P = std::move(all_but_landmarks.anchor_covariance)] { return P; }),
      landmarks(all_but_landmarks.landmarks) {
  all_but_landmarks.landmarks = {};
  std::iota(anchor_ids.begin(), anchor_ids.end(), 1);
}

SavedMap MapSnapshot::map() && {
  SavedMap map = std::move(all_but_landmarks);
  if (anchor_covariance) map.anchor_covariance = anchor_covariance();
  std::unordered_map<std::uint32_t, std::uint32_t> number_of_id;
  for (const std::uint32_t id : anchor_ids)
    number_of_id.emplace(id, static_cast<std::uint32_t>(number_of_id.size() + 1));
  map.landmarks.reserve(landmarks.size());
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const auto number =
        number_of_id.find(anchor_of_landmark ? (*anchor_of_landmark)[i] : landmarks[i].anchor_id);
    if (number == number_of_id.end()) continue;
    map.landmarks.push_back(landmarks[i]);
    map.landmarks.back().anchor_id = number->second;
  }
  landmarks.clear();
  keepUsedAnchors(map);
  return map;
}

void keepAnchors(SavedMap& map, const std::vector<std::size_t>& anchors) {
  const std::vector<MapAnchor> all = std::move(map.anchors);
  const Eigen::MatrixXd P = std::move(map.anchor_covariance);
  map.anchors.clear();
  map.anchor_covariance.resize(coordinateOf(anchors.size()), coordinateOf(anchors.size()));
  std::vector<std::uint32_t> number(all.size(), 0);
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    map.anchors.push_back(all[anchors[i]]);
    number[anchors[i]] = static_cast<std::uint32_t>(i + 1);
    for (std::size_t j = 0; j < anchors.size(); ++j)
      map.anchor_covariance.block<SavedMap::kAnchor, SavedMap::kAnchor>(coordinateOf(i),
                                                                        coordinateOf(j)) =
          P.block<SavedMap::kAnchor, SavedMap::kAnchor>(coordinateOf(anchors[i]),
                                                        coordinateOf(anchors[j]));
  }
  for (Landmark& landmark : map.landmarks) landmark.anchor_id = number[landmark.anchor_id - 1];
  const auto is_gone = [](const Landmark& landmark) { return landmark.anchor_id == 0; };
  map.landmarks.erase(std::remove_if(map.landmarks.begin(), map.landmarks.end(), is_gone),
                      map.landmarks.end());
}

void keepUsedAnchors(SavedMap& map) {
  std::vector<bool> is_used(map.anchors.size(), false);
  for (const Landmark& landmark : map.landmarks) is_used[landmark.anchor_id - 1] = true;
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (is_used[i]) used.push_back(i);
  }
  keepAnchors(map, used);
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
