// SPDX-License-Identifier: BSD-3-Clause
#include "loop/flight_map.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <utility>

namespace ardrone_vslam {
namespace {

/// In the child: nobody catches what it would throw.
int writeInChild(const std::string& path, const Slam& slam) {
  constexpr int kLast = 19;  // after everything else
  ::setpriority(PRIO_PROCESS, 0, kLast);
  try {
    writeMap(path, slam.save());
    return 0;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr,
                 "vslam_onboard: %s: there is no memory to save the map in flight; set "
                 "onboard/working_mb higher\n",
                 path.c_str());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "vslam_onboard: %s\n", e.what());
  }
  return 1;
}

}  // namespace

FlightMap::FlightMap(Files files) : files_(std::move(files)) {
  if (files_.saved.empty() || files_.is_fixed) return;
  // At the end it would be too late to hear of it.
  const std::string part = files_.saved + ".part";
  std::FILE* file = std::fopen(part.c_str(), "w");
  if (file == nullptr)
    throw MapFileError(files_.saved + ": the map cannot be written: " + std::strerror(errno) +
                       "; name another mapper/save_map");
  std::fclose(file);
  std::remove(part.c_str());
}

FlightMap::FlightMap(FlightMap&& other) noexcept
    : files_(std::move(other.files_)),
      next_save_ns_(other.next_save_ns_),
      child_(std::exchange(other.child_, 0)),
      has_map_(other.has_map_),
      is_given_up_(other.is_given_up_) {}

FlightMap::~FlightMap() {
  waitForChild(0);
}

std::optional<SavedMap> FlightMap::read(const MapCamera& camera, std::size_t most_landmarks) {
  const std::string& path = files_.loaded;
  if (path.empty()) return std::nullopt;
  SavedMap map = readMap(path);
  const std::string other = cameraDifference(map.camera, camera);
  if (!other.empty()) throw MapFileError(path + ": " + other);
  if (map.landmarks.size() > most_landmarks)
    throw MapFileError(path + ": the map has " + std::to_string(map.landmarks.size()) +
                       " landmarks, and there is memory for " + std::to_string(most_landmarks) +
                       " (max_landmarks, max_map_mb); make it smaller by map_tool prune --most " +
                       std::to_string(most_landmarks));
  has_map_ = true;
  return map;
}

void FlightMap::giveUp() {
  files_.loaded.clear();
  is_given_up_ = has_map_;
}

void FlightMap::saveInFlight(const Slam& slam, std::int64_t now_ns) {
  if (files_.saved.empty() || files_.is_fixed || is_given_up_) return;
  waitForChild(WNOHANG);
  const auto period_ns = static_cast<std::int64_t>(files_.save_every_s * 1e9);
  if (next_save_ns_ == 0) next_save_ns_ = now_ns + period_ns;
  if (child_ != 0 || now_ns < next_save_ns_) return;
  if (!slam.hasWholeMap() || slam.landmarks().empty()) return;
  next_save_ns_ = now_ns + period_ns;
  child_ = ::fork();
  if (child_ == 0) ::_exit(writeInChild(files_.saved, slam));
  has_map_ = child_ > 0;
  if (has_map_) return;
  child_ = 0;
  std::fprintf(stderr, "vslam_onboard: %s: the map is not saved in flight: %s\n",
               files_.saved.c_str(), std::strerror(errno));
}

std::string FlightMap::saveAtEnd(const Slam& slam) {
  waitForChild(0);
  if (!slam.hasWholeMap())
    throw MapFileError(files_.loaded + ": the flight was not found in this map; none is saved");
  const std::string& path = files_.saved;
  if (path.empty()) return "";
  if (files_.is_fixed) return path + ": nothing is saved with localise_only";
  if (is_given_up_)
    return path + " stays as it was when memory ran out and the flight's map began anew";
  if (slam.landmarks().empty()) return path + " stays as it was: the flight has no landmark";
  return std::to_string(writeMap(path, slam.save())) + " landmarks written to " + path;
}

void FlightMap::waitForChild(int options) {
  if (child_ == 0) return;
  const pid_t ended = ::waitpid(child_, nullptr, options);
  if (ended == child_ || (ended < 0 && errno == ECHILD)) child_ = 0;
}

}  // namespace ardrone_vslam
