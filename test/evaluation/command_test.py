# SPDX-License-Identifier: BSD-3-Clause
"""The command on files: what it writes, and what it says about bad input."""

import dataclasses
import json
import os
import tempfile
import unittest

import numpy as np

from paths import evaluate, straight, winding, write_kitti, write_tum

from ardrone_vslam_evaluation.evaluation import Row
from ardrone_vslam_evaluation.plot_paths import draw_heights

NO_TRACE = "Traceback"


class HeightsTest(unittest.TestCase):
    def test_upwards_is_z_and_of_a_camera_minus_y(self):
        path = winding(50)
        for trajectory, up_m in ((path, path.positions_m[:, 2]), (dataclasses.replace(path, is_camera=True), -path.positions_m[:, 1])):
            (axes,) = draw_heights([Row("one", "estimate", None, trajectory)]).axes
            seconds, height_m = axes.lines[0].get_data()
            np.testing.assert_array_equal(height_m, up_m)
            np.testing.assert_allclose(seconds, 0.1 * np.arange(50))


class CommandTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def text(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return self.path(name)

    def numbers(self, *arguments):
        code, out, fault = evaluate(*arguments, "--json", self.path("numbers.json"))
        self.assertEqual(code, 0, out + fault)
        with open(self.path("numbers.json")) as file:
            return json.load(file)["trajectories"], fault

    def refused(self, *arguments, parts=(), code=2):
        answer = evaluate(*arguments)
        self.assertEqual(answer[0], code, answer)
        self.assertNotIn(NO_TRACE, answer[2])
        for part in parts:
            self.assertIn(part, answer[2])

    def test_tum_and_kitti_give_the_same(self):
        truth = winding(400)
        estimate = dataclasses.replace(truth, positions_m=1.01 * truth.positions_m)
        tum, _ = self.numbers("--truth", write_tum(self.path("t.tum"), truth), "--estimate", write_tum(self.path("e.tum"), estimate))
        self.text("stamps", "".join(f"{stamp / 1e9:.6e}\n" for stamp in truth.stamps_ns))
        kitti, _ = self.numbers("--truth", write_kitti(self.path("t.txt"), truth), "--estimate",
                                write_kitti(self.path("e.txt"), estimate), "--times", self.path("stamps"))
        for key in ("t_rel_percent", "r_rel_deg_per_m"):
            self.assertAlmostEqual(tum[0][key], kitti[0][key], places=6)
        self.assertAlmostEqual(tum[0]["ate"]["se3"]["rmse_m"], kitti[0]["ate"]["se3"]["rmse_m"], places=6)
        self.assertAlmostEqual(tum[0]["rpe_1s"]["translation_rmse_m"], kitti[0]["rpe_1s"]["translation_rmse_m"], places=6)

    def test_kitti_without_times_has_no_error_over_time_and_says_so(self):
        truth = write_kitti(self.path("t.txt"), winding(50))
        rows, told = self.numbers("--truth", truth, "--estimate", truth)
        self.assertIsNone(rows[0]["rpe_1s"])
        self.assertIn("--times", told)

    def test_observer_gives_the_ratios(self):
        truth = straight(100, 201)
        odometry = dataclasses.replace(truth, positions_m=1.02 * truth.positions_m)
        fused = dataclasses.replace(truth, positions_m=1.01 * truth.positions_m)
        files = [write_tum(self.path(name), path) for name, path in (("truth", truth), ("fused", fused), ("odom", odometry))]
        rows, _ = self.numbers("--truth", files[0], "--estimate", files[1], "--odometry", files[2], "--odometry-scale-error", 0.015)
        self.assertEqual([row["kind"] for row in rows], ["odometry", "estimate"])
        self.assertAlmostEqual(rows[1]["ratio"], 0.5, places=6)
        self.assertAlmostEqual(rows[1]["ratio_scale_removed"], 1.0, places=5)

    def test_old_options_are_refused_with_their_new_names(self):
        for rest in ("", "-topic", "-scale-error"):
            code, _, told = evaluate("--truth", "t", "--estimate", "e", f"--observer{rest}", "o")
            self.assertEqual(code, 2)
            self.assertIn(f"--observer{rest} is called --odometry{rest} now", told)

    def test_unmatched_poses_are_told(self):
        truth = straight(10, 101)
        files = write_tum(self.path("t"), truth), write_tum(self.path("e"), truth.at(np.arange(50, 101)))
        late = dataclasses.replace(truth.at(np.arange(50, 101)), stamps_ns=truth.stamps_ns[50:] + 1_000_000_000)
        self.assertIn("0 of 51 poses have no truth", self.numbers("--truth", files[0], "--estimate", files[1])[1])
        rows, told = self.numbers("--truth", files[0], "--estimate", write_tum(self.path("l"), late), "--align", "none")
        self.assertIn("10 of 51 poses have no truth within 0.02 s", told)
        self.assertEqual(rows[0]["matched"], 41)

    def test_the_page_needs_nothing_else_and_is_the_same_again(self):
        truth = write_tum(self.path("truth"), winding(300))
        estimate = write_tum(self.path("one & <two>"), winding(300))
        pages = []
        for name in ("a.html", "b.html"):
            code, _, fault = evaluate("--truth", truth, "--estimate", estimate, "--html", self.path(name), "--figures", self.path("png"))
            self.assertEqual(code, 0, fault)
            with open(self.path(name)) as file:
                pages.append(file.read())
        self.assertEqual(pages[0], pages[1])
        for forbidden in ("http:", "https:", "<script", "<link", "one & <two>"):
            self.assertNotIn(forbidden, pages[0])
        self.assertEqual(pages[0].count("<img "), 4)
        self.assertIn("Left out: only folders that replay or record_run wrote hold it", pages[0])
        self.assertEqual(sorted(os.listdir(self.path("png"))), ["error_over_length.png", "error_over_time.png", "heights.png", "trajectories.png"])

    def test_lines_that_cannot_be_are_named(self):
        good = write_tum(self.path("good"), straight(10, 11))
        line = "0 0 0 0 0 0 0 1\n"
        for text, where, what in ((line + "1 0 0 0 0 0 0\n", ":2", "7 values where 8"), ("# a\n\nx 0 0 0 0 0 0 1\n", ":3", "'x' is no number"),
                                  (line + line, ":2", "does not come after"), ("0 0 0 0 0 0 0 2\n", ":1", "norm is 2"),
                                  ("0 nan 0 0 0 0 0 1\n", ":1", "not finite"), ("0 1e999 0 0 0 0 0 1\n", ":1", "not finite"),
                                  ("1 2 3\n", ":1", "3 values"), ("# nothing\n", "", "holds no pose"),
                                  ("1 0 0 0 0 1 0 0 0 0 2 0\n", ":1", "no rotation"), ("1 0 0 0 0 1 0 0 0 0 1 0\n" + line, ":2", "12 are expected")):
            bad = self.text("bad", text)
            for files in (("--truth", bad, "--estimate", good), ("--truth", good, "--estimate", bad)):
                self.refused(*files, parts=[f"evaluate: {bad}{where}: ", what])

    def test_files_that_cannot_be_are_named(self):
        good, none = write_tum(self.path("good"), straight(10, 11)), self.path("none")
        self.refused("--truth", good, "--estimate", none, parts=[none, "No such file", "check the path"])
        self.refused("--truth", self.folder, "--estimate", good, parts=[self.folder, "is a folder"])
        with open(self.path("picture"), "wb") as file:
            file.write(b"\x89PNG\xff\xfe\x00")
        self.refused("--truth", good, "--estimate", self.path("picture"), parts=["picture", "no text"])
        self.refused(none, parts=[none, "no such folder"])
        self.refused(self.folder, parts=[self.folder, "no fused.tum", "replay"])
        self.refused(good, parts=[good, "is a file", "--truth"])
        kitti = write_kitti(self.path("kitti"), straight(10, 11))
        self.refused("--truth", good, "--estimate", kitti, parts=[kitti, "no stamps", "--times"])
        self.refused("--truth", kitti, "--estimate", write_kitti(self.path("short"), straight(10, 9)), parts=["short: 9 poses for the 11"])
        times = self.text("times", "0\n1\n")
        self.refused("--truth", kitti, "--estimate", kitti, "--times", times, parts=["11 poses for the 2 stamps", times])
        self.refused("--truth", good, "--estimate", good, "--html", self.path("none/a.html"), parts=["none/a.html", "cannot be written"], code=1)

    def test_wrong_usage_is_told(self):
        good = write_tum(self.path("good"), straight(10, 11))
        for arguments, part in (((), "what shall be evaluated"), ((self.folder, "--truth", good), "either folders"),
                                (("--truth", good, "--estimate", good, "--align", "scale"), "invalid choice"),
                                (("--truth", good, "--estimate", good, "--max-difference", "-1"), "must be above 0"),
                                (("--truth", good, "--estimate", good, "--name", "a", "b"), "2 names for 1"),
                                (("--truth", good, "--estimate", good, "--odometry-scale-error", "0.1"), "--odometry")):
            self.refused(*arguments, parts=[part])


if __name__ == "__main__":
    unittest.main()
