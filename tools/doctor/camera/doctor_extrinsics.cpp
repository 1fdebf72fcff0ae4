// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/camera/doctor_extrinsics.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kFewestMotions = 10;
constexpr double kCoarse_px = 40;    // cut of the residuals while turns by 90 degrees are compared
constexpr double kFine_px = 8;       // and for the rest
constexpr double kOther_rad = 0.6;   // further apart than this are two mountings, not one
constexpr double kClearly = 1.3;     // times as bad, and
constexpr double kClearly_px = 0.4;  // so much worse is a rival that is none
constexpr double kLargestOffset_s = 0.3;
constexpr double kOffsetStep_s = 0.04;
constexpr double kAgrees = 0.6;  // share of what it is without any motion

double angleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

/// Pattern search about the camera's axes, from steps of 16 degrees down to an eighth of one.
Eigen::Matrix3d refined(const std::vector<SeenMotion>& motions, Eigen::Matrix3d R, double cut_px) {
  constexpr double kFirst_rad = 16 * M_PI / 180, kLast_rad = 0.1 * M_PI / 180;
  double best_px = misfit_px(motions, R, cut_px);
  for (double step_rad = kFirst_rad; step_rad > kLast_rad;) {
    bool is_better = false;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d rotation =
          Eigen::Vector3d::Unit(i % 3) * (i < 3 ? step_rad : -step_rad);
      const Eigen::Matrix3d turned = R * rotationOf(rotation);
      const double turned_px = misfit_px(motions, turned, cut_px);
      if (turned_px >= best_px) continue;
      best_px = turned_px;
      R = turned;
      is_better = true;
    }
    if (!is_better) step_rad /= 2;
  }
  return R;
}

std::vector<ImagePair> everyOther(const std::vector<ImagePair>& pairs, std::size_t first) {
  std::vector<ImagePair> half;
  for (std::size_t i = first; i < pairs.size(); i += 2) half.push_back(pairs[i]);
  return half;
}

/// A rotation and an offset, and how well the images fit them.
struct Candidate {
  double misfit_px;
  Eigen::Matrix3d R_base_cam;
  double offset_s;
  bool operator<(const Candidate& other) const { return misfit_px < other.misfit_px; }
};

/// The offset about `candidate`'s that fits best, to a millisecond.
Candidate withBestOffset(const std::vector<ImagePair>& pairs, const OdometryWitness& odometry,
                         const Candidate& candidate) {
  Candidate best = candidate;
  best.misfit_px = misfit_px(odometry.motions(pairs, best.offset_s), best.R_base_cam, kFine_px);
  for (double step_s = kOffsetStep_s / 2; step_s > 0.0005;) {
    bool is_better = false;
    for (const double offset_s : {best.offset_s - step_s, best.offset_s + step_s}) {
      if (std::abs(offset_s) > kLargestOffset_s) continue;
      const double moved_px =
          misfit_px(odometry.motions(pairs, offset_s), best.R_base_cam, kFine_px);
      if (moved_px >= best.misfit_px) continue;
      best = {moved_px, best.R_base_cam, offset_s};
      is_better = true;
    }
    if (!is_better) step_s /= 2;
  }
  return best;
}

Candidate refined(const std::vector<ImagePair>& pairs, const OdometryWitness& odometry,
                  Candidate candidate) {
  for (const double cut_px : {kCoarse_px, kFine_px}) {
    const auto motions = odometry.motions(pairs, candidate.offset_s);
    candidate.R_base_cam = refined(motions, candidate.R_base_cam, cut_px);
    candidate = withBestOffset(pairs, odometry, candidate);
  }
  const auto motions = odometry.motions(pairs, candidate.offset_s);
  candidate.R_base_cam = refined(motions, candidate.R_base_cam, kFine_px);
  candidate.misfit_px = misfit_px(motions, candidate.R_base_cam, kFine_px);
  return candidate;
}

/// All mountings by quarter turns, each at the offset that suits it best; best first.
std::vector<Candidate> coarseCandidates(const std::vector<ImagePair>& pairs,
                                        const OdometryWitness& odometry,
                                        const Eigen::Matrix3d& R_base_cam_told) {
  const std::vector<Eigen::Matrix3d> rotations = quarterTurns();
  std::vector<Candidate> candidates;
  candidates.reserve(rotations.size());
  for (const Eigen::Matrix3d& rotation : rotations)
    candidates.push_back({2 * kCoarse_px, R_base_cam_told * rotation, 0});
  const auto steps = static_cast<int>(std::lround(kLargestOffset_s / kOffsetStep_s));
  for (int i = -steps; i <= steps; ++i) {
    const double offset_s = i * kOffsetStep_s;
    const auto motions = odometry.motions(pairs, offset_s);
    if (motions.size() < kFewestMotions) continue;
    for (Candidate& candidate : candidates) {
      const double moved_px = misfit_px(motions, candidate.R_base_cam, kCoarse_px);
      if (moved_px >= candidate.misfit_px) continue;
      candidate.misfit_px = moved_px;
      candidate.offset_s = offset_s;
    }
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

/// The best ones, refined, until some are others than the best; best first.
std::vector<Candidate> refinedCandidates(const std::vector<ImagePair>& pairs,
                                         const OdometryWitness& odometry,
                                         const Eigen::Matrix3d& R_base_cam_told) {
  constexpr int kRivals = 3;
  std::vector<Candidate> candidates;
  int rivals = 0;
  for (const Candidate& coarse : coarseCandidates(pairs, odometry, R_base_cam_told)) {
    candidates.push_back(refined(pairs, odometry, coarse));
    const Eigen::Matrix3d& R_first = candidates.front().R_base_cam;
    rivals += angleBetween(candidates.back().R_base_cam, R_first) < kOther_rad ? 0 : 1;
    if (rivals == kRivals) break;
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

}  // namespace

ExtrinsicsEstimate estimateExtrinsics(const std::vector<ImagePair>& pairs,
                                      const OdometryWitness& odometry,
                                      const Eigen::Matrix3d& R_base_cam_told) {
  ExtrinsicsEstimate estimate;
  estimate.R_base_cam = R_base_cam_told;
  estimate.motions = odometry.motions(pairs, 0).size();
  if (estimate.motions < kFewestMotions) return estimate;

  const std::vector<Candidate> candidates = refinedCandidates(pairs, odometry, R_base_cam_told);
  const Candidate& best = candidates.front();
  estimate.R_base_cam = best.R_base_cam;
  estimate.misfit_px = best.misfit_px;
  estimate.offset_s = best.offset_s;
  estimate.misfit_told_px =
      misfit_px(odometry.motions(pairs, best.offset_s), R_base_cam_told, kFine_px);
  estimate.misfit_unmoved_px = misfit_px(odometry.motions(pairs, 0), best.R_base_cam, kFine_px);
  estimate.off_rad = angleBetween(best.R_base_cam, R_base_cam_told);
  estimate.misfit_rival_px = kFine_px;
  for (const Candidate& candidate : candidates) {
    if (angleBetween(candidate.R_base_cam, best.R_base_cam) < kOther_rad) continue;
    estimate.misfit_rival_px = std::min(estimate.misfit_rival_px, candidate.misfit_px);
  }
  const Candidate even = refined(everyOther(pairs, 0), odometry, best);
  const Candidate odd = refined(everyOther(pairs, 1), odometry, best);
  estimate.unsure_rad = angleBetween(even.R_base_cam, odd.R_base_cam);
  const bool is_clear = estimate.misfit_rival_px > kClearly * estimate.misfit_px &&
                        estimate.misfit_rival_px > estimate.misfit_px + kClearly_px;
  estimate.state = estimate.misfit_px > kAgrees * kFine_px ? ExtrinsicsState::kNoAgreement
                   : !is_clear                             ? ExtrinsicsState::kAmbiguous
                                                           : ExtrinsicsState::kFound;
  return estimate;
}

}  // namespace ardrone_vslam
