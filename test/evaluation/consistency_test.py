# SPDX-License-Identifier: BSD-3-Clause
import dataclasses
import unittest

import numpy as np

from ardrone_vslam_evaluation import consistency
from ardrone_vslam_evaluation.align import Alignment
from ardrone_vslam_evaluation.trajectory import rotations_of_vectors
from paths import winding


class ConsistencyTest(unittest.TestCase):
    def test_chi_square_quantiles_are_those_of_the_tables(self):
        for share, degrees, value in ((0.95, 1, 3.841459), (0.95, 3, 7.814728), (0.025, 3, 0.215795), (0.975, 3, 9.348404),
                                      (0.99, 10, 23.209251), (0.05, 100, 77.929465), (0.975, 1500, 1609.233218)):
            self.assertAlmostEqual(consistency.chi_square_quantile(share, degrees), value, delta=2e-6 * value)

    def test_three_sigma_is_as_rare_as_of_one_coordinate(self):
        within_one = consistency.gamma_share(0.5, 4.5)  # |x| < 3 sigma
        self.assertAlmostEqual(within_one, 0.9973002, places=6)
        self.assertAlmostEqual(consistency.gamma_share(1.5, 0.5 * consistency.NEES_3_SIGMA), within_one, places=5)

    def test_honest_claims_are_found_honest_in_any_frame(self):
        random, truth = np.random.default_rng(7), winding(20000)
        root = np.array([[0.5, 0, 0], [0.3, 0.2, 0], [-0.1, 0.4, 1.0]])
        estimate = dataclasses.replace(truth, positions_m=truth.positions_m + random.normal(0, 1, (len(truth), 3)) @ root.T,
                                       covariances_m2=np.tile(root @ root.T, (len(truth), 1, 1)))
        values = consistency.nees_of(estimate, truth)
        summary = consistency.summary_of_nees(values)
        self.assertAlmostEqual(summary["mean"], 3, delta=0.07)
        self.assertAlmostEqual(summary["inside_95"], 0.95, delta=0.01)
        self.assertAlmostEqual(summary["inside_3_sigma"], 0.9973, delta=0.002)
        self.assertTrue(summary["mean_bounds_95"][0] < 3 < summary["mean_bounds_95"][1])
        motion = Alignment(2.0, rotations_of_vectors(np.array([[1.0, 2.0, -0.5]]))[0], np.array([1.0, 2.0, 3.0]))
        np.testing.assert_allclose(consistency.nees_of(motion.apply(estimate), motion.apply(truth)), values, rtol=1e-6)

    def test_too_sure_shows(self):
        random, truth = np.random.default_rng(7), winding(2000)
        estimate = dataclasses.replace(truth, positions_m=truth.positions_m + random.normal(0, 2, (len(truth), 3)),
                                       covariances_m2=np.tile(np.eye(3), (len(truth), 1, 1)))
        summary = consistency.summary_of_nees(consistency.nees_of(estimate, truth))
        self.assertAlmostEqual(summary["mean"], 12, delta=1)
        self.assertLess(summary["inside_3_sigma"], 0.8)

    def test_covariances_that_cannot_be_are_left_out(self):
        truth = winding(3)
        covariances = np.stack([np.eye(3), np.zeros((3, 3)), np.full((3, 3), np.nan)])
        values = consistency.nees_of(dataclasses.replace(truth, covariances_m2=covariances), truth)
        np.testing.assert_array_equal(np.isfinite(values), [True, False, False])
        self.assertEqual(consistency.summary_of_nees(values)["poses"], 1)
        self.assertIsNone(consistency.summary_of_nees(values[1:]))
        self.assertIsNone(consistency.nees_of(truth, truth))

    def test_nis_counts_from_the_first_fix(self):
        summary = consistency.summary_of_nis(np.array([np.nan, 1, 1, 1.2, 0.8, 1]))
        self.assertEqual((summary["frames"], summary["mean"]), (3, 1.0))
        self.assertIsNone(consistency.summary_of_nis(np.array([1.0, 1.0])))


if __name__ == "__main__":
    unittest.main()
