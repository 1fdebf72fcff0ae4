# SPDX-License-Identifier: BSD-3-Clause
import dataclasses
import unittest

import numpy as np

from ardrone_vslam_evaluation.align import Alignment, alignment_of, best_alignment
from ardrone_vslam_evaluation.associate import associate
from ardrone_vslam_evaluation.metrics import kitti_errors, position_errors_m
from ardrone_vslam_evaluation.trajectory import rotations_of_vectors
from paths import straight, winding


class AlignmentTest(unittest.TestCase):
    def moved(self, truth, scale):
        motion = Alignment(scale, rotations_of_vectors(np.array([[0.4, -1.1, 2.0]]))[0], np.array([3.0, -7.0, 20.0]))
        return motion.apply(truth), motion

    def test_rotation_and_translation_come_back(self):
        truth = winding(300)
        estimate, motion = self.moved(truth, 1.0)
        pairs = associate(estimate, truth, 0.01)
        self.assertGreater(position_errors_m(estimate, truth).min(), 1)
        found = alignment_of(pairs, "se3")
        np.testing.assert_allclose(found.rotation, motion.rotation.T, atol=1e-9)
        self.assertLess(position_errors_m(found.apply(estimate), truth).max(), 1e-9)
        np.testing.assert_allclose(found.apply(estimate).rotations, truth.rotations, atol=1e-9)

    def test_scale_comes_back_when_it_is_asked_for(self):
        truth = winding(300)
        estimate, _ = self.moved(truth, 2.5)
        pairs = associate(estimate, truth, 0.01)
        self.assertAlmostEqual(alignment_of(pairs, "sim3").scale, 1 / 2.5, places=9)
        self.assertLess(position_errors_m(alignment_of(pairs, "sim3").apply(estimate), truth).max(), 1e-9)
        self.assertGreater(position_errors_m(alignment_of(pairs, "se3").apply(estimate), truth).max(), 1)

    def test_none_moves_nothing(self):
        truth = winding(50)
        estimate, _ = self.moved(truth, 1.0)
        np.testing.assert_array_equal(alignment_of(associate(estimate, truth, 0.01), "none").apply(estimate).positions_m,
                                      estimate.positions_m)

    def test_no_small_change_is_better(self):
        truth, random = winding(200), np.random.default_rng(5)
        noisy = truth.positions_m + random.normal(0, 0.3, truth.positions_m.shape)
        for with_scale in (False, True):
            best = best_alignment(noisy, truth.positions_m, with_scale)

            def squares(motion):
                return ((motion.scale * noisy @ motion.rotation.T + motion.translation_m - truth.positions_m)**2).sum()

            for _ in range(50):
                turn = rotations_of_vectors(random.normal(0, 1e-3, (1, 3)))[0]
                scale = best.scale * (1 + random.normal(0, 1e-3)) if with_scale else 1.0
                other = Alignment(scale, turn @ best.rotation, best.translation_m + random.normal(0, 1e-3, 3))
                self.assertGreater(squares(other), squares(best))

    def test_a_mirrored_path_is_not_mirrored_back(self):
        truth = winding(200)
        mirrored = dataclasses.replace(truth, positions_m=truth.positions_m * np.array([1.0, 1.0, -1.0]))
        found = best_alignment(mirrored.positions_m, truth.positions_m, False)
        self.assertAlmostEqual(np.linalg.det(found.rotation), 1, places=9)

    def test_what_does_not_move_has_no_scale(self):
        truth = winding(20)
        self.assertIsNone(best_alignment(np.zeros((20, 3)), truth.positions_m, True))

    def test_a_straight_way_is_aligned(self):
        truth = straight(100, 50)
        estimate, _ = self.moved(truth, 1.0)
        found = best_alignment(estimate.positions_m, truth.positions_m, False)
        self.assertLess(position_errors_m(found.apply(estimate), truth).max(), 1e-9)
        self.assertAlmostEqual(np.linalg.det(found.rotation), 1, places=9)

    def test_relative_errors_do_not_depend_on_where_the_estimate_began(self):
        truth = winding(800)
        drifted = dataclasses.replace(truth, positions_m=truth.positions_m * 1.02)
        moved, _ = self.moved(drifted, 1.0)
        for key in ("t_rel_percent", "r_rel_deg_per_m"):
            self.assertAlmostEqual(kitti_errors(drifted, truth)[key], kitti_errors(moved, truth)[key], places=6)


if __name__ == "__main__":
    unittest.main()
