// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/MapFile.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/saved_map.hpp"
#include "map_files/kept_map.hpp"

namespace ardrone_vslam {

/// What is asked of the map: the topic /initialpose and the services save_map, load_map and reset,
/// whose files are in ~/.ros/maps (maps in ROS_HOME). They are read and written in a thread of its
/// own, so that no pose waits for a disk; what concerns the map in use is done by serve(), in the
/// mapper's thread.
class MapServices {
 public:
  using InitialPose = geometry_msgs::PoseWithCovarianceStamped;
  /// Called in the mapper's thread.
  struct Calls {
    std::function<MapSnapshot()> save;  ///< @throws MapFileError when there is nothing to save
    std::function<bool()> is_fixed;     ///< nothing new in the map: no file is kept
    std::function<void(std::shared_ptr<const SavedMap>)> use;  ///< nothing: an empty map
    std::function<void(const InitialPose&)> look_near;  ///< @throws std::exception with the reason
  };

  /// @param kept  file that gets the map in flight and at the end, as open()'s; empty: none
  MapServices(const ros::NodeHandle& private_nh, Calls calls, const std::string& kept);
  ~MapServices();
  MapServices(const MapServices&) = delete;
  MapServices& operator=(const MapServices&) = delete;

  /// Does what services wait for. In the mapper's thread, often.
  void serve();
  /// The file that gets the map.
  KeptMap& kept() { return kept_; }

  /// @param file  a path; relative ones begin in the folder of maps. @throws MapFileError
  static std::shared_ptr<const SavedMap> open(const std::string& file);

 private:
  struct Taken {
    std::optional<MapSnapshot> map;
    int number = 0;  ///< KeptMap::number() then
  };

  bool onSave(MapFile::Request& request, MapFile::Response& response);
  bool onLoad(MapFile::Request& request, MapFile::Response& response);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void onInitialPose(const InitialPose& pose);
  void onTimer();
  /// @return no map when it is fixed, which counts for the file that is kept
  Taken mapOfMapper(bool also_fixed);
  void inMapperThread(const std::function<void()>& work);

  Calls calls_;
  std::mutex mutex_;
  std::vector<std::packaged_task<void()>> tasks_;  // for serve()
  bool has_ended_ = false;
  ros::CallbackQueue queue_;
  ros::NodeHandle nh_;
  std::vector<ros::ServiceServer> servers_;
  ros::Subscriber initial_pose_;
  KeptMap kept_;
  ros::WallTimer timer_;
  ros::AsyncSpinner spinner_;
};

}  // namespace ardrone_vslam
