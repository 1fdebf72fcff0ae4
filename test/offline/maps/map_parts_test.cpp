// SPDX-License-Identifier: BSD-3-Clause
#include "maps/map_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "ardrone_vslam/rotation.hpp"
#include "maps/map_text.hpp"

namespace ardrone_vslam {
namespace {

/// Three anchors with two landmarks each, seen 1, 2 ... 6 times, known to 0.6, 0.5 ... 0.1 m.
SavedMap threeAnchors() {
  SavedMap map;
  map.cameras = {{640, 360, 560}};
  const int size = 3 * SavedMap::kAnchor;
  const Eigen::VectorXd numbers = Eigen::VectorXd::LinSpaced(size, 1, size);
  map.anchor_covariance = numbers * numbers.transpose();
  map.anchor_covariance += Eigen::MatrixXd::Identity(size, size);
  for (std::uint32_t i = 0; i < 3; ++i) {
    MapAnchor anchor;
    anchor.stamp_ns = 100 + i;
    anchor.T_map_rig.translation().x() = i;
    map.anchors.push_back(anchor);
    for (std::uint32_t j = 0; j < 2; ++j) {
      Landmark landmark;
      landmark.id = 2 * i + j + 1;
      landmark.anchor_id = i + 1;
      landmark.times_seen = static_cast<int>(landmark.id);
      landmark.sigma_m = 0.7F - 0.1F * static_cast<float>(landmark.id);
      landmark.position_map << landmark.id, 0, 1;
      map.landmarks.push_back(landmark);
    }
  }
  return map;
}

std::vector<std::uint32_t> idsOf(const SavedMap& map) {
  std::vector<std::uint32_t> ids;
  for (const Landmark& landmark : map.landmarks) ids.push_back(landmark.id);
  return ids;
}

using Ids = std::vector<std::uint32_t>;

TEST(MapParts, AnchorsWithoutLandmarksGoWithTheirCovariance) {
  const SavedMap map = threeAnchors();
  const SavedMap part = partOf(map, [](const Landmark& l) { return l.anchor_id != 2; });
  EXPECT_EQ(idsOf(part), (Ids{1, 2, 5, 6}));
  ASSERT_EQ(part.anchors.size(), 2U);
  EXPECT_EQ(part.anchors[1].stamp_ns, 102);
  EXPECT_EQ(part.landmarks.back().anchor_id, 2U);
  const int n = SavedMap::kAnchor;
  EXPECT_EQ(part.anchor_covariance.block(n, n, n, n),
            map.anchor_covariance.block(2 * n, 2 * n, n, n));
  EXPECT_EQ(part.anchor_covariance.block(0, n, n, n), map.anchor_covariance.block(0, 2 * n, n, n));
}

TEST(MapParts, AnchorsCanBeInAnotherOrder) {
  const SavedMap map = threeAnchors();
  SavedMap turned = map;
  keepAnchors(turned, {2, 0, 1});
  EXPECT_EQ(turned.anchors.front().stamp_ns, 102);
  EXPECT_EQ(turned.landmarks.front().anchor_id, 2U);
  for (std::size_t i = 0; i < map.landmarks.size(); ++i)
    EXPECT_EQ(covarianceOf(turned, turned.landmarks[i]), covarianceOf(map, map.landmarks[i])) << i;
}

TEST(MapParts, PruneKeepsWhatIsSeenOften) {
  const SavedMap map = threeAnchors();
  PruneRules rules;
  rules.least_seen = 3;
  EXPECT_EQ(idsOf(prune(map, rules)), (Ids{3, 4, 5, 6}));
  rules.most_sigma_m = 0.25;
  EXPECT_EQ(idsOf(prune(map, rules)), (Ids{5, 6}));
  rules = {};
  rules.most = 3;
  EXPECT_EQ(idsOf(prune(map, rules)), (Ids{4, 5, 6}));
  rules.most = 100;
  EXPECT_EQ(idsOf(prune(map, rules)).size(), 6U);
}

// A landmark moves with its anchor: turned about it, stretched from it.
TEST(MapParts, ByAnchorIsTheDerivative) {
  MapAnchor anchor;
  anchor.T_map_rig.translation() << 1, 2, 3;
  const Eigen::Vector3d position(2, 0, 5);
  const Eigen::Vector3d from_anchor = position - anchor.T_map_rig.translation();
  constexpr double kStep = 1e-6;
  for (int i = 0; i < SavedMap::kAnchor; ++i) {
    Eigen::Matrix<double, SavedMap::kAnchor, 1> error =
        Eigen::Matrix<double, SavedMap::kAnchor, 1>::Zero();
    error(i) = kStep;
    const Eigen::Vector3d moved = anchor.T_map_rig.translation() + error.head<3>() +
                                  rotationOf(error.segment<3>(3)) * from_anchor * (1 - error(6));
    EXPECT_LT(((moved - position) / kStep - byAnchor(anchor, position).col(i)).norm(), 1e-5) << i;
  }
}

TEST(MapText, SaysWhatIsInIt) {
  const SavedMap map = threeAnchors();
  const auto facts = factsOf(map);
  EXPECT_EQ(facts["landmarks"], 6);
  EXPECT_EQ(facts["anchors"], 3);
  EXPECT_EQ(facts["to_m"][0], 6.0);
  EXPECT_EQ(facts["times_seen"]["median"], 3.5);
  EXPECT_EQ(factsOf(SavedMap{})["landmarks"], 0);
  const std::string csv = csvOf(map);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_NE(csv.find("\n6,6,0,1,0.1,6,3,"), std::string::npos) << csv;
  const std::string ply = plyOf(map);
  EXPECT_EQ(ply.substr(0, 4), "ply\n");
  EXPECT_NE(ply.find("element vertex 6\n"), std::string::npos);
  EXPECT_NE(ply.find("end_header\n1 0 1 0.6 1\n"), std::string::npos) << ply;
}

}  // namespace
}  // namespace ardrone_vslam
