// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "../../tools/lib/random_source.hpp"
#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/frame_tracker.hpp"

namespace ardrone_vslam::test {

/// A forward camera's optical frame at the base (REP-103 to x right, y down, z forward).
inline Eigen::Isometry3d forwardMounting() {
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();
  T_base_cam.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T_base_cam;
}

struct WorldPoint {
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();
  Descriptor descriptor;
};

/// How features differ from what is really there.
struct ViewFaults {
  double pixel_noise_px = 0.5;  ///< deviation per axis
  int flipped_bits = 20;        ///< of each descriptor, drawn anew in every view
  /// Share of the features that are wrong: a third of them corners of nothing with a descriptor of
  /// their own, the rest points whose corner was found 5 to 40 px away.
  double wrong_share = 0;
  double lost_share = 0.1;  ///< points in view whose corner is not found
};

/// Random points with random descriptors, seen by an ideal pinhole camera: truth for tests of
/// everything behind the front end. Deterministic for a seed.
class PointWorld {
 public:
  static constexpr int kWidth_px = 640;
  static constexpr int kHeight_px = 360;
  static constexpr double kFocalLength_px = 570;
  static constexpr double kRange_m = 15;  ///< points further away are too small to be seen

  explicit PointWorld(std::uint64_t seed, const ViewFaults& faults = {})
      : random_(seed),
        faults_(faults),
        tracker_(std::make_unique<FrameTracker>(FrameTrackerConfig{})) {}

  void addPoint(const Eigen::Vector3d& position_map) {
    points_.push_back({position_map, randomDescriptor()});
  }
  /// Points on the four walls of a room about the origin, from floor (z = 0) to `size.z()`.
  void addRoom(const Eigen::Vector3d& size_m, int count) {
    for (int i = 0; i < count; ++i) {
      const double side = random_.chance(0.5) ? 0.5 : -0.5;
      const double along = random_.uniform(-0.5, 0.5);
      const double height_m = random_.uniform(0, size_m.z());
      const bool across = random_.chance(0.5);
      addPoint(across ? Eigen::Vector3d(side * size_m.x(), along * size_m.y(), height_m)
                      : Eigen::Vector3d(along * size_m.x(), side * size_m.y(), height_m));
    }
  }
  /// Points on both walls of a corridor along x, 2 m to each side, 3 m high.
  void addCorridor(double length_m, int count) {
    for (int i = 0; i < count; ++i) {
      const double side_m = random_.chance(0.5) ? 2 : -2;
      addPoint({random_.uniform(0, length_m), side_m, random_.uniform(0, 3)});
    }
  }
  /// Moves everything (points only: cameras are the caller's).
  void transform(const Eigen::Isometry3d& T_new_old) {
    for (WorldPoint& point : points_) point.position_map = T_new_old * point.position_map;
  }

  const std::vector<WorldPoint>& points() const { return points_; }

  /// One view; the views of one world must be asked for in the order of their stamps, as features
  /// get track ids.
  ImageFeatures look(const Eigen::Isometry3d& T_map_cam, std::int64_t stamp_ns) {
    ImageFeatures features = emptyView(stamp_ns);
    const Eigen::Isometry3d T_cam_map = T_map_cam.inverse();
    for (const WorldPoint& point : points_) {
      const Eigen::Vector3d p = T_cam_map * point.position_map;
      if (p.z() < 0.2 || p.z() > kRange_m) continue;
      const Eigen::Vector2d pixel =
          kFocalLength_px * p.head<2>() / p.z() + Eigen::Vector2d(centre().x(), centre().y());
      if (!isInside(pixel) || random_.chance(faults_.lost_share)) continue;
      addFeature(pixel, point.descriptor, features);
    }
    tracker_->assign(features);
    return features;
  }

  /// A view without any corner, as of a dark image.
  ImageFeatures emptyView(std::int64_t stamp_ns) const {
    ImageFeatures features;
    features.stamp_ns = stamp_ns;
    features.width_px = kWidth_px;
    features.height_px = kHeight_px;
    features.focal_length_px = static_cast<float>(kFocalLength_px);
    return features;
  }

  Descriptor randomDescriptor() {
    Descriptor descriptor;
    for (auto& word : descriptor.words) {
      for (int i = 0; i < 4; ++i)
        word = (word << 16) | static_cast<std::uint64_t>(random_.integer(0, 65535));
    }
    return descriptor;
  }

  /// The same descriptor with `bits` different bits.
  Descriptor flipped(const Descriptor& original, int bits) {
    Descriptor descriptor = original;
    Descriptor mask;
    for (int done = 0; done < bits;) {
      const int bit = random_.integer(0, 511);
      std::uint64_t& word = mask.words[static_cast<std::size_t>(bit / 64)];
      const std::uint64_t one = std::uint64_t{1} << (bit % 64);
      if ((word & one) != 0) continue;
      word |= one;
      ++done;
    }
    for (std::size_t i = 0; i < 8; ++i) descriptor.words[i] ^= mask.words[i];
    return descriptor;
  }

 private:
  static Eigen::Vector2d centre() { return {0.5 * kWidth_px, 0.5 * kHeight_px}; }
  static bool isInside(const Eigen::Vector2d& pixel) {
    return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= kWidth_px - 1 &&
           pixel.y() <= kHeight_px - 1;
  }

  void addFeature(Eigen::Vector2d pixel, const Descriptor& descriptor, ImageFeatures& features) {
    Descriptor seen = flipped(descriptor, faults_.flipped_bits);
    pixel += faults_.pixel_noise_px * Eigen::Vector2d(random_.normal(), random_.normal());
    if (random_.chance(faults_.wrong_share)) {
      if (random_.chance(1.0 / 3)) {
        seen = randomDescriptor();
        pixel = {random_.uniform(0, kWidth_px - 1), random_.uniform(0, kHeight_px - 1)};
      } else {
        const double turn = random_.uniform(0, 2 * M_PI);
        pixel += random_.uniform(5, 40) * Eigen::Vector2d(std::cos(turn), std::sin(turn));
      }
    }
    if (!isInside(pixel)) return;
    const Eigen::Vector2d plane = (pixel - centre()) / kFocalLength_px;
    features.pixel_px.push_back(pixel.cast<float>());
    features.bearing_cam.push_back(
        Eigen::Vector3d(plane.x(), plane.y(), 1).normalized().cast<float>());
    features.score.push_back(100);
    features.descriptor.push_back(seen);
  }

  RandomSource random_;
  ViewFaults faults_;
  std::vector<WorldPoint> points_;
  std::unique_ptr<FrameTracker> tracker_;
};

}  // namespace ardrone_vslam::test
