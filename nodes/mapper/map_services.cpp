// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/map_services.hpp"

#include <ros/console.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <utility>

namespace ardrone_vslam {
namespace {

constexpr char kMadeBy[] = "mapper " ARDRONE_VSLAM_VERSION;
constexpr std::chrono::seconds kPatience(10);  // for the mapper's thread
constexpr double kKeepTick_s = 0.2;            // how late a file may be kept
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

MapServices::MapServices(const ros::NodeHandle& private_nh, Calls calls, const std::string& kept)
    : calls_(std::move(calls)),
      nh_(private_nh),
      kept_(kept.empty() ? "" : (folderOfMaps() / kept).string(), kMadeBy),
      spinner_(1, &queue_) {
  nh_.setCallbackQueue(&queue_);
  servers_ = {nh_.advertiseService("save_map", &MapServices::onSave, this),
              nh_.advertiseService("load_map", &MapServices::onLoad, this),
              nh_.advertiseService("reset", &MapServices::onReset, this)};
  initial_pose_ = nh_.subscribe("/initialpose", 1, &MapServices::onInitialPose, this);
  if (!kept_.path().empty())
    timer_ = nh_.createWallTimer(ros::WallDuration(kKeepTick_s),
                                 [this](const ros::WallTimerEvent&) { onTimer(); });
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
  if (kept_.path().empty() || calls_.is_fixed()) return;
  try {
    kept_.keep(calls_.save(), kept_.number());
  } catch (const std::exception& e) {
    ROS_WARN_STREAM("save_map: " << kept_.path() << " gets no map at the end: " << e.what());
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
    const bool has_begun = tasks_.empty();  // then it will end, too
    tasks_.clear();
    if (!has_begun) throw MapFileError("the mapper was too busy to answer within 10 s; try again");
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

MapServices::Taken MapServices::mapOfMapper(bool also_fixed) {
  Taken taken;
  inMapperThread([&] {
    taken.number = kept_.number();
    if (also_fixed || !calls_.is_fixed()) taken.map = calls_.save();
  });
  return taken;
}

void MapServices::onTimer() {
  if (!kept_.isDue()) return;
  Taken taken;
  try {
    taken = mapOfMapper(false);
  } catch (const std::exception& e) {
    ROS_INFO_STREAM_THROTTLE(kSayEvery_s, "save_map: " << e.what());
    return;
  }
  try {
    if (taken.map) kept_.keep(std::move(*taken.map), taken.number);
  } catch (const std::exception& e) {
    ROS_WARN_STREAM_THROTTLE(kSayEvery_s, "save_map: " << e.what());
  }
}

bool MapServices::onSave(MapFile::Request& request, MapFile::Response& response) {
  try {
    const std::string path = pathOf(request.name);
    const std::size_t landmarks = writeMap(path, std::move(*mapOfMapper(true).map).map(), kMadeBy);
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
