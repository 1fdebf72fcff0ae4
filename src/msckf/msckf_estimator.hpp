// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/estimator.hpp"
#include "map/mapper.hpp"
#include "map/unconfirmed_landmarks.hpp"
#include "map_update/fixed_map.hpp"
#include "map_update/time_since_fix.hpp"
#include "msckf/landmark_upkeep.hpp"
#include "msckf/msckf.hpp"

namespace ardrone_vslam {

/// The default: poses by the MSCKF, which landmarks of earlier visits correct; tracks that it has
/// used become landmarks, which are placed beside the frames whose errors they share.
class MsckfEstimator final : public Estimator {
 public:
  MsckfEstimator(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam);

  void predict(const OdometryState& odometry, const std::optional<OdometryStep>& step) override;
  CameraPose camera() override;
  bool wantsLandmarks() const override { return !filter_.isDistrustful(); }
  Correction correct(const AssociationResult& matches, const FrameView& view,
                     const LandmarkMap& map) override;
  MapChanges updateMap(const AssociationResult& matches, FrameView& view, LandmarkMap& map,
                       FrameBudget& budget) override;
  Estimate estimate() const override;
  void heed(const SetupFinding& finding) override;
  void enterMap(MapEntry&& entry, SavedMap&& loaded, const FrameView& view,
                LandmarkMap& map) override;
  bool shift(const Revisit& revisit, const FrameView& view, LandmarkMap& map) override;
  MapSnapshot save(const LandmarkMap& map) const override;
  void changeCamera(const Eigen::Isometry3d& T_base_cam) override;

 private:
  SlamState fix(const AssociationResult& matches, const FrameView& view, const LandmarkMap& map);
  void judge(const AssociationResult& matches, const LandmarkMap& map, Correction& correction);
  void changeLandmarks(const AssociationResult& matches, const std::vector<UsedTrack>& used,
                       const FrameView& view, LandmarkMap& map, MapChanges& changes);

  SlamConfig config_;
  Eigen::Isometry3d T_rig_cam_;
  Msckf filter_;
  LandmarkLocator locator_;
  Mapper mapper_;
  TimeSinceFix time_since_fix_;
  /// Odometry that begins in a loaded map is given to the filter as if it had begun there.
  Eigen::Isometry3d T_filter_odom_ = Eigen::Isometry3d::Identity();
  SlamState state_ = SlamState::kBuildingMap;  // of the newest frame, by landmarks
  std::optional<FixedMap> fixed_map_;  // with localise_only, once the flight has been found in it
  UnconfirmedLandmarks unconfirmed_;
  std::vector<Association> trusted_;  // the newest frame's matches that may be right
};

}  // namespace ardrone_vslam
