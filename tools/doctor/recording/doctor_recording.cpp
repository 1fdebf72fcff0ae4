// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/recording/doctor_recording.hpp"

#include <algorithm>

namespace ardrone_vslam {
namespace {

struct Ancestor {
  std::string frame;
  Eigen::Isometry3d T_ancestor_frame;
};

/// The frame itself first; ends where a damaged tree goes in circles.
std::vector<Ancestor> ancestorsOf(const DoctorRecording& recording, const std::string& frame) {
  std::vector<Ancestor> chain{{frame, Eigen::Isometry3d::Identity()}};
  while (chain.size() <= recording.transforms.size()) {
    const auto up = recording.transforms.find(chain.back().frame);
    if (up == recording.transforms.end()) break;
    chain.push_back({up->second.parent, up->second.T_parent_child * chain.back().T_ancestor_frame});
  }
  return chain;
}

}  // namespace

bool isNavdataTheOdometry(const DoctorRecording& recording) {
  return recording.odometry_topic.empty() && !recording.navdata_topic.empty();
}

const std::string& odometryTopic(const DoctorRecording& recording) {
  return recording.odometry_topic.empty() ? recording.navdata_topic : recording.odometry_topic;
}

std::optional<Eigen::Isometry3d> lookUp(const DoctorRecording& recording, const std::string& from,
                                        const std::string& to) {
  const std::vector<Ancestor> above_from = ancestorsOf(recording, from);
  for (const Ancestor& common : ancestorsOf(recording, to)) {
    for (const Ancestor& ancestor : above_from) {
      if (ancestor.frame == common.frame) {
        return ancestor.T_ancestor_frame.inverse() * common.T_ancestor_frame;
      }
    }
  }
  return std::nullopt;
}

bool isInTree(const DoctorRecording& recording, const std::string& frame) {
  if (recording.transforms.count(frame) > 0) return true;
  return std::any_of(recording.transforms.begin(), recording.transforms.end(),
                     [&frame](const auto& edge) { return edge.second.parent == frame; });
}

}  // namespace ardrone_vslam
