// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/frame_tracker.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam {

struct WorldPoint {
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();
  Descriptor descriptor;
};

/// How features differ from what is really there.
struct ViewFaults {
  double pixel_noise_px = 0.5;  ///< sigma per axis
  int flipped_bits = 20;        ///< of each descriptor, drawn anew in every view
  /// Share of the features that are wrong: a third of them corners of nothing with a descriptor of
  /// their own, the rest points whose corner was found 5 to 40 px away.
  double wrong_share = 0;
  double lost_share = 0.1;  ///< points in view whose corner is not found
};

/// An ideal pinhole camera, and how far it sees.
struct PointCamera {
  int width_px = 640;
  int height_px = 360;
  double focal_length_px = 570;
  Eigen::Vector2d centre_px{320, 180};
  double nearest_m = 0.2;
  double range_m = 15;  ///< points further away are too small to be seen
};

/// Random points with random descriptors, seen by an ideal pinhole camera: truth for
/// everything behind the front end. Deterministic for a seed.
class PointWorld {
 public:
  explicit PointWorld(std::uint64_t seed, const ViewFaults& faults = {},
                      const PointCamera& camera = {}, const FrameTrackerConfig& tracker = {})
      : random_(seed),
        faults_(faults),
        camera_(camera),
        tracker_config_(tracker),
        tracker_(std::make_unique<FrameTracker>(tracker)) {}

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

  /// So many of the points take each other's descriptors: they look like points elsewhere. With all
  /// of them it is another place that looks alike.
  void exchangeDescriptors(double share) {
    std::vector<std::size_t> taken;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (random_.chance(share)) taken.push_back(i);
    }
    for (std::size_t k = taken.size(); k > 1; --k) {  // one cycle (Sattolo): nobody keeps its own
      const auto other = static_cast<std::size_t>(random_.integer(0, static_cast<int>(k) - 2));
      std::swap(points_[taken[k - 1]].descriptor, points_[taken[other]].descriptor);
      std::swap(taken[k - 1], taken[other]);
    }
  }

  const std::vector<WorldPoint>& points() const { return points_; }

  /// One view; the views of one world must be asked for in the order of their stamps, as features
  /// get track ids.
  ImageFeatures look(const Eigen::Isometry3d& T_map_cam, std::int64_t stamp_ns) {
    ImageFeatures features = emptyView(stamp_ns);
    const Eigen::Isometry3d T_cam_map = T_map_cam.inverse();
    for (const WorldPoint& point : points_) {
      const Eigen::Vector3d p = T_cam_map * point.position_map;
      if (p.z() < camera_.nearest_m || p.z() > camera_.range_m) continue;
      const Eigen::Vector2d pixel =
          camera_.focal_length_px * p.head<2>() / p.z() + camera_.centre_px;
      if (!isInside(pixel) || random_.chance(faults_.lost_share)) continue;
      addFeature(pixel, point.descriptor, features);
    }
    tracker_->assign(features);
    return features;
  }

  /// Another camera looks from now on: no track goes on.
  void changeCamera() {
    tracker_ = std::make_unique<FrameTracker>(tracker_config_, tracker_->nextTrackId());
  }

  /// A view without any corner, as of a dark image.
  ImageFeatures emptyView(std::int64_t stamp_ns) const {
    ImageFeatures features;
    features.stamp_ns = stamp_ns;
    features.width_px = camera_.width_px;
    features.height_px = camera_.height_px;
    features.focal_length_px = static_cast<float>(camera_.focal_length_px);
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
  bool isInside(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= camera_.width_px - 1 &&
           pixel.y() <= camera_.height_px - 1;
  }

  void addFeature(Eigen::Vector2d pixel, const Descriptor& descriptor, ImageFeatures& features) {
    Descriptor seen = flipped(descriptor, faults_.flipped_bits);
    pixel += faults_.pixel_noise_px * Eigen::Vector2d(random_.normal(), random_.normal());
    if (random_.chance(faults_.wrong_share)) {
      if (random_.chance(1.0 / 3)) {
        seen = randomDescriptor();
        pixel = {random_.uniform(0, camera_.width_px - 1),
                 random_.uniform(0, camera_.height_px - 1)};
      } else {
        const double turn = random_.uniform(0, 2 * M_PI);
        pixel += random_.uniform(5, 40) * Eigen::Vector2d(std::cos(turn), std::sin(turn));
      }
    }
    if (!isInside(pixel)) return;
    const Eigen::Vector2d plane = (pixel - camera_.centre_px) / camera_.focal_length_px;
    features.pixel_px.push_back(pixel.cast<float>());
    features.bearing_cam.push_back(
        Eigen::Vector3d(plane.x(), plane.y(), 1).normalized().cast<float>());
    features.score.push_back(100);
    features.descriptor.push_back(seen);
  }

  RandomSource random_;
  ViewFaults faults_;
  PointCamera camera_;
  FrameTrackerConfig tracker_config_;
  std::vector<WorldPoint> points_;
  std::unique_ptr<FrameTracker> tracker_;
};

}  // namespace ardrone_vslam
