// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Status.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "ardrone_vslam/landmark.hpp"

/// What rviz draws.
namespace ardrone_vslam {

/// How much larger than in a room of some metres things are drawn, a power of two: so that a street
/// is as legible.
/// @param before  kept while it does nearly as well
/// @return 1 without landmarks
double drawnScale(const Landmarks& landmarks, const Eigen::Vector3d& base_map, double before = 0);

/// From white (sigma at most 1 cm) over light blue to blue (at least 1 m).
std_msgs::ColorRGBA colourOfSigma(double sigma_m);

/// Above the drone what the status says, in green, yellow or red; landmarks of earlier images that
/// this one has shown again, and lines to them from base.
visualization_msgs::MarkerArray toStateMarkers(const Status& status,
                                               const Eigen::Vector3d& base_map,
                                               const Landmarks& landmarks);

/// The map as markers of 256 landmarks each, of which only those are sent that look otherwise.
class LandmarkMarkers {
 public:
  static constexpr std::size_t kBlock = 256;
  /// Blocks looked at by one call: of a large map a part each time.
  static constexpr std::size_t kMostBlocks = 64;

  /// @param landmarks  in the order of the call before, but for some; else more is sent
  /// @return the blocks, of the next kMostBlocks, in which a landmark is another one, has moved by
  /// half a marker's side or changed its colour; DELETE for those that are gone; and one more, as
  /// rviz forgets when it is reset
  visualization_msgs::MarkerArray changes(const Landmarks& landmarks,
                                          const std_msgs::Header& header,
                                          const Eigen::Vector3d& base_map);
  /// All are sent anew.
  void forget() {
    for (Block& block : blocks_) block.clear();
  }

 private:
  struct Drawn {
    std::uint32_t id;
    Eigen::Vector3f position_map;
    double sigma_m;
  };
  using Block = std::vector<Drawn>;

  bool isDrawn(const Block& block, Landmarks::const_iterator begin,
               Landmarks::const_iterator end) const;
  visualization_msgs::Marker draw(Block& block, Landmarks::const_iterator begin,
                                  Landmarks::const_iterator end) const;

  std::vector<Block> blocks_;
  std::size_t next_ = 0;
  std::size_t once_more_ = 0;
  double scale_ = 0;
};

}  // namespace ardrone_vslam
