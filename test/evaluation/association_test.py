# SPDX-License-Identifier: BSD-3-Clause
import dataclasses
import unittest

import numpy as np

from ardrone_vslam_evaluation.associate import associate
from ardrone_vslam_evaluation.faults import InputFault
from paths import stamps_ns, straight, winding


class AssociationTest(unittest.TestCase):
    def test_pairs_are_the_nearest_and_the_rest_is_counted(self):
        truth = winding(100)
        chosen = np.arange(5, 90, 3)
        estimate = truth.at(chosen)
        estimate = dataclasses.replace(estimate, stamps_ns=estimate.stamps_ns + 4_000_000)
        pairs = associate(estimate, truth, 0.01)
        np.testing.assert_array_equal(pairs.truth.positions_m, truth.positions_m[chosen])
        self.assertEqual((pairs.unmatched_estimate, pairs.unmatched_truth), (0, 100 - len(chosen)))

    def test_what_is_too_far_in_time_is_left_out(self):
        truth = straight(10, 11)
        late = truth.stamps_ns.copy()
        late[4] += 30_000_000
        pairs = associate(dataclasses.replace(truth, stamps_ns=late), truth, 0.02)
        self.assertEqual(pairs.unmatched_estimate, 1)
        self.assertNotIn(4, pairs.indices)

    def test_no_truth_is_used_twice(self):
        truth = straight(10, 11)  # 10 Hz
        estimate = dataclasses.replace(straight(10, 101), stamps_ns=stamps_ns(101, 100))
        pairs = associate(estimate, truth, 0.05)
        self.assertEqual(len(pairs.truth), 11)
        np.testing.assert_array_equal(pairs.truth.stamps_ns, pairs.estimate.stamps_ns)

    def test_interpolation_is_exact_on_a_straight_way(self):
        truth = straight(10, 11)
        between = dataclasses.replace(straight(9, 10), stamps_ns=truth.stamps_ns[:-1] + 25_000_000)
        pairs = associate(between, truth, 0.1, interpolate=True)
        np.testing.assert_allclose(pairs.truth.positions_m[:, 0], np.arange(10) + 0.25, atol=1e-12)
        self.assertEqual(pairs.unmatched_estimate, 0)

    def test_interpolation_turns_evenly_and_keeps_equal_stamps(self):
        truth = winding(50)
        np.testing.assert_allclose(associate(truth, truth, 0.02, interpolate=True).truth.rotations, truth.rotations, atol=1e-12)
        sparse = truth.at(np.array([0, 2]))
        middle = dataclasses.replace(truth.at(np.array([1])), stamps_ns=truth.stamps_ns[1:2])
        half = associate(middle, sparse, 0.15, interpolate=True).truth.rotations[0]
        np.testing.assert_allclose(half.T @ sparse.rotations[1], sparse.rotations[0].T @ half, atol=1e-12)

    def test_interpolation_does_not_reach_over_gaps_or_ends(self):
        truth = straight(10, 11).at(np.array([0, 1, 2, 8, 9]))
        estimate = dataclasses.replace(straight(10, 21), stamps_ns=stamps_ns(21, 20))
        pairs = associate(estimate, truth, 0.06, interpolate=True)
        np.testing.assert_array_equal(pairs.indices, [0, 1, 2, 3, 4, 16, 17, 18])

    def test_one_pose_of_truth(self):
        truth = straight(10, 11)
        for interpolate in (False, True):
            self.assertEqual(len(associate(truth, truth.at(np.array([3])), 0.01, interpolate).truth), 1)

    def test_other_clocks_are_told(self):
        truth = straight(10, 11)
        with self.assertRaisesRegex(InputFault, "straight from 1000.000 to 1001.000 s and straight from 0.000 .*--max-difference"):
            associate(dataclasses.replace(truth, stamps_ns=stamps_ns(11, 10, 1000)), truth, 0.02)


if __name__ == "__main__":
    unittest.main()
