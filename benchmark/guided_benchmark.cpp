// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <memory>
#include <opencv2/features2d.hpp>
#include <random>
#include <vector>

#include "association/associator.hpp"
#include "row.hpp"
#include "rows.hpp"

namespace ardrone_vslam::bench {
namespace {

constexpr int kLandmarks = 100'000;
constexpr std::size_t kFeatures = 600;
constexpr int kPoses = 16;
constexpr int kFlippedBits = 40;  // as a point's descriptor changes from frame to frame
constexpr double kFocal_px = 721;
constexpr float kSearchRadius_px = 30;

Descriptor randomDescriptor(std::mt19937_64& random) {
  Descriptor descriptor;
  for (auto& word : descriptor.words) word = random();
  return descriptor;
}

/// A map about a street of 400 m, and what a camera sees of it from 16 places along it: 600 of the
/// landmarks that it could see. No tracks: all are looked for by descriptor.
struct Street {
  std::mt19937_64 random{1};
  LandmarkMap map{LandmarkMapConfig{}};
  std::vector<ImageFeatures> features{kPoses};
  std::vector<FrameView> views{kPoses};
  std::vector<VisibleLandmarks> visible{kPoses};

  Street() {
    const auto uniform = [this](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int i = 0; i < kLandmarks; ++i) {
      Landmark landmark;
      landmark.descriptor = randomDescriptor(random);
      landmark.position_map << uniform(0, 400), uniform(-30, 30), uniform(-2, 8);
      const auto rotation_rad = static_cast<float>(uniform(-M_PI, M_PI));
      landmark.view_direction_map << std::cos(rotation_rad), std::sin(rotation_rad), 0;
      landmark.seen_distance_m = static_cast<float>(uniform(5, 40));
      map.add(landmark);
    }
    for (std::size_t pose = 0; pose < kPoses; ++pose) look(pose);
  }

  void look(std::size_t pose) {
    ImageFeatures& seen = features[pose];
    seen.width_px = 1242;
    seen.height_px = 375;
    seen.focal_length_px = static_cast<float>(kFocal_px);
    addFeature(seen, -620, -187, randomDescriptor(random));  // they span the image
    addFeature(seen, 620, 187, randomDescriptor(random));
    Eigen::Isometry3d T_map_cam = Eigen::Isometry3d::Identity();
    T_map_cam.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    T_map_cam.translation() << 25.0 * static_cast<double>(pose), 0, 0;
    const auto reset = [&] {
      views[pose].reset(seen, T_map_cam, false);
      views[pose].setPositionVariance(1e-4, true);
    };
    reset();
    const AssociationConfig config;
    map.columns(views[pose].origin_map())
        .project(views[pose], {config.max_view_angle_deg, config.max_distance_ratio},
                 visible[pose]);
    const std::size_t count = visible[pose].count;
    for (std::size_t i = 2; i < kFeatures; ++i) {
      const std::size_t k = i * count / kFeatures;
      Descriptor descriptor(map.all()[static_cast<std::size_t>(visible[pose].index[k])].descriptor);
      for (int bit = 0; bit < kFlippedBits; ++bit)
        descriptor.words[random() % 8] ^= std::uint64_t{1} << (random() % 64);
      const Eigen::Vector2f pixel_px = visible[pose].pixel_px(k);
      addFeature(seen, pixel_px.x() + 2, pixel_px.y() + 1, descriptor);
    }
    reset();
  }

  static void addFeature(ImageFeatures& to, float x_px, float y_px, const Descriptor& descriptor) {
    to.pixel_px.emplace_back(x_px, y_px);
    to.bearing_cam.push_back(
        Eigen::Vector3f(x_px, y_px, static_cast<float>(kFocal_px)).normalized());
    to.score.push_back(1);
    to.track_id.push_back(kNoTrack);
    to.age_frames.push_back(0);
    to.descriptor.push_back(descriptor);
  }
};

Street& street() {
  static Street made;
  return made;
}

auto ours() {
  return [] {
    AssociationConfig config;
    config.search_radius_px = kSearchRadius_px;
    auto associator = std::make_shared<Associator>(config);
    auto result = std::make_shared<AssociationResult>();
    return [=](std::size_t i) {
      associator->matchLandmarks(street().views[i % kPoses], street().map, *result);
      return result->matches.size();
    };
  };
}

/// The same windows as a mask, but neither projection nor mask is measured.
auto openCv() {
  struct Frame {
    cv::Mat landmarks, features, mask;
  };
  return [] {
    auto frames = std::make_shared<std::vector<Frame>>(kPoses);
    for (std::size_t pose = 0; pose < kPoses; ++pose) {
      Frame& frame = (*frames)[pose];
      const VisibleLandmarks& visible = street().visible[pose];
      const ImageFeatures& seen = street().features[pose];
      const int rows = static_cast<int>(visible.count);
      const int columns = static_cast<int>(seen.size());
      frame.landmarks.create(rows, sizeof(Descriptor), CV_8U);
      frame.features.create(columns, sizeof(Descriptor), CV_8U);
      frame.mask.create(rows, columns, CV_8U);
      std::memcpy(frame.features.data, seen.descriptor.data(), seen.size() * sizeof(Descriptor));
      for (int row = 0; row < rows; ++row) {
        const auto k = static_cast<std::size_t>(row);
        const auto landmark = static_cast<std::size_t>(visible.index[k]);
        std::memcpy(frame.landmarks.ptr(row), &street().map.all()[landmark].descriptor,
                    sizeof(Descriptor));
        for (int column = 0; column < columns; ++column) {
          const Eigen::Vector2f offset_px =
              seen.pixel_px[static_cast<std::size_t>(column)] - visible.pixel_px(k);
          frame.mask.at<std::uint8_t>(row, column) = offset_px.norm() <= kSearchRadius_px ? 1 : 0;
        }
      }
    }
    auto matches = std::make_shared<std::vector<std::vector<cv::DMatch>>>();
    return [=](std::size_t i) {
      const Frame& frame = (*frames)[i % kPoses];
      matches->clear();  // knnMatch appends
      cv::BFMatcher(cv::NORM_HAMMING)
          .knnMatch(frame.landmarks, frame.features, *matches, 2, frame.mask);
      return matches->size();
    };
  };
}

}  // namespace

void addGuidedRows() {
  // One whole round each: the poses see different numbers of landmarks.
  side("guided_100k", "ours", ours())->Iterations(kPoses);
  side("guided_100k", "cv::BFMatcher, mask", openCv())->Iterations(kPoses);
}

}  // namespace ardrone_vslam::bench
