// SPDX-License-Identifier: BSD-3-Clause
#include "loop/flight_map.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <utility>

#include "files/set_aside.hpp"

namespace ardrone_vslam {
namespace {

constexpr char kMadeBy[] = "vslam_onboard " ARDRONE_VSLAM_VERSION;
constexpr int kNothingToSave = 2;  // exit code of the child
constexpr std::size_t kMostOfFlight_bytes = 4'000'000;

void say(const std::string& path, const std::string& sentence) {
  std::fprintf(stderr, "vslam_onboard: %s: %s\n", path.c_str(), sentence.c_str());
}

/// The flight's map with what it can be refined with. Nothing more can be recorded then.
SavedMap mapOf(const Slam& slam, std::optional<FlightRecorder>& recorder) {
  SavedMap map = slam.save().map();
  if (recorder) map.flight = recorder->take();
  return map;
}

/// @param is_first  of this flight: what an earlier one left goes on as NAME.before
std::size_t write(const std::string& path, const SavedMap& map, bool is_first) {
  const std::string fault = is_first ? setAside(path) : "";
  if (!fault.empty()) throw MapFileError(fault);
  return writeMap(path, map, kMadeBy);
}

/// In the child, which has memory of its own. @return its exit code
int writeInChild(const std::string& path, const Slam& slam, std::optional<FlightRecorder>& recorder,
                 bool is_first) {
  constexpr int kLast = 19;  // after everything else
  constexpr int kMostDescriptors = 256;
  ::setpriority(PRIO_PROCESS, 0, kLast);
  // Camera and ports are the parent's: it may be killed and started again before this has ended.
  for (int descriptor = 3; descriptor < kMostDescriptors; ++descriptor) ::close(descriptor);
  try {
    const SavedMap map = mapOf(slam, recorder);
    if (map.landmarks.empty()) return kNothingToSave;
    write(path, map, is_first);
    return 0;
  } catch (const MapFileError& e) {
    std::fprintf(stderr, "vslam_onboard: in flight: %s\n", e.what());
  } catch (const std::exception&) {
    say(path, "there is no memory to save the map in flight; set working_mb higher");
  }
  return 1;
}

}  // namespace

FlightMap::FlightMap(Files files) : files_(std::move(files)) {
  // At the end it would be too late to hear of it.
  if (!files_.saved.empty() && !files_.is_fixed) checkWritable(files_.saved);
}

FlightMap::~FlightMap() {
  waitForChild(0);
}

std::optional<SavedMap> FlightMap::read(const MapCamera& camera, std::size_t most_landmarks) {
  const std::string& path = files_.loaded;
  if (path.empty()) return std::nullopt;
  SavedMap map = readMap(path);
  const std::string other = cameraDifference(map.cameras, camera);
  if (!other.empty()) throw MapFileError(path + ": " + other);
  if (map.landmarks.size() > most_landmarks)
    throw MapFileError(path + ": the map has " + std::to_string(map.landmarks.size()) +
                       " landmarks, and there is memory for " + std::to_string(most_landmarks) +
                       " (max_landmarks, max_map_mb); make it smaller by map_tool prune --most " +
                       std::to_string(most_landmarks));
  return map;
}

bool FlightMap::isToBeSaved() const {
  return !files_.saved.empty() && !files_.is_fixed && !is_given_up_;
}

void FlightMap::begin(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam) {
  recorder_.reset();
  if (isToBeSaved()) recorder_.emplace(config, T_base_cam, kMostOfFlight_bytes);
}

void FlightMap::see(const ImageFeatures& features, const OdometryState& odometry,
                    const FrameResult& result, const Landmarks& landmarks) {
  if (!recorder_) return;
  try {
    recorder_->see(features, odometry, result, landmarks);
  } catch (const std::bad_alloc&) {
    recorder_.reset();  // the map needs the memory more
    say(files_.saved,
        "there is no memory to keep views: map_tool refine will have none of this map; "
        "set working_mb higher");
  }
}

void FlightMap::giveUp() {
  waitForChild(0);
  recorder_.reset();
  is_given_up_ = is_given_up_ || is_saved_ || !files_.loaded.empty();
  files_.loaded.clear();
}

void FlightMap::beginAnew() {
  if (files_.loaded.empty()) giveUp();
}

void FlightMap::saveInFlight(const Slam& slam, std::int64_t now_ns) {
  waitForChild(WNOHANG);
  if (!isToBeSaved() || files_.autosave_s == 0) return;
  const auto period_ns = static_cast<std::int64_t>(files_.autosave_s * 1e9);
  if (next_save_ns_ == 0) next_save_ns_ = now_ns + period_ns;
  if (child_ != 0 || now_ns < next_save_ns_ || !slam.hasWholeMap()) return;
  if (slam.landmarks().empty() && !slam.isSearching()) return;
  next_save_ns_ = now_ns + period_ns;
  child_ = ::fork();
  if (child_ == 0) ::_exit(writeInChild(files_.saved, slam, recorder_, !is_saved_));
  if (child_ > 0) return;
  child_ = 0;
  say(files_.saved, std::string("the map is not saved in flight: ") + std::strerror(errno));
}

std::string FlightMap::saveAtEnd(const Slam& slam) {
  if (child_ != 0) {  // what it writes is older
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
    child_ = 0;
  }
  if (!slam.hasWholeMap())
    throw MapFileError(files_.loaded + ": the flight was not found in this map; none is saved" +
                       (is_saved_ ? " but what was in flight" : ""));
  const std::string& path = files_.saved;
  if (path.empty()) return "";
  if (files_.is_fixed) return path + ": nothing is saved with localise_only";
  if (is_given_up_) return path + " stays as it was when the flight's map began anew";
  const SavedMap map = mapOf(slam, recorder_);
  if (map.landmarks.empty()) return path + " stays as it was: the flight has no landmark";
  return std::to_string(write(path, map, !is_saved_)) + " landmarks written to " + path;
}

void FlightMap::waitForChild(int options) {
  if (child_ == 0) return;
  int status = 0;
  pid_t ended = 0;
  do ended = ::waitpid(child_, &status, options);
  while (ended < 0 && errno == EINTR);
  if (ended == 0) return;
  child_ = 0;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) is_saved_ = true;
  if (WIFSIGNALED(status))
    say(files_.saved, "the map is not saved in flight: its writer ended by signal " +
                          std::to_string(WTERMSIG(status)));
}

}  // namespace ardrone_vslam
