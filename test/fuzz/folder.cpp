// SPDX-License-Identifier: BSD-3-Clause
// The text files of KITTI's and TUM's folders: refused by name, or a sequence that is finite and in
// order. The images are always the same.
#include <cmath>

#include "fuzz/fuzz_input.hpp"
#include "sequences/sequence.hpp"
#include "support/sequence_folders.hpp"

namespace ardrone_vslam::fuzz {
namespace {

constexpr int kImages = 3;
constexpr char kSeparator = '\x1e';
const std::vector<std::string> kKittiFiles{"calib.txt", "times.txt", "poses.txt"};
const std::vector<std::string> kTumFiles{"camera.yaml", "times.txt", "poses_tum.txt",
                                         "odometry_tum.txt", "range.txt"};

/// A folder of each kind, with its images.
class Folders {
 public:
  Folders() {
    writeImages(kitti_, "image_0", kImages);
    writeImages(tum_, "image", kImages);
  }
  const TemporaryFolder& folder(bool is_kitti) const { return is_kitti ? kitti_ : tum_; }

  /// The files one after the other; an empty one is not there.
  void write(bool is_kitti, const std::string& text) const {
    std::size_t begin = 0;
    for (const std::string& name : is_kitti ? kKittiFiles : kTumFiles) {
      const std::size_t end = std::min(text.find(kSeparator, begin), text.size());
      const std::string content = text.substr(begin, end - begin);
      content.empty() ? folder(is_kitti).remove(name) : folder(is_kitti).write(name, content);
      begin = std::min(end + 1, text.size());
    }
  }

 private:
  TemporaryFolder kitti_;
  TemporaryFolder tum_;
};

void requireSound(const Sequence& sequence) {
  require(sequence.size() == kImages, "all images are there");
  for (std::size_t i = 1; i < sequence.size(); ++i)
    require(sequence.stamp_ns(i) > sequence.stamp_ns(i - 1), "stamps ascend");
  const auto require_finite = [](const Eigen::Isometry3d& pose) {
    require(pose.matrix().allFinite(), "poses are finite");
    require(pose.linear().isUnitary(1e-3), "attitudes are rotations");
  };
  for (const StampedPose& pose : sequence.truth().poses()) require_finite(pose.T_frame_body);
  for (const OdometryState& state : sequence.odometry()) require_finite(state.T_odom_base);
  if (!sequence.truth().empty()) require_finite(sequence.truth().at(sequence.stamp_ns(0)));
  const CameraIntrinsics& camera = sequence.camera();
  require(camera.width_px == 32 && camera.height_px == 24, "the calibration is for the images");
  try {
    const CameraModel model(camera);
  } catch (const std::invalid_argument&) {  // its fault is told when the run begins
  }
}

std::string seedOf(bool is_kitti) {
  const TemporaryFolder folder;
  is_kitti ? makeKittiFolder(folder, kImages) : makeTumFolder(folder, kImages);
  if (!is_kitti) {
    folder.write("odometry_tum.txt", "0 0 0 1 0 0 0 1\n0.1 0.1 0 1 0 0 0 1\n0.1 0.2 0 1 0 0 0 1\n");
    folder.write("range.txt", "# stamp range\n0 1.5\n0.05 nan\n0.1 1.4\n");
  }
  std::string text = is_kitti ? "k" : "t";
  for (const std::string& name : is_kitti ? kKittiFiles : kTumFiles) {
    std::ifstream file(folder.file(name), std::ios::binary);
    text += std::string(std::istreambuf_iterator<char>(file), {}) + kSeparator;
  }
  return text;
}

}  // namespace

std::vector<Bytes> seeds() {
  return {bytesOf(seedOf(true)), bytesOf(seedOf(false))};
}

std::size_t repair(std::uint8_t* /*data*/, std::size_t size, std::size_t /*most_size*/) {
  return size;
}

}  // namespace ardrone_vslam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ardrone_vslam;
  static const fuzz::Folders folders;
  fuzz::FuzzInput input(data, size);
  const bool is_kitti = (input.take<std::uint8_t>() & 1U) != 0;  // 'k' is odd, 't' even
  folders.write(is_kitti, input.text());
  const std::string path = folders.folder(is_kitti).path();
  try {
    fuzz::requireSound(*openFolder(path));
  } catch (const std::runtime_error& error) {
    fuzz::require(std::string(error.what()).rfind(path, 0) == 0, "errors name the file");
  }
  return 0;
}
