// SPDX-License-Identifier: BSD-3-Clause
#include "bags/bag_sequence.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <yaml-cpp/yaml.h>

#include <stdexcept>
#include <utility>

#include "bags/bag_cameras.hpp"
#include "bags/bag_images.hpp"
#include "bags/bag_poses.hpp"
#include "bags/bag_topics.hpp"
#include "bags/bag_writer.hpp"
#include "bags/messages/bag_messages.hpp"
#include "bags/messages/bag_open.hpp"
#include "bags/messages/bag_read_message.hpp"

namespace ardrone_vslam {
namespace {

/// From the note that make_bag and make_world leave; empty without one.
OdometryNote readOdometryNote(const rosbag::Bag& bag) {
  OdometryNote note;
  rosbag::View view(bag, rosbag::TopicQuery(BagTopicNames().info));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = readMessage<std_msgs::String>(instance);
    if (!message) continue;
    const YAML::Node yaml = YAML::Load(message->data);
    if (!yaml.IsMap()) continue;
    if (yaml["odometry_profile"]) note.profile = yaml["odometry_profile"].as<std::string>();
    if (yaml["seed"]) note.seed = yaml["seed"].as<std::uint64_t>();
    if (yaml["scale_error"]) note.scale_error = yaml["scale_error"].as<double>();
  }
  return note;
}

class BagFile : public BagSequence {
 public:
  BagFile(const std::string& path, const BagReadOptions& options) : name_(path) {
    openForReading(bag_, path);
    const ChosenTopics topics = chooseTopics(path, topicTypes(bag_), options);
    BagCameras cameras(bag_, topics.camera_info, options, findings_);
    images_ = std::make_unique<BagImages>(bag_, topics, cameras, findings_);
    BagOdometry odometry = readOdometry(topics, options);
    ranges_ = options.use_range ? readRanges(bag_, topics.range, findings_)
                                : readNavdataHeights(bag_, topics.navdata);
    truth_ = readTruth(bag_, topics.truth, findings_);
    const std::string base = odometry.base_frame;
    if (base.empty() && !odometry.states.empty() && !options.T_base_cam) {
      throw std::runtime_error(path + ", " + topics.odometry +
                               ": names no child_frame_id; name the base frame by --base-frame or "
                               "the parameter mapper/base_frame");
    }
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      const std::string frame =
          options.camera_frame.empty() ? cameras.frame(i) : withoutSlash(options.camera_frame);
      const bool is_used = !cameras.frame(i).empty();
      cameras_.push_back({cameras.intrinsics(i), options.T_base_cam ? *options.T_base_cam
                                                 : is_used
                                                     ? readExtrinsics(bag_, base, frame, "camera")
                                                     : Eigen::Isometry3d::Identity()});
    }
    odometry_ = std::move(odometry.states);
    odometry_faults_ = odometry.faults;
    note_ = readOdometryNote(bag_);
  }

  std::string name() const override { return name_; }
  std::size_t size() const override { return images_->size(); }
  std::int64_t stamp_ns(std::size_t index) const override { return images_->stamp_ns(index); }
  cv::Mat image(std::size_t index) override {
    cv::Mat image;
    namingTheBag(name_, [&] { image = images_->image(index); });
    return image;
  }
  const CameraIntrinsics& camera() const override { return first().intrinsics; }
  Eigen::Isometry3d T_base_cam() const override { return first().T_base_cam; }
  std::size_t cameraOf(std::size_t index) const override { return images_->cameraOf(index); }
  SequenceCamera cameraAt(std::size_t which) const override { return cameras_.at(which); }
  const Trajectory& truth() const override { return truth_; }
  const std::vector<OdometryState>& odometry() const override { return odometry_; }
  OdometryFaultCounts odometryInputFaults() const override { return odometry_faults_; }
  std::vector<RangeReading> ranges() const override { return ranges_; }
  OdometryNote odometryNote() const override { return note_; }
  const BagFindings& findings() const override { return findings_; }

 private:
  /// With the options' base frame, if they name one.
  BagOdometry readOdometry(const ChosenTopics& topics, const BagReadOptions& options) {
    BagOdometry odometry = options.odometry_mode == OdometryMode::kNavdata
                               ? readNavdata(bag_, topics, findings_)
                               : ardrone_vslam::readOdometry(bag_, topics.odometry, findings_);
    if (!options.base_frame.empty()) odometry.base_frame = options.base_frame;
    if (options.odometry_mode == OdometryMode::kImu) useImu(bag_, topics.imu, odometry, findings_);
    return odometry;
  }

  const SequenceCamera& first() const { return cameras_.at(images_->cameraOf(0)); }

  std::string name_;
  rosbag::Bag bag_;
  std::vector<SequenceCamera> cameras_;
  std::unique_ptr<BagImages> images_;
  Trajectory truth_;
  std::vector<OdometryState> odometry_;
  OdometryFaultCounts odometry_faults_{};
  std::vector<RangeReading> ranges_;
  OdometryNote note_;
  BagFindings findings_;
};

}  // namespace

std::unique_ptr<BagSequence> openBag(const std::string& path, const BagReadOptions& options) {
  std::unique_ptr<BagSequence> bag;
  namingTheBag(path, [&] { bag = std::make_unique<BagFile>(path, options); });
  return bag;
}

}  // namespace ardrone_vslam
