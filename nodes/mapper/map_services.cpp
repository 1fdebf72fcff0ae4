// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/map_services.hpp"

#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <utility>

namespace ardrone_vslam {
namespace {

constexpr char kMadeBy[] = "mapper " ARDRONE_VSLAM_VERSION;
constexpr std::chrono::seconds kPatience(10);  // for the mapper's thread
constexpr double kFirstKept_s = 10;
constexpr double kSayEvery_s = 60;

std::filesystem::path folderOfMaps() {
  const char* ros_home = std::getenv("ROS_HOME");
  if (ros_home != nullptr) return std::filesystem::path(ros_home) / "maps";
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr ? home : "/tmp") / ".ros" / "maps";
}

/// Nobody who can call a service gets at other folders.
std::string pathOf(const std::string& name) {
  const std::filesystem::path folder = folderOfMaps();
  const std::filesystem::path file(name);
  if (name.empty() || file.filename() != file || name == "." || name == "..")
    throw MapFileError("'" + name + "' is no name of a file in " + folder.string() +
                       ", such as house.vmap; other folders are out of reach");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  return (folder / file).string();
}

}  // namespace

MapServices::MapServices(const ros::NodeHandle& private_nh, Calls calls, const Kept& kept)
    : calls_(std::move(calls)),
      nh_(private_nh),
      kept_(kept.file.empty() ? "" : (folderOfMaps() / kept.file).string()),
      spinner_(1, &queue_) {
  nh_.setCallbackQueue(&queue_);
  servers_ = {nh_.advertiseService("save_map", &MapServices::onSave, this),
              nh_.advertiseService("load_map", &MapServices::onLoad, this),
              nh_.advertiseService("reset", &MapServices::onReset, this)};
  initial_pose_ = nh_.subscribe("/initialpose", 1, &MapServices::onInitialPose, this);
  const double every_s = kept.every_s;
  if (!kept_.empty() && every_s > 0)
    timer_ = nh_.createWallTimer(ros::WallDuration(std::min(kFirstKept_s, every_s)),
                                 [this, every_s](const ros::WallTimerEvent&) { onTimer(every_s); });
  spinner_.start();
}

MapServices::~MapServices() {
  {
    // Whoever waits for the mapper's thread, which is this one, waits in vain.
    const std::lock_guard<std::mutex> lock(mutex_);
    has_ended_ = true;
    tasks_.clear();
  }
  spinner_.stop();
  if (kept_.empty()) return;
  try {
    keep(calls_.save());
  } catch (const std::exception& e) {
    ROS_WARN_STREAM("save_map: " << kept_ << " gets no map at the end: " << e.what());
  }
}

void MapServices::serve() {
  std::vector<std::packaged_task<void()>> tasks;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    tasks.swap(tasks_);
  }
  for (auto& task : tasks) task();
}

void MapServices::inMapperThread(const std::function<void()>& work) {
  std::packaged_task<void()> task(work);
  std::future<void> done = task.get_future();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (has_ended_) throw MapFileError("the mapper has ended");
    tasks_.push_back(std::move(task));
  }
  if (done.wait_for(kPatience) == std::future_status::timeout) {
    const std::lock_guard<std::mutex> lock(mutex_);
    tasks_.clear();
    throw MapFileError("the mapper was too busy to answer within 10 s; try again");
  }
  try {
    done.get();
  } catch (const std::future_error&) {
    throw MapFileError("the mapper ended meanwhile");
  }
}

std::shared_ptr<const SavedMap> MapServices::open(const std::string& file) {
  return std::make_shared<const SavedMap>(readMap((folderOfMaps() / file).string()));
}

void MapServices::onInitialPose(const InitialPose& pose) {
  try {
    inMapperThread([this, pose] { calls_.look_near(pose); });
    ROS_INFO_STREAM("/initialpose: the flight is looked for near there");
  } catch (const std::exception& e) {
    ROS_WARN_STREAM("/initialpose: refused: " << e.what());
  }
}

MapSnapshot MapServices::mapOfMapper() {
  // The task may outlive this call, when it has given up.
  const auto map = std::make_shared<MapSnapshot>();
  inMapperThread([this, map] { *map = calls_.save(); });
  return std::move(*map);
}

void MapServices::onTimer(double every_s) {
  MapSnapshot map;
  try {
    map = mapOfMapper();
  } catch (const std::exception& e) {
    ROS_INFO_STREAM_THROTTLE(kSayEvery_s, "save_map: " << e.what());
    return;
  }
  try {
    keep(std::move(map));
    timer_.setPeriod(ros::WallDuration(every_s));
  } catch (const std::exception& e) {
    ROS_WARN_STREAM_THROTTLE(kSayEvery_s, "save_map: " << e.what());
  }
}

void MapServices::keep(MapSnapshot map) {
  const std::int64_t stamp_ns = map.all_but_landmarks.stamp_ns;
  if (stamp_ns == kept_ns_) return;
  const std::filesystem::path path(kept_);
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  // There may be an earlier flight's map, or this one's before it began anew.
  if (kept_ns_ == 0) {
    const std::filesystem::path before(kept_ + ".before");
    if (std::filesystem::exists(path, error)) std::filesystem::remove(before, error);
    std::filesystem::create_hard_link(path, before, error);
  }
  writeMap(kept_, std::move(map).map(), kMadeBy);
  kept_ns_ = stamp_ns;
}

bool MapServices::onSave(MapFile::Request& request, MapFile::Response& response) {
  try {
    const std::string path = pathOf(request.name);
    const std::size_t landmarks = writeMap(path, mapOfMapper().map(), kMadeBy);
    response.message = std::to_string(landmarks) + " landmarks written to " + path;
    response.success = 1;
  } catch (const std::exception& e) {
    response.message = e.what();
  }
  return true;
}

bool MapServices::onLoad(MapFile::Request& request, MapFile::Response& response) {
  try {
    const auto map = open(pathOf(request.name));
    inMapperThread([this, map] { calls_.use(map); });
    response.message = std::to_string(map->landmarks.size()) +
                       " landmarks loaded; the flight is looked for in them (searching_map)";
    response.success = 1;
  } catch (const std::exception& e) {
    response.message = e.what();
  }
  return true;
}

bool MapServices::onReset(std_srvs::Trigger::Request& /*request*/,
                          std_srvs::Trigger::Response& response) {
  try {
    inMapperThread([this] { calls_.use(nullptr); });
    response.message = "the map begins anew, empty";
    response.success = 1;
  } catch (const std::exception& e) {
    response.message = e.what();
  }
  return true;
}

}  // namespace ardrone_vslam
