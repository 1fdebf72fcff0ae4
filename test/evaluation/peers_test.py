# SPDX-License-Identifier: BSD-3-Clause
"""Published trajectories of KITTI 00 give the published numbers, to all printed digits."""

import json
import os
import tempfile
import unittest

from paths import evaluate

DATA = os.environ.get("ARDRONE_VSLAM_DATA")


@unittest.skipUnless(DATA, "ARDRONE_VSLAM_DATA is not set: the published numbers are not checked")
class PeersTest(unittest.TestCase):
    def numbers(self, peer, align):
        folder = os.path.join(DATA, "kitti_00_poses")
        with tempfile.TemporaryDirectory() as out:
            answer = evaluate("--truth", f"{folder}/poses.txt", "--estimate", f"{folder}/{peer}", "--align", align,
                              "--json", f"{out}/numbers.json")
            self.assertEqual(answer[0], 0, answer[2])
            with open(f"{out}/numbers.json") as file:
                return json.load(file)["trajectories"][0], answer[1]

    def check(self, peer, t_rel, r_rel, se3, sim3):
        rigid, table = self.numbers(peer, "se3")
        self.assertEqual(f"{rigid['t_rel_percent']:.3f}", t_rel)
        self.assertEqual(f"{rigid['r_rel_deg_per_m']:.5f}", r_rel)
        self.assertEqual(f"{rigid['ate']['se3']['rmse_m']:.3f}", se3)
        self.assertEqual(rigid["matched"], 4541)
        for printed in (t_rel, r_rel, se3):
            self.assertIn(printed, table)
        self.assertEqual(f"{self.numbers(peer, 'sim3')[0]['ate']['sim3']['rmse_m']:.3f}", sim3)

    def test_orb_slam2_stereo(self):
        self.check("peer_orb_slam2_stereo.txt", "0.700", "0.00253", "1.303", "0.938")

    def test_s_ptam(self):
        self.check("peer_s_ptam.txt", "1.487", "0.00558", "3.738", "3.635")


if __name__ == "__main__":
    unittest.main()
