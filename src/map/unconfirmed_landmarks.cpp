// SPDX-License-Identifier: BSD-3-Clause
#include "map/unconfirmed_landmarks.hpp"

#include <cstddef>

namespace ardrone_vslam {

int UnconfirmedLandmarks::judge(LandmarkMap& map) {
  if (setup_.is_confirmed) confirmed_ns_ = newest_ns_;
  if (setup_.forgets_images) confirmed_ns_ = 0;
  if (setup_.isCameraUsed()) return 0;
  const std::size_t before = map.size();
  for (std::size_t i = before; i-- > 0;)
    if (const Landmark& one = map.all()[i]; one.first_seen_ns > confirmed_ns_ && !isLoaded(one.id))
      map.remove(one.id);
  return static_cast<int>(before - map.size());
}

}  // namespace ardrone_vslam
