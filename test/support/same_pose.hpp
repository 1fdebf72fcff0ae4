// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace ardrone_vslam::test {

/// Expects poses that are equal but for rounding; prints both if they are not.
inline void expectSamePose(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b,
                           double tolerance = 1e-12) {
  EXPECT_TRUE(a.isApprox(b, tolerance)) << a.matrix() << "\nis not\n" << b.matrix();
}

}  // namespace ardrone_vslam::test
