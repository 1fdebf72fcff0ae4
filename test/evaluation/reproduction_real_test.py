# SPDX-License-Identifier: BSD-3-Clause
"""scripts/reproduce on the real pictures and sequences."""

import os
import tempfile
import unittest

from reproduction_test import run_quick

# Those whose numbers depend on the pictures.
WITH_PICTURES = ("detectors", "repeatability", "sampling", "matches", "kitti", "thresholds")


class RealReproductionTest(unittest.TestCase):
    def test_every_number_is_within_its_bounds(self):
        if not os.environ.get("ARDRONE_VSLAM_DATA"):
            self.skipTest("ARDRONE_VSLAM_DATA is not set, so there are no real pictures")
        with tempfile.TemporaryDirectory() as out:
            self.assertIn("graf", run_quick(self, out, "--sections", *WITH_PICTURES))


if __name__ == "__main__":
    unittest.main()
