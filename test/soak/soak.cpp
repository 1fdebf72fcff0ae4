// SPDX-License-Identifier: BSD-3-Clause
// soak: hours of flight as fast as the computer can, to see what grows and what drifts away.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

#include "ardrone_vslam/odometry_adapter.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/setup_monitor.hpp"
#include "ardrone_vslam/slam.hpp"
#include "ardrone_vslam/tracker.hpp"
#include "config_files/config_file.hpp"
#include "config_files/config_path.hpp"
#include "program/profile_option.hpp"
#include "program/progress_line.hpp"
#include "program/tool_main.hpp"
#include "simulation/odometry_drift.hpp"
#include "soak/soak_report.hpp"
#include "soak/there_and_back.hpp"
#include "thread_time.hpp"
#include "trajectory/text_file.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr double kNsPerS = 1e9;

struct Options {
  double hours = 24;
  double way_s = ThereAndBack::kLap_s;
  double report_minutes = 0;  // 0: as the hours suggest
  double wall_limit_s = 0;    // 0: none
  double first_stamp_s = 1;
  std::uint32_t first_track_id = 1;
  std::uint64_t seed = 1;
  std::string profile = "drone";
  std::string config;
  std::vector<std::string> overrides;
  std::string json;

  double reportMinutes() const {
    if (report_minutes > 0) return report_minutes;
    if (hours >= 12) return 60;
    return hours >= 1 ? 5 : hours * 60 / 8;
  }
};

/// Tracker and mapper with their odometry, as in the nodelets and in replay, whose inputs run on
/// for ever.
class Pipeline {
 public:
  Pipeline(const PipelineConfig& config, const Options& options, ThereAndBack& flight)
      : flight_(flight),
        first_stamp_ns_(std::llround(options.first_stamp_s * kNsPerS)),
        drift_(profileOfOption(options.profile), options.seed),
        tracker_(config.tracker, flight.camera(), options.first_track_id),
        adapter_(config.mapper.odometry_adapter),
        odometries_(config.mapper.odometry),
        setup_(config.mapper.image_time_offset_s),
        slam_(config.mapper, flight.T_base_cam()) {
    setup_.useCamera(flight.T_base_cam());
  }

  std::int64_t stamp_ns(std::uint64_t index, int rate_hz) const {
    // Whole seconds first: a double has no nanoseconds left after some weeks.
    const auto rate = static_cast<std::uint64_t>(rate_hz);
    return first_stamp_ns_ + static_cast<std::int64_t>(index / rate * 1'000'000'000 +
                                                       index % rate * 1'000'000'000 / rate);
  }

  std::uint32_t nextTrackId() const { return tracker_.nextTrackId(); }

  /// @throws std::runtime_error without odometry at the image
  const FrameResult& process(const ImageView& image, std::uint64_t index) {
    const std::int64_t image_ns = stamp_ns(index, ThereAndBack::kImages_hz);
    tracker_.process(image, image_ns, features_);
    const std::int64_t exposed_ns = setup_.clock().exposed_ns(image_ns);
    OdometryState state;
    if (odometries_.at(exposed_ns, state) != OdometryBuffer::Lookup::kFound)
      throw std::runtime_error("there is no odometry at image " + std::to_string(index));
    setup_.see(features_, odometries_, slam_);
    state.stamp_ns = image_ns;
    return slam_.process(features_, state);
  }

  /// What has come before the image is processed: some more than its own, for offsets.
  void takeOdometryTo(std::uint64_t image) {
    constexpr std::int64_t kMore_ns = 50'000'000;
    const std::int64_t until_ns = stamp_ns(image, ThereAndBack::kImages_hz) + kMore_ns;
    for (; odometries_.empty() || odometries_.newestStamp_ns() < until_ns; ++next_pose_) {
      OdometryState state;
      state.stamp_ns = stamp_ns(next_pose_, ThereAndBack::kPoses_hz);
      const double since_first_s = static_cast<double>(state.stamp_ns - first_stamp_ns_) / kNsPerS;
      state.T_odom_base = drift_.report(flight_.T_map_base(next_pose_), since_first_s);
      ready_.clear();
      adapter_.push(state, ready_);
      for (const OdometryState& one : ready_) odometries_.push(one);
    }
  }

 private:
  ThereAndBack& flight_;
  std::int64_t first_stamp_ns_;
  OdometryDrift drift_;
  std::uint64_t next_pose_ = 0;
  Tracker tracker_;
  OdometryAdapter adapter_;
  std::vector<OdometryState> ready_;
  OdometryBuffer odometries_;
  SetupMonitor setup_;
  Slam slam_;
  ImageFeatures features_;
};

double wallTime_ns() {
  return static_cast<double>(std::chrono::steady_clock::now().time_since_epoch().count());
}

std::vector<SoakRow> fly(const Options& o, ThereAndBack& flight, Pipeline& pipeline) {
  constexpr double kImages_h = 3600.0 * ThereAndBack::kImages_hz;
  const auto images = static_cast<std::uint64_t>(std::llround(o.hours * kImages_h));
  const auto in_row = static_cast<std::uint64_t>(std::llround(o.reportMinutes() / 60 * kImages_h));
  SoakInterval interval(in_row);
  std::vector<SoakRow> rows;
  rows.reserve(images / in_row + 1);
  ProgressLine progress("soak", images);
  std::cout << headerLine() << std::endl;
  const double began_ns = wallTime_ns();
  for (std::uint64_t i = 0; i < images; ++i) {
    const ImageView image = flight.image(i);
    pipeline.takeOdometryTo(i);
    const double wall_ns = wallTime_ns();
    const double cpu_ns = bench::threadTime_ns();
    const FrameResult& result = pipeline.process(image, i);
    const double cpu_ms = (bench::threadTime_ns() - cpu_ns) * 1e-6;
    interval.add(result, flight.poseAtImage(i), cpu_ms, (wallTime_ns() - wall_ns) * 1e-6);
    progress.update(i + 1);
    if (interval.images() < in_row) continue;
    rows.push_back(interval.finish(static_cast<double>(i + 1) / kImages_h));
    std::cout << lineOf(rows.back()) << std::endl;  // at once: it is read while this runs
    if (o.wall_limit_s > 0 && (wallTime_ns() - began_ns) / kNsPerS > o.wall_limit_s) break;
  }
  return rows;
}

int run(const Options& o) {
  PipelineConfig config =
      loadConfig(o.config.empty() ? findConfigFile("ardrone_onboard.yaml") : o.config, o.overrides);
  ThereAndBack flight(o.way_s, o.seed);
  Pipeline pipeline(config, o, flight);
  const std::vector<SoakRow> rows = fly(o, flight, pipeline);
  const std::vector<std::string> faults = faultsOf(rows, {});
  if (!o.json.empty()) writeText(o.json, jsonOf(rows, faults));
  for (const std::string& fault : faults) std::cerr << "soak: " << fault << '\n';
  std::cout << "track ids " << o.first_track_id << " to " << pipeline.nextTrackId() - 1 << '\n';
  if (faults.empty())
    std::cout << "flat over " << rows.back().flown_h << " h: memory, handles, threads, error and "
              << "NEES\n";
  return faults.empty() ? 0 : 1;
}

void addOptions(CLI::App& app, Options& o) {
  app.add_option("--hours", o.hours, "of flight at 30 Hz")
      ->capture_default_str()
      ->check(numberWithin(0.001, 1e6));
  app.add_option(
         "--way-seconds", o.way_s,
         "of images, flown there and back: one lap from rest to rest; other than 21.5: laps "
         "that turn round at once. 2.3 MB each")
      ->capture_default_str()
      ->check(numberWithin(1, 3600));
  app.add_option("--report-minutes", o.report_minutes,
                 "of flight from report to report; default: 60, 5 below 12 hours, an eighth of the "
                 "flight below one hour")
      ->check(numberWithin(0.01, 1e4));
  app.add_option("--seconds", o.wall_limit_s,
                 "ends at the first report after so long on the clock, and judges what there is; "
                 "0: never")
      ->capture_default_str()
      ->check(numberWithin(0, 1e7));
  app.add_option("--config", o.config, "configuration; default: ardrone_onboard.yaml");
  app.add_option("--set", o.overrides, "key=value over the configuration; may be repeated");
  app.add_option("--odometry-profile", o.profile, "how the odometry drifts")->capture_default_str();
  addSeed(app, "--seed", o.seed, "of the noise of odometry and images");
  app.add_option("--first-stamp", o.first_stamp_s, "stamp of the first image [s]")
      ->capture_default_str()
      ->check(numberWithin(1, 9.2e9));
  app.add_option("--first-track-id", o.first_track_id, "id of the first track")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--json", o.json, "file that gets the reports");
}

}  // namespace
}  // namespace ardrone_vslam::test

int main(int argc, char** argv) {
  using namespace ardrone_vslam;
  CLI::App app{
      "Flies rendered laps there and back for hours, through tracker and mapper, as fast as it "
      "goes. Exit code 1 when memory, handles, threads, the error or NEES grow.",
      "soak"};
  test::Options options;
  test::addOptions(app, options);
  return runTool(app, argc, argv, [&options] { return test::run(options); });
}
