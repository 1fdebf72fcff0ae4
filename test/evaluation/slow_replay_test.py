# SPDX-License-Identifier: BSD-3-Clause
"""replay --image-ms and --cpu-factor, and what evaluate draws of such runs."""

import json
import os
import subprocess
import unittest

from paths import TestWithFolder, evaluate

REPLAY, MAKE_WORLD = os.environ.get("ARDRONE_VSLAM_REPLAY", ""), os.environ.get("ARDRONE_VSLAM_MAKE_WORLD", "")  # ctest sets them
FRAMES = 40  # 2 s at 20 Hz


class SlowReplayTest(TestWithFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.flight = cls.path("flight")
        subprocess.run([MAKE_WORLD, "laps", "--seconds", "2", "--rate", "20", "--out", cls.flight], check=True, capture_output=True)

    def replay(self, out, *options):
        done = subprocess.run([REPLAY, self.flight, "--odometry-profile", "drone", "--out", self.path(out), *options], capture_output=True, text=True,
                              check=False)
        return done.returncode, done.stdout, done.stderr

    def summary(self, out, *options):
        code, told, fault = self.replay(out, *options)
        self.assertEqual(code, 0, fault)
        with open(f"{self.path(out)}/summary.json") as file:
            return json.load(file), told

    def test_dropped_images_are_counted_and_shown(self):
        summary, told = self.summary("whole")
        self.assertEqual((summary["frames"], summary["frames_dropped_slow"]), (FRAMES, 0))
        summary, told = self.summary("slow", "--image-ms", "100")
        self.assertEqual((summary["frames"], summary["frames_dropped_slow"]), (21, 19))  # every other one, and the last
        self.assertIn("m travelled; 19 dropped as too slow\n", told)
        self.assertEqual(self.summary("slower", "--image-ms", "100", "--cpu-factor", "4")[0]["frames"], 6)

    def test_seeds_share_what_is_dropped(self):
        summary, told = self.summary("seeds", "--image-ms", "100", "--seeds", "1:2")
        self.assertEqual([run["frames_dropped_slow"] for run in summary["runs"]], [19, 19])
        self.assertIn("frames: 21, and 19 dropped as too slow", told)

    def test_what_there_was_no_time_for_is_counted(self):
        summary, _ = self.summary("hasty", "--set", "frame_budget_ms=0.001")
        self.assertEqual(summary["left_out"]["keyframe"], FRAMES)  # one is due at each: none was ever taken
        self.assertEqual(summary["landmarks"], 0)
        summary, _ = self.summary("patient", "--set", "frame_budget_ms=10000")
        self.assertEqual(summary["left_out"], {"place_search": 0, "landmarks": 0, "keyframe": 0})

    def test_wrong_usage_is_told(self):
        for options, part in ((("--cpu-factor", "2", "--seeds", "1:2"), "--cpu-factor: what an image takes differs from seed to seed"),
                              (("--image-ms", "-1"), "--image-ms"), (("--cpu-factor", "fast"), "--cpu-factor")):
            code, _, fault = self.replay("refused", *options)
            self.assertEqual(code, 2, fault)
            self.assertIn(part, fault)

    def test_accuracy_against_rate_is_drawn_of_runs_that_differ_in_it(self):
        self.summary("fast_1", "--seeds", "1:2")
        self.summary("slow_1", "--image-ms", "200", "--seeds", "1:2")
        code, _, fault = evaluate(self.path("fast_1"), self.path("slow_1"), "--figures", self.path("figures"))
        self.assertEqual(code, 0, fault)
        self.assertTrue(os.path.exists(f"{self.path('figures')}/error_against_rate.png"))
        code, _, fault = evaluate(self.path("fast_1"), "--table", "--figures", self.path("of_one"))
        self.assertEqual(code, 0, fault)
        self.assertFalse(os.path.exists(f"{self.path('of_one')}/error_against_rate.png"))

    def test_runs_are_sorted_by_the_images_they_used(self):
        from ardrone_vslam_evaluation.evaluation import Row, Settings, evaluate_row
        from ardrone_vslam_evaluation.plot_rates import errors_by_rate
        from ardrone_vslam_evaluation.run_folder import read_run
        self.summary("a")
        self.summary("b", "--image-ms", "450")  # 0, 0.45, 0.9, 1.35, 1.8 and the last
        rows = []
        for name in ("a", "b"):
            run = read_run(self.path(name))
            rows.append(Row(name, "estimate", run.truth, run.fused, run))
            evaluate_row(rows[-1], Settings(align="none", interpolate=True))
            rows[-1].numbers["estimator"] = run.summary["estimator"]
        by_rate = errors_by_rate(rows)
        self.assertEqual(list(by_rate), ["msckf"])
        self.assertEqual(list(by_rate["msckf"]), [20.0, 2.56])
        for rate_hz, row in zip((20.0, 2.56), rows):
            self.assertEqual(by_rate["msckf"][rate_hz], [row.numbers["ate"]["none"]["rmse_m"]])


if __name__ == "__main__":
    unittest.main()
