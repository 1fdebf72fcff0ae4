# SPDX-License-Identifier: BSD-3-Clause
"""A replay that is killed leaves what it had, and says so; summaries that cannot be read are named."""

import json
import os
import subprocess
import tempfile
import time
import unittest

from paths import evaluate, straight, write_tum

REPLAY, MAKE_WORLD = os.environ.get("ARDRONE_VSLAM_REPLAY", ""), os.environ.get("ARDRONE_VSLAM_MAKE_WORLD", "")  # ctest sets them
PATIENCE_S = 120


class UnfinishedRunTest(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)

    def path(self, name):
        return os.path.join(self.temporary.name, name)

    def text(self, name, what):
        with open(self.path(name), "w", encoding="latin-1") as file:
            file.write(what)

    def killed(self, out, seeds):
        """Runs of so many seeds, killed once the last one has written for the first time. @return whether it came to that"""
        run = subprocess.Popen([REPLAY, self.path("flight"), "--odometry-profile", "drone", "--out", out, "--threads", "1", "--seeds", f"1:{seeds}"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end_s = time.monotonic() + PATIENCE_S
        while not os.path.exists(f"{out}/seed_{seeds}/summary.json"):
            self.assertLess(time.monotonic(), end_s)
            time.sleep(0.02)
        run.kill()
        run.wait()
        with open(f"{out}/summary.json", encoding="utf-8") as file:
            return not json.load(file)["is_finished"]

    def test_a_killed_replay_leaves_what_it_had(self):
        subprocess.run([MAKE_WORLD, "laps", "--seconds", "20", "--rate", "15", "--out", self.path("flight")], check=True, capture_output=True)
        # What it has is written every two seconds: more seeds where a fast machine has flown them all by then.
        seeds = next((seeds for seeds in (30, 120, 480) if self.killed(self.path("run"), seeds)), None)
        self.assertIsNotNone(seeds, "all were flown within two seconds")
        with open(self.path("run") + "/summary.json", encoding="utf-8") as file:
            summary = json.load(file)
        self.assertEqual([run["is_finished"] for run in summary["runs"]], [False] * seeds)
        self.assertIs(summary["is_finished"], False)
        frames = summary["runs"][0]["frames"]
        self.assertGreater(frames, 0)
        self.assertLess(frames, 300)
        with open(self.path("run") + f"/seed_{seeds}/fused.tum", encoding="utf-8") as file:
            self.assertEqual(len(file.readlines()), 1 + frames)
        self.assertEqual([name for _, _, names in os.walk(self.path("run")) for name in names if name.endswith(".part")], [])
        code, _, told = evaluate(self.path("run") + "/seed_1", "--table")
        self.assertEqual(code, 0, told)
        self.assertIn("the run was interrupted", told)
        done = subprocess.run([REPLAY, self.path("flight"), "--odometry-profile", "drone", "--out", self.path("run"), "--frames", "0:5"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(os.listdir(self.path("run"))),
                         ["frames.csv", "fused.tum", "landmarks.csv", "odometry.tum", "summary.json", "truth.tum"])
        with open(self.path("run") + "/summary.json", encoding="utf-8") as file:
            self.assertTrue(json.load(file)["is_finished"])

    def test_summaries_that_cannot_be_are_named(self):
        write_tum(self.path("fused.tum"), straight(10, 11))
        for content, what in (("{\"a\": \"\xff\"}", "no text"), (100_000 * "[", "too deep"), ("{", "no JSON"), ("[]", "no JSON object")):
            self.text("summary.json", content)
            code, _, told = evaluate(self.temporary.name, "--table")
            self.assertNotEqual(code, 0)
            self.assertIn("summary.json", told)
            self.assertIn(what, told)
            self.assertNotIn("Traceback", told)

    def test_what_never_ends_is_no_file(self):
        write_tum(self.path("good"), straight(10, 11))
        os.mkfifo(self.path("pipe"))
        for path in (self.path("pipe"), "/dev/zero"):
            for files in (("--truth", path, "--estimate", self.path("good")), ("--truth", self.path("good"), "--estimate", path)):
                code, _, told = evaluate(*files)
                self.assertNotEqual(code, 0)
                self.assertIn(f"{path}: is no file but a folder, device or pipe", told)
