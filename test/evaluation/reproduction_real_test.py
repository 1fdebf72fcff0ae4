# SPDX-License-Identifier: BSD-3-Clause
"""scripts/reproduce on the real pictures and sequences."""

import os
import tempfile
import unittest

from reproduction_test import compare_numbers, run_quick, run_whole

# Those whose numbers depend on the pictures.
WITH_PICTURES = ("detectors", "repeatability", "sampling", "matches", "kitti", "thresholds")


class RealReproductionTest(unittest.TestCase):
    def test_every_number_is_within_its_bounds(self):
        if not os.environ.get("ARDRONE_VSLAM_DATA"):
            self.skipTest("ARDRONE_VSLAM_DATA is not set, so there are no real pictures")
        with tempfile.TemporaryDirectory() as out:
            self.assertIn("graf", run_quick(self, out, "--sections", *WITH_PICTURES))

    def test_the_committed_numbers_are_those_of_the_code(self):
        """Of the sections with pictures that take some seconds. Why not of the others: reproduction_test."""
        if not os.environ.get("ARDRONE_VSLAM_DATA"):
            self.skipTest("ARDRONE_VSLAM_DATA is not set, so there are no real pictures")
        with tempfile.TemporaryDirectory() as out:
            compare_numbers(self, run_whole(self, out, "--sections", "detectors", "repeatability", "sampling", "matches"))


if __name__ == "__main__":
    unittest.main()
