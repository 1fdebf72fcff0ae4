# SPDX-License-Identifier: BSD-3-Clause
import dataclasses
import unittest

import numpy as np

from ardrone_vslam_evaluation import metrics
from ardrone_vslam_evaluation.trajectory import rotations_of_vectors
from paths import stamps_ns, straight, winding


class MetricsTest(unittest.TestCase):
    def test_nothing_is_wrong_with_the_truth_itself(self):
        truth = winding(1000)
        kitti = metrics.kitti_errors(truth, truth)
        self.assertAlmostEqual(kitti["t_rel_percent"], 0, places=12)
        self.assertAlmostEqual(kitti["r_rel_deg_per_m"], 0, places=6)
        self.assertEqual(metrics.summary_of_errors(metrics.position_errors_m(truth, truth))["max_m"], 0)
        self.assertAlmostEqual(metrics.relative_pose_errors_over_time(truth, truth)["translation_rmse_m"], 0, places=12)

    def test_t_rel_of_a_scaled_straight_way_is_the_scale_error(self):
        # A metre a pose; sub-paths end at the first pose beyond their length, so at the next metre.
        truth = straight(1000, 1001)
        estimate = dataclasses.replace(truth, positions_m=truth.positions_m * 1.03)
        kitti = metrics.kitti_errors(estimate, truth)
        for part in kitti["by_length"]:
            self.assertAlmostEqual(part["t_rel_percent"], 3 * (part["length_m"] + 1) / part["length_m"], places=9)
        self.assertEqual([part["length_m"] for part in kitti["by_length"]], list(range(100, 900, 100)))
        self.assertEqual(kitti["by_length"][0]["sub_paths"], 90)  # starts at 0, 10 .. 890

    def test_r_rel_of_a_steady_yaw_drift_is_the_drift(self):
        truth = straight(500, 5001)
        drift_deg_per_m = 0.02
        yaw = np.radians(drift_deg_per_m) * truth.positions_m[:, 0]
        estimate = dataclasses.replace(truth, rotations=rotations_of_vectors(np.outer(yaw, [0, 0, 1])))
        self.assertAlmostEqual(metrics.kitti_errors(estimate, truth)["r_rel_deg_per_m"], drift_deg_per_m, delta=2e-5)

    def test_below_100_m_there_is_no_t_rel(self):
        self.assertIsNone(metrics.kitti_errors(straight(99, 200), straight(99, 200)))

    def test_errors_of_a_known_offset(self):
        truth = straight(10, 4)
        estimate = dataclasses.replace(truth, positions_m=truth.positions_m + np.array([[0, 0, 0], [0, 1, 0], [0, 0, 2], [0, 3, 4]]))
        summary = metrics.summary_of_errors(metrics.position_errors_m(estimate, truth))
        self.assertAlmostEqual(summary["rmse_m"], np.sqrt((0 + 1 + 4 + 25) / 4))
        self.assertEqual((summary["mean_m"], summary["median_m"], summary["max_m"], summary["last_m"]), (2, 1.5, 5, 5))

    def test_rpe_of_a_scaled_way_over_a_second_and_a_metre(self):
        truth = straight(60, 301)  # 0.2 m a pose at 10 Hz: 2 m/s
        estimate = dataclasses.replace(truth, positions_m=truth.positions_m * 1.05)
        over_time = metrics.relative_pose_errors_over_time(estimate, truth)
        self.assertAlmostEqual(over_time["translation_rmse_m"], 0.1, places=9)
        self.assertEqual(over_time["pairs"], 291)
        over_way = metrics.relative_pose_errors_over_way(estimate, truth)
        self.assertAlmostEqual(over_way["translation_rmse_m"], 0.05, places=9)

    def test_rpe_is_for_exactly_a_second_whatever_the_rate(self):
        for rate_hz in (3, 7, 30):
            truth = dataclasses.replace(straight(2 * 99 / rate_hz, 100), stamps_ns=stamps_ns(100, rate_hz))
            estimate = dataclasses.replace(truth, positions_m=truth.positions_m * 1.05)
            over_time = metrics.relative_pose_errors_over_time(estimate, truth)
            self.assertAlmostEqual(over_time["translation_rmse_m"], 0.1, places=7)

    def test_rpe_leaves_out_gaps_and_standstill(self):
        truth = straight(50, 6)  # 10 m a pose: none is a metre away
        self.assertIsNone(metrics.relative_pose_errors_over_way(truth, truth))
        sparse = dataclasses.replace(truth, stamps_ns=truth.stamps_ns * 50)  # 5 s apart
        self.assertIsNone(metrics.relative_pose_errors_over_time(sparse, sparse))
        still = straight(0, 50)
        self.assertIsNone(metrics.relative_pose_errors_over_way(still, still))
        self.assertIsNotNone(metrics.relative_pose_errors_over_time(still, still))

    def test_removing_the_scale_error_leaves_nothing_of_it(self):
        truth = winding(100).positions_m
        odometry = metrics.with_scale_error(truth, 0.02)
        np.testing.assert_array_equal(odometry[0], truth[0])
        np.testing.assert_allclose(np.linalg.norm(odometry[50] - truth[50]), 0.02 * np.linalg.norm(truth[50] - truth[0]))


if __name__ == "__main__":
    unittest.main()
