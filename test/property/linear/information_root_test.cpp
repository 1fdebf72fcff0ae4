// SPDX-License-Identifier: BSD-3-Clause
#include "linear/information_root.hpp"

#include <gtest/gtest.h>

#include "linear/information.hpp"
#include "support/seeds.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr int kSize = 12;

/// Of so many random measurements with unit noise, whose coordinates differ much in size.
Information informationOf(int measurements) {
  Information information = Information::between(0, kSize);
  const Eigen::VectorXd scale = Eigen::pow(10.0, Eigen::ArrayXd::LinSpaced(kSize, -4, 4)).matrix();
  const Eigen::MatrixXd H = Eigen::MatrixXd::Random(measurements, kSize) * scale.asDiagonal();
  information.matrix = H.transpose() * H;
  information.vector = H.transpose() * Eigen::VectorXd::Random(measurements);
  return information;
}

/// Largest difference, each coordinate in units of what is measured of it.
double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& unit) {
  const Eigen::MatrixXd off = unit.cwiseInverse().asDiagonal() * (a - b);
  return off.cwiseAbs().maxCoeff();
}

TEST(InformationRoot, IsTheInformationUpToItsRank) {
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(seed);
    std::srand(static_cast<unsigned>(seed));
    for (const int measurements : {1, 3, 11, 12, 40}) {
      const Information information = informationOf(measurements);
      const InformationRoot root(information, Eigen::VectorXd::Ones(kSize));
      ASSERT_EQ(root.rows.cols(), std::min(measurements, kSize));
      ASSERT_EQ(root.measured.size(), root.rows.cols());
      const Eigen::VectorXd unit = information.matrix.diagonal().cwiseSqrt();
      EXPECT_LT(difference(root.rows * root.rows.transpose() * unit.cwiseInverse().asDiagonal(),
                           information.matrix * unit.cwiseInverse().asDiagonal(), unit),
                1e-10);
      EXPECT_LT(difference(root.rows * root.measured, information.vector, unit), 1e-8);
    }
  }
}

TEST(InformationRoot, ExactCoordinatesCountOnlyBesideOthers) {
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(seed);
    std::srand(static_cast<unsigned>(seed));
    const Information information = informationOf(40);
    Eigen::VectorXd variances = Eigen::VectorXd::Ones(kSize);
    variances.head(5).setZero();
    const InformationRoot root(information, variances);
    ASSERT_EQ(root.rows.cols(), kSize - 5);
    const Eigen::VectorXd unit = information.matrix.diagonal().cwiseSqrt().tail(kSize - 5);
    const Eigen::MatrixXd product = root.rows * root.rows.transpose();
    EXPECT_LT(difference(product.bottomRightCorner(kSize - 5, kSize - 5) *
                             unit.cwiseInverse().asDiagonal(),
                         information.matrix.bottomRightCorner(kSize - 5, kSize - 5) *
                             unit.cwiseInverse().asDiagonal(),
                         unit),
              1e-10);
  }
}

TEST(InformationRoot, NothingMeasuredIsNoMeasurement) {
  std::vector<int> coordinates(kSize, 0);
  EXPECT_EQ(InformationRoot(Information(coordinates), Eigen::VectorXd::Ones(kSize)).rows.cols(), 0);
  std::srand(1);
  EXPECT_EQ(InformationRoot(informationOf(9), Eigen::VectorXd::Zero(kSize)).rows.cols(), 0);
}

}  // namespace
}  // namespace ardrone_vslam::test
