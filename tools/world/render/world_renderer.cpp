// SPDX-License-Identifier: BSD-3-Clause
#include "world/render/world_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "simulation/random_source.hpp"
#include "world/render/world_view.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kNoiseSupply = 1 << 14;

/// How far the second pose is from the first.
PoseSlack slackBetween(const Eigen::Isometry3d& T_world_a, const Eigen::Isometry3d& T_world_b) {
  const Eigen::Matrix3d R_a_b = T_world_a.linear().transpose() * T_world_b.linear();
  return {Eigen::AngleAxisd(R_a_b).angle(),
          (T_world_b.translation() - T_world_a.translation()).norm()};
}

}  // namespace

WorldRenderer::WorldRenderer(const CameraIntrinsics& camera, double noise_grey) : camera_(camera) {
  for (int row = 0; row <= camera.height_px; ++row) {
    for (int column = 0; column <= camera.width_px; ++column) {
      Eigen::Vector3d direction;
      if (!exactDirection(camera, {column, row}, direction)) {
        throw std::invalid_argument(
            "the camera's distortion folds back inside the image at pixel (" +
            std::to_string(column) + ", " + std::to_string(row) +
            "); give the coefficients of a real lens");
      }
      rays_.push_back(direction.head<2>().cast<float>());
    }
  }
  tiles_ =
      std::make_unique<TilePyramids>(rays_, camera.width_px, camera.height_px, camera.width_px + 1);
  RandomSource random(0);
  for (std::size_t i = 0; i < kNoiseSupply; ++i) {
    noise_grey_.push_back(static_cast<float>(noise_grey * random.normal()));
  }
}

cv::Mat WorldRenderer::render(const Scene& scene, const Eigen::Isometry3d& T_world_cam,
                              std::uint64_t noise_seed) const {
  Exposure still;
  still.motion = [&](double) { return T_world_cam; };
  return render(scene, still, noise_seed);
}

cv::Mat WorldRenderer::render(const Scene& scene, const Exposure& exposure,
                              std::uint64_t noise_seed) const {
  cv::Mat image(camera_.height_px, camera_.width_px, CV_8UC1);
  const int samples = blurSamples(exposure);
  cv::parallel_for_(cv::Range(0, tiles_->bands()), [&](const cv::Range& bands) {
    for (int band = bands.start; band < bands.end; ++band) {
      renderBand(band, scene, exposure, samples, noise_seed, image);
    }
  });
  return image;
}

double WorldRenderer::meanGrey(const Scene& scene, const Eigen::Isometry3d& T_world_cam) const {
  constexpr int kStep_px = 8;
  const int width = (camera_.width_px + kStep_px - 1) / kStep_px;
  std::vector<float> sums(static_cast<std::size_t>(camera_.width_px), 0);
  int rows = 0;
  for (int row = kStep_px / 2; row < camera_.height_px; row += kStep_px, ++rows) {
    const BandSurfaces seen =
        tiles_->seenIn(row / TilePyramids::kTile_px, scene, T_world_cam, PoseSlack{});
    addRow(row, kStep_px, SceneView(seen.surfaces, scene.lighting, T_world_cam), seen, sums.data());
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0) / (width * rows);
}

int WorldRenderer::blurSamples(const Exposure& exposure) const {
  constexpr double kNear_m = 2, kApart_px = 2;
  constexpr int kMost = 24;
  if (exposure.shutter_s <= 0) return 1;
  const PoseSlack moved = slackBetween(exposure.motion(-exposure.shutter_s / 2),
                                       exposure.motion(exposure.shutter_s / 2));
  const double blur_px = camera_.fx_px * (moved.angle_rad + moved.shift_m / kNear_m);
  return static_cast<int>(std::min<double>(kMost, std::max(1.0, std::ceil(blur_px / kApart_px))));
}

namespace {

/// Where the camera is at each sample of each row; without a rolling shutter of the first row
/// alone.
std::vector<Eigen::Isometry3d> posesOf(const Exposure& exposure, int first, int end, int height_px,
                                       int samples) {
  const bool is_rolling = exposure.readout_s > 0;
  const auto offset_s = [&](int row, int sample) {
    return (is_rolling ? ((row + 0.5) / height_px - 0.5) * exposure.readout_s : 0) +
           ((sample + 0.5) / samples - 0.5) * exposure.shutter_s;
  };
  std::vector<Eigen::Isometry3d> T_world_cam;
  for (int row = first; row < (is_rolling ? end : first + 1); ++row) {
    for (int i = 0; i < samples; ++i) T_world_cam.push_back(exposure.motion(offset_s(row, i)));
  }
  return T_world_cam;
}

/// How far the poses are from one of them.
PoseSlack slackAround(const Eigen::Isometry3d& middle,
                      const std::vector<Eigen::Isometry3d>& T_world_cam) {
  PoseSlack slack;
  for (const auto& pose : T_world_cam) {
    const PoseSlack moved = slackBetween(middle, pose);
    slack.angle_rad = std::max(slack.angle_rad, moved.angle_rad);
    slack.shift_m = std::max(slack.shift_m, moved.shift_m);
  }
  return slack;
}

}  // namespace

void WorldRenderer::renderBand(int band, const Scene& scene, const Exposure& exposure, int samples,
                               std::uint64_t noise_seed, cv::Mat& image) const {
  const int first = band * TilePyramids::kTile_px;
  const int end = std::min(first + TilePyramids::kTile_px, camera_.height_px);
  const bool is_rolling = exposure.readout_s > 0;
  const std::vector<Eigen::Isometry3d> T_world_cam =
      posesOf(exposure, first, end, camera_.height_px, samples);
  const Eigen::Isometry3d& middle = T_world_cam[T_world_cam.size() / 2];
  const BandSurfaces seen = tiles_->seenIn(band, scene, middle, slackAround(middle, T_world_cam));
  std::vector<SceneView> views;
  const float gain = static_cast<float>(exposure.gain) / static_cast<float>(samples);
  std::vector<float> sums(static_cast<std::size_t>(camera_.width_px));
  for (int row = first; row < end; ++row) {
    if (views.empty() || is_rolling) {
      views.clear();
      const auto begin = T_world_cam.begin() + (is_rolling ? (row - first) * samples : 0);
      for (auto pose = begin; pose != begin + samples; ++pose) {
        views.emplace_back(seen.surfaces, scene.lighting, *pose);
      }
    }
    std::fill(sums.begin(), sums.end(), 0.0F);
    for (const SceneView& view : views) addRow(row, 1, view, seen, sums.data());
    for (float& sum : sums) sum *= gain;
    develop(row, static_cast<float>(exposure.gain), noise_seed, sums.data(),
            image.ptr<std::uint8_t>(row));
  }
}

void WorldRenderer::addRow(int row, int step, const SceneView& view, const BandSurfaces& seen,
                           float* sums) const {
  const int width = camera_.width_px;
  const Eigen::Vector2f* rays = rays_.data() + static_cast<std::ptrdiff_t>(row) * (width + 1);
  const Eigen::Vector2f* rays_below = rays + width + 1;
  Eigen::Vector3f next = view.R_world_cam * rays[0].homogeneous();
  for (int column = 0; column < width; column += step) {
    const Eigen::Vector3f ray =
        step == 1 ? next : Eigen::Vector3f(view.R_world_cam * rays[column].homogeneous());
    next = view.R_world_cam * rays[column + 1].homogeneous();
    const SurfaceView* nearest = nullptr;
    float nearest_over_length = 0;
    Eigen::Vector2f at;
    for (const auto index :
         seen.of_tile[static_cast<std::size_t>(column / TilePyramids::kTile_px)]) {
      const SurfaceView& surface = view.surfaces[index];
      const float over_length = surface.over_distance.dot(ray);
      if (over_length <= nearest_over_length) continue;
      const Eigen::Vector2f hit = surface.hit(ray, 1 / over_length);
      if (!surface.contains(hit)) continue;
      nearest = &surface;
      nearest_over_length = over_length;
      at = hit;
    }
    if (nearest == nullptr) continue;
    const float length = 1 / nearest_over_length;
    const Eigen::Vector3f below = view.R_world_cam * rays_below[column].homogeneous();
    sums[column] +=
        view.light(ray * length) * nearest->grey(at, nearest->step(ray, next - ray, length),
                                                 nearest->step(ray, below - ray, length));
  }
}

void WorldRenderer::develop(int row, float gain, std::uint64_t noise_seed, const float* sums,
                            std::uint8_t* pixels) const {
  const std::uint64_t row_seed =
      RandomSource::mix(RandomSource::mix(noise_seed) + static_cast<std::uint64_t>(row));
  for (int column = 0; column < camera_.width_px; ++column) {
    const std::uint64_t random = RandomSource::mix(row_seed + static_cast<std::uint64_t>(column));
    const float grey = sums[column] + gain * noise_grey_[random % kNoiseSupply];
    pixels[column] = static_cast<std::uint8_t>(std::min(std::max(grey + 0.5F, 0.0F), 255.0F));
  }
}

}  // namespace ardrone_vslam
