// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/trajectory.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <locale>
#include <sstream>
#include <stdexcept>

#include "files/regular_file.hpp"
#include "trajectory/text_file.hpp"

namespace ardrone_vslam {
namespace {

std::string secondsText(std::int64_t stamp_ns) {
  const std::int64_t magnitude_ns = std::abs(stamp_ns);
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%s%lld.%09lld", stamp_ns < 0 ? "-" : "",
                static_cast<long long>(magnitude_ns / 1000000000),
                static_cast<long long>(magnitude_ns % 1000000000));
  return text.data();
}

/// Empty when `pose` may follow the last of `poses`, else what is wrong.
std::string faultOfNext(const std::vector<StampedPose>& poses, const StampedPose& pose) {
  if (!pose.T_frame_body.matrix().allFinite()) {
    return "the pose at " + secondsText(pose.stamp_ns) + " s is not finite";
  }
  if (!poses.empty() && pose.stamp_ns <= poses.back().stamp_ns) {
    return "the stamp " + secondsText(pose.stamp_ns) + " s does not come after the one before, " +
           secondsText(poses.back().stamp_ns) + " s";
  }
  return {};
}

constexpr std::int64_t kMaxSeconds = 9000000000;  // 64 bits of nanoseconds

/// Reads "sec.fraction" digit by digit: a double has no nanoseconds left at today's epoch.
/// @return false when it is not written so, or too large
bool parseDigits(const std::string& text, std::int64_t& stamp_ns) {
  const bool negative = text[0] == '-';
  std::size_t i = negative || text[0] == '+' ? 1 : 0;
  std::size_t digits = 0;
  const auto isDigit = [&] { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  std::int64_t seconds = 0, fraction_ns = 0, unit_ns = 100000000;
  for (; isDigit() && seconds <= kMaxSeconds; ++i, ++digits)
    seconds = 10 * seconds + (text[i] - '0');
  const bool has_fraction = i < text.size() && text[i] == '.';
  if (has_fraction) ++i;
  for (; has_fraction && isDigit(); ++i, ++digits) {
    fraction_ns += unit_ns * (text[i] - '0');
    unit_ns /= 10;
  }
  if (i != text.size() || digits == 0 || seconds > kMaxSeconds) return false;
  stamp_ns = seconds * 1000000000 + fraction_ns;
  if (negative) stamp_ns = -stamp_ns;
  return true;
}

bool parseStamp(const std::string& text, std::int64_t& stamp_ns) {
  if (parseDigits(text, stamp_ns)) return true;
  // Exponents, as numpy.savetxt writes them: no more digits than a double has.
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0;
  if (!(stream >> value) || !stream.eof() || !(std::abs(value) <= kMaxSeconds)) return false;
  stamp_ns = std::llround(value * 1e9);
  return true;
}

/// @return what is wrong with the line; empty when `pose` is set
std::string parseLine(const std::string& line, StampedPose& pose) {
  std::istringstream stream(line);
  stream.imbue(std::locale::classic());
  std::string stamp_text, surplus;
  std::array<double, 7> values{};
  stream >> stamp_text;
  if (!parseStamp(stamp_text, pose.stamp_ns)) return "the stamp '" + stamp_text + "' is no number";
  for (auto& value : values) {
    if (!(stream >> value)) {
      return "eight finite numbers are expected: stamp tx ty tz qx qy qz qw";
    }
  }
  if (stream >> surplus) return "more than eight values: '" + surplus + "'";
  const Eigen::Quaterniond rotation(values[6], values[3], values[4], values[5]);
  const double norm = rotation.norm();
  if (!(std::abs(norm - 1) < 0.01)) return "the quaternion's norm is not 1";
  pose.T_frame_body = Eigen::Isometry3d::Identity();
  pose.T_frame_body.linear() = rotation.normalized().toRotationMatrix();
  pose.T_frame_body.translation() << values[0], values[1], values[2];
  if (isTooFar(pose.T_frame_body.translation())) return kTooFarFault;
  return {};
}

template <class Check>
std::vector<StampedPose> readLines(const std::string& path, Check&& check) {
  std::ifstream file = openFile(path, kLargestTable_bytes);
  std::vector<StampedPose> poses;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    line.erase(std::find(line.begin(), line.end(), '#'), line.end());
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    StampedPose pose;
    std::string fault = parseLine(line, pose);
    if (fault.empty()) fault = check(poses, pose);
    if (!fault.empty()) {
      throw std::runtime_error(path + ":" + std::to_string(number) + ": " + fault +
                               "; correct or remove the line");
    }
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace

Trajectory::Trajectory(const std::vector<StampedPose>& poses) {
  poses_.reserve(poses.size());
  for (const auto& pose : poses) append(pose);
}

bool Trajectory::covers(std::int64_t stamp_ns, std::int64_t max_gap_ns) const {
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), stamp_ns,
                       [](const StampedPose& pose, std::int64_t t) { return pose.stamp_ns < t; });
  if (after == poses_.end()) return false;
  if (after->stamp_ns == stamp_ns) return true;
  return after != poses_.begin() && after->stamp_ns - std::prev(after)->stamp_ns <= max_gap_ns;
}

void Trajectory::append(const StampedPose& pose) {
  const std::string fault = faultOfNext(poses_, pose);
  if (!fault.empty()) throw std::invalid_argument("trajectory: " + fault);
  poses_.push_back(pose);
}

Eigen::Isometry3d Trajectory::at(std::int64_t stamp_ns) const {
  assert(!poses_.empty() && "an empty trajectory has no pose");
  if (stamp_ns <= poses_.front().stamp_ns) return poses_.front().T_frame_body;
  if (stamp_ns >= poses_.back().stamp_ns) return poses_.back().T_frame_body;
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), stamp_ns,
                       [](const StampedPose& p, std::int64_t t) { return p.stamp_ns < t; });
  if (after->stamp_ns == stamp_ns) return after->T_frame_body;
  const auto before = std::prev(after);
  const double share = static_cast<double>(stamp_ns - before->stamp_ns) /
                       static_cast<double>(after->stamp_ns - before->stamp_ns);
  const Eigen::Quaterniond q_before(before->T_frame_body.linear());
  const Eigen::Quaterniond q_after(after->T_frame_body.linear());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q_before.slerp(share, q_after).normalized().toRotationMatrix();
  pose.translation() =
      (1 - share) * before->T_frame_body.translation() + share * after->T_frame_body.translation();
  return pose;
}

Trajectory readTum(const std::string& path) {
  return Trajectory(readLines(path, faultOfNext));
}

std::vector<StampedPose> readTumPoses(const std::string& path) {
  return readLines(path, [](const auto&, const StampedPose&) { return std::string(); });
}

void writeTum(const std::string& path, const Trajectory& trajectory) {
  writeTumPoses(path, trajectory.poses(), "");
}

void writeTumPoses(const std::string& path, const std::vector<StampedPose>& poses,
                   const std::string& comment) {
  std::ostringstream file;
  std::istringstream comment_lines(comment);
  for (std::string line; std::getline(comment_lines, line);) file << "# " << line << '\n';
  file << "# timestamp[s] tx ty tz[m] qx qy qz qw\n";
  file.imbue(std::locale::classic());
  file << std::fixed << std::setprecision(9);
  for (const auto& pose : poses) {
    const Eigen::Vector3d& p = pose.T_frame_body.translation();
    Eigen::Quaterniond q(pose.T_frame_body.linear());
    if (q.w() < 0) q.coeffs() = -q.coeffs();
    file << secondsText(pose.stamp_ns);
    for (const double value : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) {
      file << ' ' << value;
    }
    file << '\n';
  }
  writeText(path, file.str());
}

}  // namespace ardrone_vslam
