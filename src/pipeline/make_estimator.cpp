// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/make_estimator.hpp"

#include "msckf/msckf_estimator.hpp"
#include "thesis/thesis_estimator.hpp"

namespace ardrone_vslam {
namespace {

/// The odometry as it is, with the thesis's noise: images are not used.
class OdometryEstimator final : public ThesisEstimator {
 public:
  using ThesisEstimator::ThesisEstimator;
  bool wantsLandmarks() const override { return false; }
  Correction correct(const AssociationResult& /*matches*/, const FrameView& /*view*/,
                     const LandmarkMap& /*map*/) override {
    return {SlamState::kOdometryOnly, std::nullopt, std::nullopt};
  }
  MapChanges updateMap(const AssociationResult& /*matches*/, FrameView& /*view*/,
                       LandmarkMap& /*map*/, FrameBudget& /*budget*/) override {
    return {};
  }
};

}  // namespace

std::unique_ptr<Estimator> makeEstimator(const SlamConfig& config,
                                         const Eigen::Isometry3d& T_base_cam) {
  switch (config.estimator) {
    case EstimatorKind::kThesis:
      return std::make_unique<ThesisEstimator>(config, T_base_cam);
    case EstimatorKind::kOdometry:
      return std::make_unique<OdometryEstimator>(config, T_base_cam);
    case EstimatorKind::kMsckf:
      break;
  }
  return std::make_unique<MsckfEstimator>(config, T_base_cam);
}

}  // namespace ardrone_vslam
