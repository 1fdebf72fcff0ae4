// SPDX-License-Identifier: BSD-3-Clause
#include "sequences/faulty_sequence.hpp"

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "ardrone_vslam/rotation.hpp"
#include "sequences/sequence_view.hpp"

namespace ardrone_vslam {
namespace {

/// What is wrong; by itself nothing.
struct Fault {
  bool is_mirrored = false;
  std::int64_t late_ns = 0;
  double focal_factor = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

Fault parseFault(const std::string& text) {
  Fault fault;
  fault.is_mirrored = text == "mirrored";
  if (fault.is_mirrored) return fault;
  const auto equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
  char* end = nullptr;
  const double value = std::strtod(number.c_str(), &end);
  const bool is_number = !number.empty() && *end == '\0' && std::isfinite(value);
  const auto about = [value](int axis) {
    return rotationOf(value * M_PI / 180 * Eigen::Vector3d::Unit(axis));
  };
  if (is_number && name == "late") {
    fault.late_ns = std::llround(value * 1e9);
  } else if (is_number && name == "focal" && value > 0) {
    fault.focal_factor = value;
  } else if (is_number && name == "pitch") {
    fault.rotation = about(0);
  } else if (is_number && name == "yaw") {
    fault.rotation = about(1);
  } else if (is_number && name == "roll") {
    fault.rotation = about(2);
  } else {
    throw std::invalid_argument("fault '" + text +
                                "' must be mirrored, late=SECONDS, focal=FACTOR, or roll=, pitch= "
                                "or yaw=DEGREES, for example late=0.3");
  }
  return fault;
}

class FaultySequence : public SequenceView {
 public:
  FaultySequence(std::unique_ptr<Sequence> sequence, const Fault& fault)
      : SequenceView(std::move(sequence)), fault_(fault), first_(cameraAt(cameraOf(0))) {}

  std::int64_t stamp_ns(std::size_t index) const override {
    return sequence().stamp_ns(index) + fault_.late_ns;
  }
  cv::Mat image(std::size_t index) override {
    const cv::Mat image = sequence().image(index);
    return fault_.is_mirrored ? mirroredImage(image) : image;
  }
  const CameraIntrinsics& camera() const override { return first_.intrinsics; }
  Eigen::Isometry3d T_base_cam() const override { return first_.T_base_cam; }
  SequenceCamera cameraAt(std::size_t which) const override {
    SequenceCamera camera = sequence().cameraAt(which);
    camera.intrinsics.fx_px *= fault_.focal_factor;
    camera.intrinsics.fy_px *= fault_.focal_factor;
    camera.T_base_cam.linear() = camera.T_base_cam.linear() * fault_.rotation;
    return camera;
  }

 private:
  Fault fault_;
  SequenceCamera first_;
};

}  // namespace

std::unique_ptr<Sequence> withFault(std::unique_ptr<Sequence> sequence, const std::string& fault) {
  return std::make_unique<FaultySequence>(std::move(sequence), parseFault(fault));
}

}  // namespace ardrone_vslam
