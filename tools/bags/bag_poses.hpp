// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <string>
#include <vector>

#include "ardrone_vslam/drone_observer.hpp"
#include "ardrone_vslam/height_input.hpp"
#include "bags/bag_findings.hpp"
#include "bags/bag_topics.hpp"
#include "simulation/odometry_model.hpp"

namespace ardrone_vslam {

struct BagOdometry {
  std::vector<OdometryState> states;  ///< stamps may repeat, they do not go back
  std::string base_frame;             ///< child_frame_id without a leading slash
  OdometryFaultCounts faults{};       ///< of the package's own observer
};

/// States that are not finite or whose stamps are out of order (keepAscent) are dropped; `findings`
/// says how many. Also warns when nothing moves.
BagOdometry readOdometry(const rosbag::Bag& bag, const std::string& topic, BagFindings& findings);

/// What the package's own observer makes of the AR.Drone's navdata and, where they are, IMU and
/// commands, as the mapper nodelet does. `findings` says how many messages it refused.
BagOdometry readNavdata(const rosbag::Bag& bag, const ChosenTopics& topics, BagFindings& findings);

/// Puts an IMU's attitude into the odometry, as the mapper nodelet does (ImuOdometry). `findings`
/// says how many messages of either were of no use.
/// @throws std::runtime_error when tf does not say how the IMU is mounted
void useImu(const rosbag::Bag& bag, const std::string& topic, BagOdometry& odometry,
            BagFindings& findings);

/// All whose stamps are in order, the ones without an echo, too.
std::vector<RangeReading> readRanges(const rosbag::Bag& bag, const std::string& topic,
                                     BagFindings& findings);
/// The same of the drone's own height. A message without a stamp is left out.
std::vector<RangeReading> readNavdataHeights(const rosbag::Bag& bag, const std::string& topic);

/// PoseStamped, PoseWithCovarianceStamped or Odometry. Poses that are not finite or whose stamps
/// are out of order are dropped; `findings` says how many.
Trajectory readTruth(const rosbag::Bag& bag, const std::string& topic, BagFindings& findings);

/// base -> sensor from tf_static and tf, wherever in the tree the two are. An empty base frame is
/// taken as the sensor's parent. @param sensor  camera or IMU, for messages
/// @throws std::runtime_error naming the frames and the remedy
Eigen::Isometry3d readExtrinsics(const rosbag::Bag& bag, const std::string& base_frame,
                                 const std::string& sensor_frame, const std::string& sensor);

/// A frame's name without the leading slash of old tf.
std::string withoutSlash(const std::string& frame);

}  // namespace ardrone_vslam
