// SPDX-License-Identifier: BSD-3-Clause
#include "folders/range_readings.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "files/regular_file.hpp"
#include "folders/folder_files.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kNoBound_m = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<RangeReading> readRanges(const std::string& path) {
  std::vector<RangeReading> ranges;
  if (!std::filesystem::exists(path)) return ranges;
  requireFile(path, kLargestTable_bytes);
  std::ifstream file(path);
  std::string line;
  for (std::size_t line_number = 1; std::getline(file, line); ++line_number) {
    if (!line.empty() && line[0] == '#') continue;
    const auto numbers = parseNumbers(line, path, line_number);
    if (numbers.empty()) continue;
    if (numbers.size() != 2 || !(std::abs(numbers[0]) < 9e9L)) {
      throw std::runtime_error(path + ", line " + std::to_string(line_number) +
                               ": must be a stamp in seconds and a range in metres");
    }
    ranges.push_back(
        {std::llround(numbers[0] * 1e9L), static_cast<double>(numbers[1]), 0, kNoBound_m});
  }
  if (ranges.empty()) throw std::runtime_error(path + ": holds no range; fill it or remove it");
  return ranges;
}

void writeRanges(const std::string& path, const std::vector<RangeReading>& ranges) {
  std::ofstream file(path);
  file << "# stamp [s], range from base down to the floor, along its -z [m]\n";
  std::array<char, 80> text{};
  for (const RangeReading& reading : ranges) {
    std::snprintf(text.data(), text.size(), "%lld.%09lld %.6f\n",
                  static_cast<long long>(reading.stamp_ns / 1000000000),
                  static_cast<long long>(reading.stamp_ns % 1000000000), reading.range_m);
    file << text.data();
  }
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written; check the free space");
}

std::vector<RangeReading> simulateRanges(const Trajectory& truth, const RangeAt& range_m,
                                         double noise_m, std::uint64_t seed) {
  constexpr std::int64_t kInterval_ns = 40'000'000;
  constexpr std::uint64_t kStream = 25;
  RandomSource random(seed, kStream);
  std::vector<RangeReading> ranges;
  for (std::int64_t stamp_ns = truth.poses().front().stamp_ns;
       stamp_ns <= truth.poses().back().stamp_ns; stamp_ns += kInterval_ns) {
    const double true_range_m =
        range_m(truth.at(stamp_ns), stamp_ns).value_or(std::numeric_limits<double>::quiet_NaN());
    ranges.push_back({stamp_ns, true_range_m + noise_m * random.normal(), 0, kNoBound_m});
  }
  return ranges;
}

}  // namespace ardrone_vslam
