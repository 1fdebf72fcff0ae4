// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

// Projection and culling of landmarks with a pose prior (thesis 8.1-6) on raw pointers. The scalar
// form is the definition: every other form gives the same landmarks, pixels and distances, bit for
// bit. The tests need neither root nor quotient, so that they are the same few products on every
// instruction set. One exception: NEON of ARMv7 takes denormal numbers as zero, so that a landmark
// may be told apart there that is less than 1e-19 m or px from a limit.
namespace ardrone_vslam::kernels {

/// Landmarks as arrays of equal length, relative to a common origin, axes of map.
struct ProjectColumns {
  const float* x_m;
  const float* y_m;
  const float* z_m;
  const float* image_z_m;  ///< z that decides the pixel: z_m itself, or in 2-D mode the height
  const float* view_x;     ///< unit direction in which the landmark was last seen
  const float* view_y;
  const float* view_z;
  const float* seen_m2;  ///< squared distance from which it was last seen; 0: not known
};

/// A camera and the limits outside which landmarks are culled.
struct ProjectCamera {
  float position_m[3];  ///< relative to the columns' origin
  float rows[9];        ///< R_cam_map, row by row; the first two rows times the focal length [px]
  float left_px;        ///< ideal pixels, relative to the optical axis
  float right_px;
  float top_px;
  float bottom_px;
  float flattest2;   ///< the cosine between optical axis and landmark is greater; squared
  float cosine2;     ///< the cosine between last and present direction is not less; c |c|
  float nearest_m2;  ///< the squared distance is not less
  float ratio2;      ///< the distance is within this factor of the last one; squared
};

/// What is visible, in ascending order of the indices. Each array has room for
/// `count` + kProjectSlack entries; those behind the last are overwritten.
struct ProjectOutput {
  std::int32_t* index;
  float* x_px;
  float* y_px;
  float* distance_m;
};

constexpr int kProjectSlack = 16;

/// @return number of visible landmarks among the first `count`
/// The vector forms are bound by their arithmetic: fetching the columns ahead gains nothing, though
/// those of 100,000 landmarks (2.8 to 3.2 MB) come from the outer caches.
int projectScalar(const ProjectColumns& columns, int count, const ProjectCamera& camera,
                  const ProjectOutput& out);
int projectAvx2(const ProjectColumns& columns, int count, const ProjectCamera& camera,
                const ProjectOutput& out);
int projectAvx512(const ProjectColumns& columns, int count, const ProjectCamera& camera,
                  const ProjectOutput& out);
int projectNeon(const ProjectColumns& columns, int count, const ProjectCamera& camera,
                const ProjectOutput& out);

}  // namespace ardrone_vslam::kernels
