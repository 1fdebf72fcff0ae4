// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/camera/doctor_motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ardrone_vslam/setup_watch.hpp"
#include "doctor/camera/doctor_frames.hpp"
#include "doctor/recording/doctor_stamps.hpp"
#include "input_checks/checked.hpp"
#include "input_checks/standstill_watch.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kDegPerRad = 180 / M_PI;
constexpr double kWrong_rad = 30 / kDegPerRad;  // another mounting than tf says
constexpr double kOff_rad = 6 / kDegPerRad;     // more than mountings are known to
constexpr double kSure = 3;                     // times the difference of both halves
constexpr double kLongest_s = 600;              // of odometry that is kept
constexpr double kSameTime_s = 0.03;            // offsets that do no harm
constexpr double kWorse = 1.1;  // so much worse must tf's mounting explain the images

std::string degrees(double angle_rad) {
  return rounded(angle_rad * kDegPerRad, 0) + " degrees";
}

/// "looks along base's x, its right is base's -y".
std::string directionOf(const Eigen::Matrix3d& R_base_cam) {
  const auto axis = [&R_base_cam](int i) {
    Eigen::Index largest = 0;
    R_base_cam.col(i).cwiseAbs().maxCoeff(&largest);
    return std::string(R_base_cam(largest, i) < 0 ? "-" : "") + "xyz"[largest];
  };
  return "looks along base's " + axis(2) + ", its right is base's " + axis(0);
}

std::string explain(ExtrinsicsState state, const ExtrinsicsEstimate& estimate) {
  switch (state) {
    case ExtrinsicsState::kTooLittleMotion:
      return text("because only ", estimate.motions,
                  " pairs of images with tracks moved: turn and fly about");
    case ExtrinsicsState::kAmbiguous:
      return text("because another mounting explains the images nearly as well (",
                  rounded(estimate.misfit_px, 1), " and ", rounded(estimate.misfit_rival_px, 1),
                  " px): turn more, and fly in all directions");
    case ExtrinsicsState::kNoAgreement:
      return text("because the images move by no mounting as the odometry does (",
                  rounded(estimate.misfit_px, 1), " px at best)");
    case ExtrinsicsState::kFound:
      break;
  }
  return {};
}

Finding judge(const std::string& camera, const ExtrinsicsEstimate& estimate) {
  Finding finding{"camera_direction", Verdict::kOk, {}, {}};
  const std::string told = text("'", camera, "' ");
  if (estimate.state == ExtrinsicsState::kNoAgreement) {
    finding.verdict = Verdict::kWarning;
    finding.text = told + "not told, " + explain(estimate.state, estimate);
    finding.remedy = "check stamps, calibration and odometry";
    return finding;
  }
  if (estimate.state != ExtrinsicsState::kFound) {
    return {"camera_direction",
            Verdict::kNotChecked,
            told + "not told, " + explain(estimate.state, estimate),
            {}};
  }
  const std::string fit =
      text(" (", rounded(estimate.misfit_px, 1), " px, by tf ", rounded(estimate.misfit_told_px, 1),
           ", the next ", rounded(estimate.misfit_rival_px, 1), "; ", estimate.motions,
           " pairs of images)");
  const bool is_worse = estimate.misfit_told_px > kWorse * estimate.misfit_px;
  if (estimate.off_rad > kWrong_rad && is_worse) {
    finding.verdict = Verdict::kFault;
    finding.text = text(told, directionOf(estimate.R_base_cam), ", ", degrees(estimate.off_rad),
                        " from what tf says", fit);
  } else if (estimate.off_rad > std::max(kOff_rad, kSure * estimate.unsure_rad) && is_worse) {
    finding.verdict = Verdict::kWarning;
    finding.text =
        text(told, "is turned by ", degrees(estimate.off_rad), " from what tf says", fit);
  } else {
    finding.text = text(told, directionOf(estimate.R_base_cam), ", as tf says", fit);
  }
  return finding;
}

/// As near to axes as it is told: a turn within what is not sure of an axis is the axis.
Eigen::Matrix3d tidied(const ExtrinsicsEstimate& estimate, const Eigen::Matrix3d& R_told) {
  const Eigen::Matrix3d turn = R_told.transpose() * estimate.R_base_cam;
  const Eigen::Matrix3d whole = turn.array().round().matrix();
  const bool is_rotation = std::abs(whole.determinant() - 1) < 1e-9 &&
                           (whole * whole.transpose()).isApprox(Eigen::Matrix3d::Identity());
  if (!is_rotation) return estimate.R_base_cam;
  const double off_rad = Eigen::AngleAxisd(whole.transpose() * turn).angle();
  return off_rad < std::max(kOff_rad, kSure * estimate.unsure_rad) ? Eigen::Matrix3d(R_told * whole)
                                                                   : estimate.R_base_cam;
}

TimeOffset estimateOffset(const std::vector<ImageFeatures>& images,
                          const std::vector<OdometryState>& odometry,
                          const CameraExtrinsics& extrinsics) {
  OdometryBufferConfig all;
  all.buffer_s = kLongest_s;
  OdometryBuffer buffer(all);
  for (const OdometryState& state : odometry) buffer.push(state);
  Eigen::Isometry3d T_base_cam = extrinsics.T_base_cam;
  T_base_cam.linear() = extrinsics.estimate.R_base_cam;
  TimeOffsetEstimator estimator(T_base_cam, extrinsics.estimate.offset_s);
  for (const ImageFeatures& features : images) estimator.see(features, buffer);
  return estimator.estimate();
}

/// Whether the odometry stands still while a camera's images move.
bool isStuck(const CameraTracks& camera, const Eigen::Isometry3d& T_base_cam,
             const std::vector<OdometryState>& odometry) {
  StandstillWatch watch;
  std::size_t next = 0;
  for (const ImageFeatures& features : camera.images) {
    while (next < odometry.size() && odometry[next].stamp_ns < features.stamp_ns) ++next;
    if (next == 0 || next == odometry.size()) continue;
    const OdometryState state = interpolate(odometry[next - 1], odometry[next], features.stamp_ns);
    watch.see(features, state.T_odom_base * T_base_cam);
  }
  return watch.isStuck();
}

}  // namespace

Finding checkMoves(const DoctorRecording& recording, const Tracks& tracks,
                   const std::vector<OdometryState>& odometry) {
  Finding finding{"odometry_moves", Verdict::kOk, {}, {}};
  if (odometry.size() < 2) return {"odometry_moves", Verdict::kNotChecked, "needs odometry", {}};
  const Eigen::Vector3d first = odometry.front().T_odom_base.translation();
  double farthest_m = 0;
  for (const OdometryState& state : odometry) {
    farthest_m = std::max(farthest_m, (state.T_odom_base.translation() - first).norm());
  }
  const auto isCameraStuck = [&](const CameraTracks& camera) {
    const auto T_base_cam = lookUp(recording, recording.base_frame, camera.frame);
    return isStuck(camera, T_base_cam.value_or(Eigen::Isometry3d::Identity()), odometry);
  };
  finding.text = text("up to ", rounded(farthest_m, 2), " m from where it began");
  if (std::any_of(tracks.cameras.begin(), tracks.cameras.end(), isCameraStuck)) {
    finding.verdict = Verdict::kFault;
    finding.text = explainStandstill(odometryTopic(recording));
  } else if (farthest_m == 0) {
    finding.verdict = Verdict::kWarning;
    finding.text = text("all ", odometry.size(), " positions are equal");
    finding.remedy = "was it at rest? Else check that what publishes it runs";
  }
  return finding;
}

std::vector<CameraExtrinsics> estimateAllExtrinsics(const DoctorRecording& recording,
                                                    const Tracks& tracks,
                                                    const std::vector<OdometryState>& odometry) {
  std::vector<CameraExtrinsics> cameras;
  for (const CameraTracks& camera : tracks.cameras) {
    const auto T_base_cam = lookUp(recording, recording.base_frame, camera.frame);
    if (!T_base_cam) continue;
    const std::vector<ImagePair> pairs = movingPairs(camera.images);
    const OdometryWitness witness{odometry, T_base_cam->translation()};
    CameraExtrinsics extrinsics{
        camera.frame, *T_base_cam, estimateExtrinsics(pairs, witness, T_base_cam->linear()), {}};
    if (extrinsics.estimate.state == ExtrinsicsState::kFound) {
      extrinsics.offset = estimateOffset(camera.images, odometry, extrinsics);
    }
    cameras.push_back(extrinsics);
  }
  return cameras;
}

Findings checkDirections(const std::vector<CameraExtrinsics>& cameras,
                         const std::string& base_frame, std::string& static_transform) {
  Findings findings;
  for (const CameraExtrinsics& extrinsics : cameras) {
    Finding finding = judge(extrinsics.frame, extrinsics.estimate);
    if (extrinsics.estimate.state == ExtrinsicsState::kFound && finding.verdict != Verdict::kOk) {
      Eigen::Isometry3d T_corrected = extrinsics.T_base_cam;
      T_corrected.linear() = tidied(extrinsics.estimate, extrinsics.T_base_cam.linear());
      const std::string line = staticTransformLine(T_corrected, base_frame, extrinsics.frame);
      static_transform += (static_transform.empty() ? "" : "\n") + line;
      finding.remedy = "correct the mounting: " + line;
    }
    findings.push_back(finding);
  }
  if (findings.empty()) {
    findings.push_back({"camera_direction",
                        Verdict::kNotChecked,
                        "needs images with a calibration, odometry and the camera's tf",
                        {}});
  }
  return findings;
}

Finding checkTimeOffset(const std::vector<CameraExtrinsics>& cameras,
                        std::vector<SuggestedParameter>& parameters) {
  Finding finding{"image_time_offset", Verdict::kNotChecked, "needs camera_direction", {}};
  const CameraExtrinsics* best = nullptr;
  const auto isKnown = [](const CameraExtrinsics& m) {
    return m.offset.state == TimeOffsetState::kKnown;
  };
  for (const CameraExtrinsics& extrinsics : cameras) {
    if (extrinsics.estimate.state != ExtrinsicsState::kFound) continue;
    const bool is_better =
        best == nullptr || (isKnown(extrinsics) &&
                            (!isKnown(*best) || extrinsics.offset.sigma_s < best->offset.sigma_s));
    if (is_better) best = &extrinsics;
  }
  if (best == nullptr) return finding;
  if (!isKnown(*best)) {
    finding.text = text("because ", explain(best->offset.state));
    return finding;
  }
  finding.verdict = Verdict::kOk;
  const double offset_s = best->offset.offset_s;
  const std::string offset_ms = text(rounded(std::abs(offset_s) * 1000, 0), " ms (deviation ",
                                     rounded(best->offset.sigma_s * 1000, 1), ")");
  finding.text = text("images ", offset_s < 0 ? "late" : "early", " by ", offset_ms);
  if (std::abs(offset_s) < kSameTime_s) {
    parameters.push_back({"mapper", "image_time_offset_s", "0",
                          "images are stamped by the odometry's clock", kSameTime_s});
    return finding;
  }
  finding.verdict = Verdict::kWarning;
  finding.text = text("images are stamped ", offset_s < 0 ? "late" : "early", " by ", offset_ms,
                      " against the odometry");
  finding.remedy = "set image_time_offset_s";
  parameters.push_back({"mapper", "image_time_offset_s", rounded(offset_s, 3),
                        "images are stamped by another clock, or late", kSameTime_s});
  finding.answered_by = {parameters.back()};
  return finding;
}

}  // namespace ardrone_vslam
