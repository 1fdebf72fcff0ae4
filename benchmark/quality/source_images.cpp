// SPDX-License-Identifier: BSD-3-Clause
#include "source_images.hpp"

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "frames.hpp"
#include "world_views.hpp"

namespace ardrone_vslam::quality {
namespace {

constexpr int kSide_px = 512;

using Yaws = std::vector<double>;
using Names = std::vector<std::string>;

SourceImages renderImages(bool quick) {
  CameraIntrinsics camera;
  camera.width_px = camera.height_px = kSide_px;
  camera.fx_px = camera.fy_px = 450;
  camera.cx_px = camera.cy_px = (kSide_px - 1) / 2.0;
  const WorldViews world(camera);
  SourceImages source;
  source.what = quick ? "a rendered view of the synthetic room (512x512)"
                      : "three rendered views of the synthetic room (512x512)";
  for (const double yaw_rad : quick ? Yaws{0.3} : Yaws{0.3, 2.2, 4.4}) {
    const auto seed = static_cast<std::uint64_t>(source.images.size());
    source.images.push_back(world.render(lookAlong(yaw_rad, {0, 0, 1.5}), seed));
  }
  return source;
}

}  // namespace

cv::Mat readGrey(const std::string& path) {
  cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (image.empty()) {
    throw std::runtime_error("cannot read the image " + path +
                             "; let ARDRONE_VSLAM_DATA name a complete data folder, or unset it");
  }
  return image;
}

Eigen::Matrix3d readHomography(const std::string& path) {
  std::ifstream file(path);
  Eigen::Matrix3d H;
  for (int i = 0; i < 9; ++i) file >> H(i / 3, i % 3);
  if (!file) {
    throw std::runtime_error("cannot read the homography " + path +
                             ": nine numbers are expected; let ARDRONE_VSLAM_DATA name a complete "
                             "data folder, or unset it");
  }
  return H;
}

SourceImages sweepImages(bool quick) {
  const auto folder = bench::dataFolder();
  if (!folder) return renderImages(quick);
  SourceImages source;
  source.what = quick ? "lena (512x512)" : "mandrill, peppers and lena (512x512)";
  for (const auto& name : quick ? Names{"lena"} : Names{"mandrill", "peppers", "lena"}) {
    source.images.push_back(readGrey(*folder + "/images_512/" + name + ".png"));
  }
  return source;
}

}  // namespace ardrone_vslam::quality
