// SPDX-License-Identifier: BSD-3-Clause
#include "pictures.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "frames.hpp"
#include "sequences/sequence.hpp"
#include "simulation/random_source.hpp"
#include "source_images.hpp"
#include "world/world_sequence.hpp"
#include "world_views.hpp"

namespace ardrone_vslam::reproduction {
namespace {

PicturePair readWall(const std::string& folder) {
  PicturePair pair;
  pair.what = "graf, pictures 1 and 2 (800x640)";
  pair.first = quality::readGrey(folder + "/graf/img1.ppm");
  pair.second = quality::readGrey(folder + "/graf/img2.ppm");
  const auto sizeOf = [](const cv::Mat& image) { return Eigen::Vector2d(image.cols, image.rows); };
  pair.geometry = quality::planeGeometry(quality::readHomography(folder + "/graf/H1to2p"),
                                         sizeOf(pair.first), sizeOf(pair.second));
  return pair;
}

PicturePair renderWall() {
  static const CameraIntrinsics camera = bench::resized(arDroneFrontCamera(), 640, 360);
  static const quality::WorldViews world(camera);
  const Eigen::Isometry3d T_world_first = quality::lookAlong(0, {0, 0, 1.4});
  const Eigen::Isometry3d T_world_second = quality::lookAlong(0.1, {0.3, -0.3, 1.4});
  PicturePair pair;
  pair.what = "two rendered views of the synthetic room (640x360)";
  pair.first = world.render(T_world_first, 1);
  pair.second = world.render(T_world_second, 2);
  pair.geometry = world.geometry(T_world_first, T_world_second);
  return pair;
}

std::unique_ptr<Sequence> renderedFlight(std::size_t frames) {
  WorldOptions options;
  options.rate_hz = 30;
  options.duration_s = static_cast<double>(frames) / options.rate_hz;
  options.camera = bench::resized(arDroneFrontCamera(), 320, 240);
  options.effects.shutter_s = 0.008;
  options.effects.noise_grey = 4;
  return std::make_unique<WorldSequence>(options);
}

}  // namespace

std::vector<NamedPicture> thesisPictures(bool quick) {
  std::vector<NamedPicture> pictures;
  const auto folder = bench::dataFolder();
  const auto source = quality::sweepImages(quick);
  const std::vector<std::string> names =
      quick ? std::vector<std::string>{"lena"}
            : std::vector<std::string>{"mandrill", "peppers", "lena"};
  for (std::size_t i = 0; i < source.images.size(); ++i)
    pictures.push_back({folder ? names[i] : "room " + std::to_string(i + 1), source.images[i]});
  return pictures;
}

const PicturePair& wallPictures() {
  static const PicturePair pair = [] {
    const auto folder = bench::dataFolder();
    return folder ? readWall(*folder) : renderWall();
  }();
  return pair;
}

std::vector<cv::Mat> smallVideo(std::size_t frames, std::string& what) {
  const auto folder = bench::dataFolder();
  const auto sequence =
      folder ? openFolder(*folder + "/seven_scenes_kitchen") : renderedFlight(frames);
  what = folder ? "7-Scenes kitchen, 640x480 halved"
                : "a rendered flight, exposed for 8 ms, noise of 4 grey levels";
  std::vector<cv::Mat> video;
  for (std::size_t i = 0; i < std::min(frames, sequence->size()); ++i) {
    const cv::Mat image = sequence->image(i);
    video.emplace_back();
    cv::resize(image, video.back(), {320, 240}, 0, 0, cv::INTER_AREA);
  }
  return video;
}

cv::Mat withNoise(const cv::Mat& image, double sigma_grey, std::uint64_t seed) {
  RandomSource random(seed);
  cv::Mat noisy(image.size(), CV_8UC1);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      noisy.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(image.at<std::uint8_t>(y, x) +
                                                                     sigma_grey * random.normal());
  return noisy;
}

}  // namespace ardrone_vslam::reproduction
