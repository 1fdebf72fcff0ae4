// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "association/map_feature_associator.hpp"
#include "estimator/estimator.hpp"
#include "map/feature_map.hpp"
#include "map/mapper.hpp"
#include "thesis/thesis_filter.hpp"

namespace ardrone_vslam {

/// The master thesis's algorithm 5: positions by a weighted mean of the landmarks, fused by a
/// Kalman filter; landmarks triangulated of features that wait in a map of their own. Orientation
/// is the odometry's. Also in 2-D (`planar`), where all z of map are zero.
class ThesisEstimator : public Estimator {
 public:
  ThesisEstimator(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam);

  void predict(const OdometryState& odometry, const std::optional<OdometryStep>& step) override;
  CameraPose camera() override;
  Correction correct(const AssociationResult& matches, const FrameView& view,
                     const LandmarkMap& map) override;
  MapChanges updateMap(const AssociationResult& matches, FrameView& view, LandmarkMap& map,
                       FrameBudget& budget) override;
  Estimate estimate() const override;
  bool wantsLandmarks() const override { return !is_refused_; }
  void heed(const SetupFinding& finding) override {
    is_refused_ = finding.fault != SetupFault::kNone;
  }
  void changeCamera(const Eigen::Isometry3d& T_base_cam) override { T_base_cam_ = T_base_cam; }

 private:
  SlamConfig config_;
  Eigen::Isometry3d T_base_cam_;
  ThesisFilter filter_;
  LandmarkLocator locator_;
  Mapper mapper_;
  MapFeatureAssociator associator_;
  FeatureMap feature_map_;
  AssociationResult feature_matches_;
  std::vector<bool> used_;  // the frame's features that need not be stored
  bool started_ = false;
  bool is_refused_ = false;  // the set-up has a fault: the camera is not used
  Eigen::Isometry3d T_odom_base_ = Eigen::Isometry3d::Identity();
};

}  // namespace ardrone_vslam
