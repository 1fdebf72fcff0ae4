// SPDX-License-Identifier: BSD-3-Clause
#include "soak/soak_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "trajectory/metrics.hpp"

namespace ardrone_vslam::test {
namespace {

template <class Value>
double meanOf(std::vector<SoakRow>::const_iterator begin, std::vector<SoakRow>::const_iterator end,
              const Value& value) {
  double sum = 0;
  for (auto row = begin; row != end; ++row) sum += value(*row);
  return sum / static_cast<double>(end - begin);
}

template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  text.precision(4);
  (text << ... << parts);
  return text.str();
}

nlohmann::json json(const FrameTimes& times) {
  return {{"median", times.median},
          {"99", times.of_99_percent},
          {"99.9", times.of_99_9_percent},
          {"largest", times.largest}};
}

}  // namespace

FrameTimes FrameTimes::of(std::vector<float>& values_ms) {
  const auto quantileOf = [&values_ms](double share) {
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values_ms.size())) - 1);
    const auto at = values_ms.begin() + std::max<std::ptrdiff_t>(rank, 0);
    std::nth_element(values_ms.begin(), at, values_ms.end());
    return static_cast<double>(*at);
  };
  if (values_ms.empty()) return {};
  return {quantileOf(0.5), quantileOf(0.99), quantileOf(0.999), quantileOf(1)};
}

SoakInterval::SoakInterval(std::uint64_t images) {
  cpu_ms_.reserve(images);
  wall_ms_.reserve(images);
}

void SoakInterval::add(const FrameResult& result, const Eigen::Isometry3d& T_map_base,
                       double cpu_ms, double wall_ms) {
  const Eigen::Vector3d error_m = result.T_map_base.translation() - T_map_base.translation();
  cpu_ms_.push_back(static_cast<float>(cpu_ms));
  wall_ms_.push_back(static_cast<float>(wall_ms));
  sums_.features += result.features;
  sums_.landmarks = result.landmarks;
  sums_.error_rms_m += error_m.squaredNorm();
  sums_.error_largest_m = std::max(sums_.error_largest_m, error_m.norm());
  sums_.nees_per_axis += nees(error_m, result.covariance.topLeftCorner<3, 3>()) / 3;
  sums_.shares[static_cast<std::size_t>(result.state)] += 1;
}

SoakRow SoakInterval::finish(double flown_h) {
  SoakRow row = sums_;
  row.flown_h = flown_h;
  row.images = images();
  row.process = ProcessState::now();
  const auto count = static_cast<double>(row.images);
  row.features /= count;
  row.error_rms_m = std::sqrt(row.error_rms_m / count);
  row.nees_per_axis /= count;
  for (double& share : row.shares) share /= count;
  row.cpu = FrameTimes::of(cpu_ms_);
  row.wall = FrameTimes::of(wall_ms_);
  cpu_ms_.clear();
  wall_ms_.clear();
  sums_ = {};
  return row;
}

std::vector<std::string> faultsOf(const std::vector<SoakRow>& rows, const SoakBounds& bounds) {
  if (rows.size() < SoakBounds::kLeast)
    return {sentence("only ", rows.size(), " reports, a verdict needs ", SoakBounds::kLeast,
                     ": fly longer or report more often")};
  std::vector<std::string> faults;
  const auto first = rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 4);
  const auto middle = first + (rows.end() - first) / 2;
  const SoakRow& last = rows.back();
  const double map_mb = bounds.per_landmark_mb * std::max(0, last.landmarks - first->landmarks);
  const auto checkGrowth = [&](const char* what, double before, double after, double bound) {
    if (after - before > bound)
      faults.push_back(sentence(what, " grew from ", before, " to ", after, ", more than by ",
                                bound, ", beside a map that grew from ", first->landmarks, " to ",
                                last.landmarks, " landmarks"));
  };
  const ProcessState& was = first->process;
  const ProcessState& is = last.process;
  checkGrowth("the heap in use [MB]", was.heap_mb, is.heap_mb, bounds.heap_mb + map_mb);
  checkGrowth("resident memory [MB]", was.resident_mb, is.resident_mb, bounds.resident_mb + map_mb);
  checkGrowth("the number of open handles", was.handles, is.handles, 0);
  checkGrowth("the number of threads", was.threads, is.threads, 0);
  const auto checkFlat = [&](const char* what, const auto& value, double more) {
    const double before = meanOf(first, middle, value);
    const double after = meanOf(middle, rows.end(), value);
    // Not the reverse: NaN is a fault.
    if (!(after <= bounds.error_ratio * before + more))
      faults.push_back(sentence(what, " went from ", before, " in the first half to ", after,
                                " in the second one"));
  };
  checkFlat(
      "the position's error [m]", [](const SoakRow& row) { return row.error_rms_m; },
      bounds.error_more_m);
  checkFlat(
      "NEES/3", [](const SoakRow& row) { return row.nees_per_axis; }, bounds.nees_more);
  for (const SoakRow& row : rows)
    if (row.shares[static_cast<std::size_t>(SlamState::kNotFinite)] > 0)
      faults.push_back(sentence("poses were not finite before hour ", row.flown_h));
  return faults;
}

std::string headerLine() {
  return "    hour resident[MB] heap[MB] handles threads landmarks features | cpu a frame [ms] "
         "median 99% 99.9% largest | wall [ms] 99.9% largest | error[m] largest | NEES/3 | states";
}

std::string lineOf(const SoakRow& row) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(),
                "%8.3f %12.1f %8.2f %7d %7d %9d %8.1f | %23.2f %5.2f %5.2f %7.2f | %14.2f %7.2f "
                "| %8.3f %7.3f | %6.2f |",
                row.flown_h, row.process.resident_mb, row.process.heap_mb, row.process.handles,
                row.process.threads, row.landmarks, row.features, row.cpu.median,
                row.cpu.of_99_percent, row.cpu.of_99_9_percent, row.cpu.largest,
                row.wall.of_99_9_percent, row.wall.largest, row.error_rms_m, row.error_largest_m,
                row.nees_per_axis);
  std::string line = text.data();
  for (std::size_t i = 0; i < row.shares.size(); ++i) {
    if (row.shares[i] == 0) continue;
    std::snprintf(text.data(), text.size(), " %s %.2f%%", kSlamStateNames[i], 100 * row.shares[i]);
    line += text.data();
  }
  return line;
}

std::string jsonOf(const std::vector<SoakRow>& rows, const std::vector<std::string>& faults) {
  nlohmann::json report;
  report["faults"] = faults;
  report["rows"] = nlohmann::json::array();
  for (const SoakRow& row : rows) {
    nlohmann::json shares;
    for (std::size_t i = 0; i < row.shares.size(); ++i) shares[kSlamStateNames[i]] = row.shares[i];
    report["rows"].push_back({{"hour", row.flown_h},
                              {"images", row.images},
                              {"resident_mb", row.process.resident_mb},
                              {"heap_mb", row.process.heap_mb},
                              {"handles", row.process.handles},
                              {"threads", row.process.threads},
                              {"landmarks", row.landmarks},
                              {"features", row.features},
                              {"cpu_ms", json(row.cpu)},
                              {"wall_ms", json(row.wall)},
                              {"error_rms_m", row.error_rms_m},
                              {"error_largest_m", row.error_largest_m},
                              {"nees_per_axis", row.nees_per_axis},
                              {"state_shares", shares}});
  }
  return report.dump(2) + "\n";
}

}  // namespace ardrone_vslam::test
