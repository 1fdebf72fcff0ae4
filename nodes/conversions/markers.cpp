// SPDX-License-Identifier: BSD-3-Clause
#include "conversions/markers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kSmallSigma_m = 0.01;
constexpr double kLargeSigma_m = 1.0;
constexpr double kStale_s = 3;          // there is a status each second
constexpr double kSeenOtherwise = 1.2;  // times the sigma that was drawn
constexpr double kSide_m = 0.05;
constexpr double kText_m = 0.45;
constexpr double kLine_m = 0.008;
constexpr double kRoom_m = 4;  // to the landmarks in a scene of scale 1
constexpr std::size_t kLongestLine = 44;

std_msgs::ColorRGBA colour(double r, double g, double b, double a = 1) {
  std_msgs::ColorRGBA colour;
  colour.r = static_cast<float>(r);
  colour.g = static_cast<float>(g);
  colour.b = static_cast<float>(b);
  colour.a = static_cast<float>(a);
  return colour;
}

geometry_msgs::Point toPoint(const Eigen::Vector3d& position) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  point.z = position.z();
  return point;
}

Marker markerOf(const std_msgs::Header& header, const std::string& ns, int type) {
  Marker marker;
  marker.header = header;
  marker.ns = ns;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.frame_locked = 1;  // map may move in what rviz shows
  marker.pose.orientation.w = 1;
  return marker;
}

std_msgs::ColorRGBA colourOfState(std::uint8_t state) {
  constexpr std::array kBad{Status::DISTRUSTED,  Status::NOT_FINITE,        Status::BLIND,
                            Status::CAMERA_LOST, Status::CONTROLLER_SILENT, Status::DRONE_SILENT,
                            Status::ENDED,       Status::OUT_OF_MEMORY};
  if (std::count(kBad.begin(), kBad.end(), state) > 0) return colour(1, 0.25, 0.2);
  return isWell(state) ? colour(0.3, 0.95, 0.3) : colour(1, 0.85, 0.2);
}

/// In lines of at most kLongestLine characters, where words allow it.
std::string inLines(const std::string& sentence) {
  std::istringstream words(sentence);
  std::string lines;
  std::size_t length = 0;
  for (std::string word; words >> word; length += word.size() + 1) {
    if (length + word.size() > kLongestLine) length = 0;
    lines += (length == 0 ? '\n' : ' ') + word;
  }
  return lines;
}

std::string textOf(const Status& status) {
  std::string name = status.state_name;
  std::replace(name.begin(), name.end(), '_', ' ');
  std::ostringstream text;
  text.precision(2);
  text << name;
  if (status.deviation > 0) text << ", +-" << status.deviation << " m";
  text << inLines(status.reason);
  return text.str();
}

double clampedSigma_m(double sigma_m) {
  return std::clamp(sigma_m, kSmallSigma_m, kLargeSigma_m);
}

}  // namespace

double drawnScale(const Landmarks& landmarks, const Eigen::Vector3d& base_map, double before) {
  constexpr std::size_t kSamples = 200;
  std::vector<double> distances_m;
  for (std::size_t i = 0; i < landmarks.size(); i += 1 + landmarks.size() / kSamples)
    distances_m.push_back((landmarks[i].position_map - base_map).norm());
  if (distances_m.empty()) return 1;
  const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), middle, distances_m.end());
  const double power = std::clamp(std::log2(*middle / kRoom_m), -1.0, 4.0);
  if (before > 0 && std::abs(power - std::log2(before)) < 0.75) return before;
  return std::exp2(std::round(power));
}

std_msgs::ColorRGBA colourOfSigma(double sigma_m) {
  const double share =
      std::log(clampedSigma_m(sigma_m) / kSmallSigma_m) / std::log(kLargeSigma_m / kSmallSigma_m);
  return colour(1 - share, std::min(1.0, 1.6 - 1.4 * share), 1);
}

MarkerArray toStateMarkers(const Status& status, const Eigen::Vector3d& base_map,
                           const Landmarks& landmarks) {
  const double scale = drawnScale(landmarks, base_map);
  Marker text = markerOf(status.header, "state", Marker::TEXT_VIEW_FACING);
  text.text = textOf(status);
  text.pose.position = toPoint(base_map + Eigen::Vector3d(0, 0, 3 * kText_m * scale));
  text.scale.z = kText_m * scale;
  text.color = colourOfState(status.state);

  Marker in_use = markerOf(status.header, "landmarks in use", Marker::POINTS);
  in_use.scale.x = in_use.scale.y = 2 * kSide_m * scale;
  in_use.color = colour(1, 0.6, 0.1);
  Marker fixes = markerOf(status.header, "fixes", Marker::LINE_LIST);
  fixes.scale.x = kLine_m * scale;
  fixes.color = colour(1, 0.6, 0.1, 0.3);
  const std::int64_t stamp_ns = toNanoseconds(status.header.stamp);
  for (const Landmark& landmark : landmarks) {
    if (landmark.last_seen_ns != stamp_ns || landmark.first_seen_ns == stamp_ns) continue;
    in_use.points.push_back(toPoint(landmark.position_map));
    fixes.points.push_back(toPoint(base_map));
    fixes.points.push_back(in_use.points.back());
  }
  // rviz complains of a marker that is to be shown but has no points.
  if (in_use.points.empty()) in_use.action = fixes.action = Marker::DELETE;

  MarkerArray array;
  array.markers = {text, in_use, fixes};
  for (Marker& marker : array.markers) marker.lifetime = ros::Duration(kStale_s);
  return array;
}

MarkerArray LandmarkMarkers::changes(const Landmarks& landmarks, const std_msgs::Header& header,
                                     const Eigen::Vector3d& base_map) {
  const double scale = drawnScale(landmarks, base_map, scale_);
  if (scale != scale_) forget();
  scale_ = scale;
  MarkerArray array;
  const std::size_t count = (landmarks.size() + kBlock - 1) / kBlock;
  const auto add = [&](Marker marker, std::size_t block) {
    marker.id = static_cast<int>(block);
    array.markers.push_back(std::move(marker));
  };
  for (std::size_t block = count; block < blocks_.size(); ++block) {
    Marker gone = markerOf(header, "landmarks", Marker::POINTS);
    gone.action = Marker::DELETE;
    add(gone, block);
  }
  blocks_.resize(count);
  if (count > 0) blocks_[once_more_++ % count].clear();
  for (std::size_t i = 0; i < std::min(count, kMostBlocks); ++i, ++next_) {
    if (next_ >= count) next_ = 0;
    const auto from = static_cast<std::ptrdiff_t>(next_ * kBlock);
    const auto begin = landmarks.begin() + from;
    const auto end = std::min(landmarks.end(), begin + kBlock);
    if (isDrawn(blocks_[next_], begin, end)) continue;
    Marker marker = draw(blocks_[next_], begin, end);
    marker.header = header;
    add(std::move(marker), next_);
  }
  return array;
}

bool LandmarkMarkers::isDrawn(const Block& block, Landmarks::const_iterator begin,
                              Landmarks::const_iterator end) const {
  const auto is_drawn = [this](const Landmark& landmark, const Drawn& drawn) {
    const double sigma = clampedSigma_m(landmark.sigma_m) / drawn.sigma_m;
    return landmark.id == drawn.id &&
           (landmark.position_map.cast<float>() - drawn.position_map).norm() <
               scale_ * kSide_m / 2 &&
           sigma < kSeenOtherwise && sigma > 1 / kSeenOtherwise;
  };
  return std::equal(begin, end, block.begin(), block.end(), is_drawn);
}

Marker LandmarkMarkers::draw(Block& block, Landmarks::const_iterator begin,
                             Landmarks::const_iterator end) const {
  Marker marker = markerOf({}, "landmarks", Marker::POINTS);
  marker.scale.x = marker.scale.y = scale_ * kSide_m;
  block.clear();
  for (auto landmark = begin; landmark != end; ++landmark) {
    block.push_back(
        {landmark->id, landmark->position_map.cast<float>(), clampedSigma_m(landmark->sigma_m)});
    marker.points.push_back(toPoint(landmark->position_map));
    marker.colors.push_back(colourOfSigma(landmark->sigma_m));
  }
  return marker;
}

}  // namespace ardrone_vslam
