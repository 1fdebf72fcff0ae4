// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "map_file/map_sections.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kAnchorRecord = 104;

std::string ofAnchor(std::size_t index, const std::string& what) {
  return "anchor " + std::to_string(index + 1) + " " + what;
}

/// An infinite variance is none, and 0 is a coordinate that is known exactly.
std::string varianceFault(const Eigen::MatrixXd& covariance) {
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    const double variance = covariance(i, i);
    if (!std::isfinite(variance) || variance < 0)
      return ofAnchor(static_cast<std::size_t>(i / SavedMap::kAnchor),
                      "has a variance that is negative or not finite");
  }
  return {};
}

/// Whether it could be one, by its lower triangle. @pre no varianceFault
bool isPositiveSemidefinite(const Eigen::MatrixXd& covariance) {
  // Correlations all have one scale. A filter's rounding leaves errors of less than this in them.
  constexpr double kTolerance = 1e-8;
  const Eigen::Index n = covariance.rows();
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index column = 0; column < n; ++column) {
    const double sigma = std::sqrt(covariance(column, column));
    for (Eigen::Index row = column + 1; row < n; ++row) {
      const double other_sigma = std::sqrt(covariance(row, row));
      const double value = covariance(row, column);
      const bool is_known = sigma == 0 || other_sigma == 0;
      if (is_known && value != 0) return false;
      const double share = is_known ? 0 : value / sigma / other_sigma;
      if (!(std::abs(share) <= 1 + kTolerance)) return false;
      correlation(row, column) = share;
    }
  }
  correlation.diagonal().array() += kTolerance;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> root(correlation);
  return root.info() == Eigen::Success;
}

std::string covarianceFault(const Eigen::MatrixXd& covariance) {
  std::string fault = varianceFault(covariance);
  if (fault.empty() && !isPositiveSemidefinite(covariance))
    fault = "the covariance of the anchors is none (not positive semidefinite)";
  return fault;
}

MapAnchor readAnchor(ByteReader& in) {
  MapAnchor anchor;
  anchor.stamp_ns = in.i64();
  anchor.T_map_rig = readPose(in);
  return anchor;
}

Eigen::MatrixXd readCovariance(ByteReader& in, Eigen::Index size) {
  Eigen::MatrixXd covariance(size, size);
  for (Eigen::Index row = 0; row < size; ++row) {
    for (Eigen::Index column = 0; column <= row; ++column)
      covariance(row, column) = covariance(column, row) = in.f64();
  }
  return covariance;
}

}  // namespace

std::string poseFault(const Eigen::Isometry3d& pose) {
  constexpr double kTolerance = 1e-5;
  const Eigen::Matrix3d R = pose.linear();
  if (!pose.translation().allFinite() || !R.allFinite()) return "has a pose that is not finite";
  const bool is_rotation = (R * R.transpose()).isIdentity(kTolerance) && R.determinant() > 0;
  return is_rotation ? "" : "has an attitude that is no rotation";
}

void writePose(const Eigen::Isometry3d& pose, ByteWriter& out) {
  const Eigen::Vector3d position = pose.translation();
  for (int i = 0; i < 3; ++i) out.f64(position[i]);
  const Eigen::Matrix3d R = pose.linear();
  for (int i = 0; i < 9; ++i) out.f64(R(i / 3, i % 3));
}

Eigen::Isometry3d readPose(ByteReader& in) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 3; ++i) pose.translation()[i] = in.f64();
  for (int i = 0; i < 9; ++i) pose.linear()(i / 3, i % 3) = in.f64();
  return pose;
}

std::string anchorsFault(const SavedMap& map) {
  const std::size_t count = map.anchors.size();
  if (count > kMostAnchors)
    return "there are " + std::to_string(count) + " anchors, at most " +
           std::to_string(kMostAnchors) + " can be kept";
  const auto size = static_cast<Eigen::Index>(count) * SavedMap::kAnchor;
  if (map.anchor_covariance.rows() != size || map.anchor_covariance.cols() != size)
    return "the covariance of the anchors has another size than they";
  for (std::size_t i = 0; i < count; ++i) {
    const std::string fault = poseFault(map.anchors[i].T_map_rig);
    if (!fault.empty()) return ofAnchor(i, fault);
  }
  return covarianceFault(map.anchor_covariance);
}

std::size_t anchorsSize(std::size_t anchors) {
  const std::size_t n = anchors * SavedMap::kAnchor;
  return 4 + anchors * kAnchorRecord + n * (n + 1) / 2 * 8;
}

void writeAnchors(const std::vector<MapAnchor>& anchors, ByteWriter& out) {
  out.u32(static_cast<std::uint32_t>(anchors.size()));
  for (const MapAnchor& anchor : anchors) {
    out.i64(anchor.stamp_ns);
    writePose(anchor.T_map_rig, out);
  }
}

void writeCovarianceRow(const Eigen::MatrixXd& covariance, Eigen::Index row, ByteWriter& out) {
  for (Eigen::Index column = 0; column <= row; ++column) out.f64(covariance(row, column));
}

void readAnchors(ByteReader in, SavedMap& map) {
  const std::size_t size = in.remaining();
  const std::uint32_t count = in.u32();
  // The count first: the size of no greater one overflows, whatever the processor's word.
  if (in.isShort() || count > kMostAnchors || size != anchorsSize(count))
    refuseSection(kAnchorsTag, "its size does not fit its number of anchors, or that is above " +
                                   std::to_string(kMostAnchors));
  map.anchors.reserve(count);
  for (std::size_t i = 0; i < count; ++i) map.anchors.push_back(readAnchor(in));
  map.anchor_covariance = readCovariance(in, Eigen::Index{SavedMap::kAnchor} * count);
  const std::string fault = anchorsFault(map);
  if (!fault.empty()) refuseSection(kAnchorsTag, fault);
}

}  // namespace ardrone_vslam
