// SPDX-License-Identifier: BSD-3-Clause
#include "report/run_files.hpp"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "summary/refined_summary.hpp"
#include "trajectory/text_file.hpp"

namespace ardrone_vslam {
namespace {

void writeCell(std::ostream& out, double value) {
  out << ',';
  if (std::isfinite(value)) out << value;
}

double valueAt(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : kNotKnown;
}

/// What the filter said, from sigma_m to camera_sigma_m.
void writeEstimates(std::ostream& out, const FrameResult& r) {
  writeCell(out, r.sigma_m);
  for (const double known : {r.fix_nis, r.track_nis, r.velocity_bias_sigma_m_s, r.yaw_walk_factor})
    writeCell(out, known > 0 ? known : kNotKnown);
  for (int axis = 0; axis < 3; ++axis)
    writeCell(out, r.landmark_position_map ? (*r.landmark_position_map)[axis] : kNotKnown);
  writeCell(out, r.landmark_position_map ? r.landmark_sigma_m : kNotKnown);
}

void writeFrames(std::ostream& out, const RunResult& run, const RunEvaluation& e) {
  out << "index,stamp_ns,state,match_method,features,tracks,tracks_aligned,landmarks_in_view,"
         "landmark_candidates,"
         "landmark_matches,"
         "landmark_mismatches,"
         "feature_candidates,feature_matches,feature_mismatches,new_landmarks,removed_landmarks,"
         "landmarks,map_features,"
         "sigma_m,fix_nis,track_nis,velocity_bias_sigma_m_s,yaw_walk_factor,camera_x_m,camera_y_m,"
         "camera_z_m,"
         "camera_sigma_m,fused_error_m,"
         "odometry_"
         "error_m,camera_error_m,nees";
  for (const char* name : kStageNames) out << ",ms_" << name;
  out << ",ms_total\n" << std::setprecision(9);
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const FrameResult& r = run.frames[i].result;
    out << i << ',' << r.stamp_ns << ',' << kSlamStateNames[static_cast<std::size_t>(r.state)]
        << ',' << nameOf(r.match_method);
    for (const int count :
         {r.features, r.tracks, r.tracks_aligned, r.landmarks_in_view, r.landmark_candidates,
          r.landmark_matches, r.landmark_candidates - r.landmark_matches, r.feature_candidates,
          r.feature_matches, r.feature_candidates - r.feature_matches, r.new_landmarks,
          r.removed_landmarks, r.landmarks, r.map_features}) {
      out << ',' << count;
    }
    writeEstimates(out, r);
    for (const auto* errors : {&e.fused_error_m, &e.odometry_error_m, &e.camera_error_m, &e.nees})
      writeCell(out, valueAt(*errors, i));
    for (const double ms : run.frames[i].times_ms) writeCell(out, ms);
    writeCell(out, total_ms(run.frames[i].times_ms));
    out << '\n';
  }
}

void writeLandmarks(std::ostream& out, const RunResult& run) {
  out << "id,x_m,y_m,z_m,sigma_m,depth_sigma_m,times_seen\n" << std::setprecision(9);
  for (const Landmark& l : run.landmarks) {
    if (isNotFinite(l)) continue;
    out << l.id << ',' << l.position_map.x() << ',' << l.position_map.y() << ','
        << l.position_map.z() << ',' << l.sigma_m << ',' << l.depth_sigma_m << ',' << l.times_seen
        << '\n';
  }
}

}  // namespace

void makeRunFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK) != 0) {
    throw std::runtime_error(folder + ": cannot be written; choose another --out");
  }
}

std::string seedFolder(const std::string& folder, std::uint64_t seed) {
  return folder + "/seed_" + std::to_string(seed);
}

void writeRun(const std::string& folder, const RunResult& run, const RunEvaluation& evaluation,
              const nlohmann::ordered_json& summary) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error(folder + ": cannot be made (" + error.message() +
                             "); choose another --out");
  writeTum(folder + "/odometry.tum", evaluation.odometry);
  writeTum(folder + "/fused.tum", evaluation.fused);
  if (run.refined) writeTum(folder + "/refined.tum", refinedTrajectory(run));
  if (!evaluation.truth.empty()) writeTum(folder + "/truth.tum", evaluation.truth);
  std::ostringstream frames;
  writeFrames(frames, run, evaluation);
  writeText(folder + "/frames.csv", frames.str());
  std::ostringstream landmarks;
  writeLandmarks(landmarks, run);
  writeText(folder + "/landmarks.csv", landmarks.str());
  writeText(folder + "/summary.json", summary.dump(2) + "\n");
}

}  // namespace ardrone_vslam
