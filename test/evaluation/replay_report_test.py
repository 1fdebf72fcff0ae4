# SPDX-License-Identifier: BSD-3-Clause
"""replay --report."""

import json
import os
import subprocess
import tempfile
import unittest

REPLAY, MAKE_WORLD = os.environ.get("ARDRONE_VSLAM_REPLAY", ""), os.environ.get("ARDRONE_VSLAM_MAKE_WORLD", "")  # ctest sets them


class ReplayReportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = os.path.join(cls.temporary.name, "a flight")
        subprocess.run([MAKE_WORLD, "laps", "--seconds", "1.5", "--rate", "20", "--out", cls.folder], check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def replay(self, out, *options, **environment):
        done = subprocess.run([REPLAY, self.folder, "--odometry-profile", "drone", "--out", out, *options], capture_output=True, text=True,
                              check=False, env={**os.environ, **environment})
        return done.returncode, done.stdout, done.stderr

    def test_report_is_written_and_removed_with_the_run(self):
        out = os.path.join(self.temporary.name, "a run")
        code, told, fault = self.replay(out, "--report")
        self.assertEqual(code, 0, fault)
        self.assertIn(f"written: {out}/report.html", told)
        with open(f"{out}/evaluation.json") as file, open(f"{out}/summary.json") as summary:
            fused = json.load(file)["trajectories"][1]
            self.assertAlmostEqual(fused["ate"]["none"]["rmse_m"], json.load(summary)["fused_ate_rmse_m"], places=7)
        self.assertEqual(self.replay(out)[0], 0)
        self.assertFalse(os.path.exists(f"{out}/report.html"), "the report of an earlier run")
        self.assertFalse(os.path.exists(f"{out}/evaluation.json"))

    def test_several_seeds_have_one_report(self):
        out = os.path.join(self.temporary.name, "seeds")
        code, told, fault = self.replay(out, "--seeds", "1:2", "--report")
        self.assertEqual(code, 0, fault)
        self.assertIn("median of 2: msckf", told)
        self.assertTrue(os.path.exists(f"{out}/report.html"))

    def test_without_matplotlib_the_run_is_kept_and_the_cause_told(self):
        blocked = os.path.join(self.temporary.name, "blocked")
        os.makedirs(blocked, exist_ok=True)
        with open(f"{blocked}/matplotlib.py", "w") as file:
            file.write("raise ImportError('No module named matplotlib')\n")
        out = os.path.join(self.temporary.name, "no_plots")
        code, told, fault = self.replay(out, "--report", PYTHONPATH=blocked)
        self.assertEqual(code, 1)
        for part in ("python3-matplotlib", "scripts/install_dependencies", "replay: no report", "the run itself is written"):
            self.assertIn(part, fault)
        self.assertNotIn("Traceback", fault)
        self.assertIn("Position error", told)
        self.assertTrue(os.path.exists(f"{out}/summary.json"))
        self.assertTrue(os.path.exists(f"{out}/evaluation.json"))
        self.assertFalse(os.path.exists(f"{out}/report.html"))


if __name__ == "__main__":
    unittest.main()
