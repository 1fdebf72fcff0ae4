// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"
#include "world/render/world_lens.hpp"
#include "world/render/world_tiles.hpp"
#include "world/scene/world_scene.hpp"

namespace ardrone_vslam {

struct SceneView;

/// T_world_cam at a time after the image's stamp [s].
using CameraPath = std::function<Eigen::Isometry3d(double since_stamp_s)>;

/// How an image comes about while the camera moves. The stamp is the middle of the exposure of the
/// middle row.
struct Exposure {
  CameraPath motion;
  double readout_s = 0;  ///< how much later the last row is exposed than the first; 0: all at once
  double shutter_s = 0;  ///< how long each row is exposed; 0: no motion blur
  double gain = 1;       ///< of light and noise alike
};

/// Casts one exact ray per pixel; pixel (column, row) has its middle at these whole numbers. Where
/// the camera moves while the shutter is open, several, at equal times, so that no two see the
/// image more than about 2 pixels apart. 640x360 without blur takes 15-25 ms on one core. Bands of
/// rows are shared out among OpenCV's threads, whose number does not change the result.
class WorldRenderer {
 public:
  /// @param noise_grey  sigma of the sensor's white noise
  /// @throws std::invalid_argument when the lens model folds back inside the image
  explicit WorldRenderer(const CameraIntrinsics& camera, double noise_grey = 2);

  /// 8-bit grey. Equal seeds give equal noise.
  cv::Mat render(const Scene& scene, const Eigen::Isometry3d& T_world_cam,
                 std::uint64_t noise_seed) const;
  /// The scene stands still meanwhile.
  cv::Mat render(const Scene& scene, const Exposure& exposure, std::uint64_t noise_seed) const;

  /// Mean grey of the image at gain 1, by every eighth pixel of every eighth row.
  double meanGrey(const Scene& scene, const Eigen::Isometry3d& T_world_cam) const;

 private:
  int blurSamples(const Exposure& exposure) const;
  void renderBand(int band, const Scene& scene, const Exposure& exposure, int samples,
                  std::uint64_t noise_seed, cv::Mat& image) const;
  /// Adds what the pixels `step` apart see to `sums`.
  void addRow(int row, int step, const SceneView& view, const BandSurfaces& seen,
              float* sums) const;
  void develop(int row, float gain, std::uint64_t noise_seed, const float* sums,
               std::uint8_t* pixels) const;

  CameraIntrinsics camera_;
  std::vector<Eigen::Vector2f> rays_;  // (width + 1) x (height + 1): each pixel has a next one
  std::vector<float> noise_grey_;      // a supply of normal numbers
  std::unique_ptr<const TilePyramids> tiles_;
};

}  // namespace ardrone_vslam
