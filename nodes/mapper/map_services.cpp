// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/map_services.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <utility>

namespace ardrone_vslam {
namespace {

constexpr std::chrono::seconds kPatience(10);  // for the mapper's thread

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

MapServices::MapServices(const ros::NodeHandle& private_nh, Calls calls)
    : calls_(std::move(calls)), nh_(private_nh), spinner_(1, &queue_) {
  nh_.setCallbackQueue(&queue_);
  servers_ = {nh_.advertiseService("save_map", &MapServices::onSave, this),
              nh_.advertiseService("load_map", &MapServices::onLoad, this),
              nh_.advertiseService("reset", &MapServices::onReset, this)};
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
  const std::filesystem::path path(file);
  return std::make_shared<const SavedMap>(
      readMap((path.is_absolute() ? path : folderOfMaps() / path).string()));
}

bool MapServices::onSave(MapFile::Request& request, MapFile::Response& response) {
  try {
    const std::string path = pathOf(request.name);
    // The task may outlive this call, when it has given up.
    const auto map = std::make_shared<SavedMap>();
    inMapperThread([this, map] { *map = calls_.save(); });
    const std::size_t landmarks = writeMap(path, *map);
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
