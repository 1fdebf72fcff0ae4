# SPDX-License-Identifier: BSD-3-Clause
"""map_tool with the maps of two rendered flights: what it tells, makes and refuses. A later flight finds itself in the merged map."""
import csv
import json
import os
import shutil
import subprocess
import unittest

from ardrone_vslam_evaluation.plot_paths import in_map
from ardrone_vslam_evaluation.run_folder import read_run
from paths import TestWithFolder

MAP_TOOL, REPLAY, MAKE_WORLD = (os.environ["ARDRONE_VSLAM_" + name] for name in ("MAP_TOOL", "REPLAY", "MAKE_WORLD"))


def call(*command):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)


class MapTool(TestWithFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.make(MAKE_WORLD, "laps", "--seconds", 42, "--rate", 10, "--out", cls.path("laps"), "--seed", 1)
        cls.fly("first", "0:250", 1)
        cls.fly("second", "250:420", 2, "--odometry-at-zero")

    @classmethod
    def make(cls, *command):
        done = call(*command)
        if done.returncode:
            raise RuntimeError(f"{command}: {done.stdout}{done.stderr}")
        return done.stdout

    @classmethod
    def fly(cls, name, frames, seed, *options):
        cls.make(REPLAY, cls.path("laps"), "--frames", frames, "--odometry-profile", "drone", "--seed", seed, "--save-map", cls.path(name + ".vmap"),
                 "--out", cls.path(name), *options)

    def told(self, *command):
        return self.make(MAP_TOOL, *command)

    def refused(self, exit_code, sentence, *command):
        done = call(MAP_TOOL, *command)
        self.assertEqual(done.returncode, exit_code, done.stdout + done.stderr)
        self.assertIn(sentence, done.stderr)

    def facts(self, name):
        return json.loads(self.told("info", self.path(name), "--json"))

    def test_info_and_verify(self):
        facts = self.facts("first.vmap")
        self.assertGreater(facts["landmarks"], 200)
        self.assertEqual(facts["cameras"][0]["width_px"], 640)
        self.assertLess(facts["anchor_sigma_m"]["90 %"], 1)
        self.assertIn(f"landmarks: {facts['landmarks']}\n", self.told("info", self.path("first.vmap")))
        self.assertIn("sound", self.told("verify", self.path("first.vmap")))

    def test_damage_is_named(self):
        with open(self.path("first.vmap"), "rb") as file:
            data = bytearray(file.read())
        data[len(data) // 2] ^= 1
        with open(self.path("damaged.vmap"), "wb") as file:
            file.write(data)
        self.refused(1, "damaged.vmap: ", "verify", self.path("damaged.vmap"))
        self.refused(1, "none.vmap: ", "info", self.path("none.vmap"))

    def test_parts(self):
        count = self.facts("first.vmap")["landmarks"]
        self.told("prune", self.path("first.vmap"), "--most", 100, "--least-seen", 3, "--out", self.path("pruned.vmap"))
        self.assertEqual(self.facts("pruned.vmap")["landmarks"], 100)
        self.told("crop", self.path("first.vmap"), "--from", 0, -100, -100, "--to", 100, 100, 100, "--out", self.path("cropped.vmap"))
        cropped = self.facts("cropped.vmap")
        self.assertGreater(cropped["from_m"][0], 0)
        self.assertTrue(0 < cropped["landmarks"] < count)
        self.refused(1, "no landmark is left", "crop", self.path("first.vmap"), "--from", 90, 90, 90, "--to", 91, 91, 91, "--out", self.path("no.vmap"))
        self.refused(2, "--from must be less", "crop", self.path("first.vmap"), "--from", 1, 1, 1, "--to", 1, 2, 2, "--out", self.path("no.vmap"))
        self.assertFalse(os.path.exists(self.path("no.vmap")))

    def test_refine(self):
        self.assertGreater(self.facts("first.vmap")["keyframes"], 20)  # 46
        told = self.told("refine", self.path("first.vmap"), "--out", self.path("refined.vmap"))
        self.assertRegex(told, r"(?s)keyframes, \d+ points, \d+ views; .*half of the landmarks moved by more than 0\.\d+ m\n")
        # As of replay, which has the numbers that a file has as floats and ids of its own.
        self.fly("as_flown", "0:250", 1, "--refine")
        self.assertEqual(self.facts("as_flown.vmap")["keyframes"], 0)
        for name in ("refined", "as_flown"):
            self.told("export", self.path(name + ".vmap"), "--out", self.path(name + ".csv"))
        places = [self.places(name + ".csv") for name in ("refined", "as_flown")]
        self.assertEqual(len(places[0]), len(places[1]))
        for one, other in zip(*places):
            self.assertLess(max(abs(a - b) for a, b in zip(one, other)), 0.002)
        for name in ("refined.vmap", "second_part.vmap"):
            if name == "second_part.vmap":
                self.told("prune", self.path("first.vmap"), "--least-seen", 3, "--out", self.path(name))
            self.refused(1, "there are no views in it", "refine", self.path(name), "--out", self.path("no.vmap"))

    def places(self, name):
        with open(self.path(name)) as file:
            return [[float(row[axis]) for axis in ("x_m", "y_m", "z_m")] for row in csv.DictReader(file)]

    def test_replay_leaves_a_map_where_it_has_none(self):
        with open(self.path("first.vmap"), "rb") as file:
            before = file.read()
        for frames, name, sentence in (("0:10", "first.vmap", "has no landmark, so no map is written"), ("0:250", "none/x.vmap", "cannot be written")):
            done = call(REPLAY, self.path("laps"), "--frames", frames, "--odometry-profile", "drone", "--save-map", self.path(name), "--out", self.path("short"))
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(os.path.exists(self.path("short/summary.json")), frames == "0:10", "told before the flight")
            shutil.rmtree(self.path("short"), ignore_errors=True)
        with open(self.path("first.vmap"), "rb") as file:
            self.assertEqual(file.read(), before)

    def test_a_map_too_large_is_refused_whole(self):
        done = call(REPLAY, self.path("laps"), "--frames", "250:420", "--odometry-profile", "drone", "--map", self.path("first.vmap"), "--set",
                    "mapper/max_landmarks=100", "--out", self.path("short"))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("max_landmarks (or max_map_mb) allows 100", done.stderr)

    def test_export(self):
        count = self.facts("first.vmap")["landmarks"]
        for name, lines in (("map.csv", count + 1), ("map.ply", count + 9)):
            self.told("export", self.path("first.vmap"), "--out", self.path(name))
            with open(self.path(name)) as file:
                self.assertEqual(len(file.readlines()), lines)
        self.refused(2, "must end in .ply or .csv", "export", self.path("first.vmap"), "--out", self.path("map.obj"))

    def test_a_later_flight_is_found_in_the_merged_map(self):
        told = self.told("merge", self.path("first.vmap"), self.path("second.vmap"), "--out", self.path("both.vmap"))
        self.assertIn("lie in one place", told)
        parts = [self.facts(name)["landmarks"] for name in ("first.vmap", "second.vmap", "both.vmap")]
        self.assertTrue(max(parts[:2]) < parts[2] < sum(parts[:2]), parts)
        self.make(REPLAY, self.path("laps"), "--frames", "40:420", "--odometry-profile", "drone", "--seed", 3, "--odometry-at-zero",
                  "--localise-only", "--map", self.path("both.vmap"), "--out", self.path("third"))
        with open(os.path.join(self.path("third"), "summary.json")) as file:
            summary = json.load(file)
        self.assertLess(summary["map_found_s"], 5)
        run = read_run(self.path("third"))
        drawn = in_map(run)
        self.assertAlmostEqual((drawn.stamps_ns[0] - run.fused.stamps_ns[0]) * 1e-9, summary["map_found_s"], places=6)
        self.assertEqual(drawn.stamps_ns[-1], run.fused.stamps_ns[-1])

    def test_another_place_is_not_merged(self):
        self.make(MAKE_WORLD, "corridor", "--seconds", 10, "--rate", 10, "--out", self.path("corridor"), "--seed", 1)
        self.make(REPLAY, self.path("corridor"), "--odometry-profile", "drone", "--seed", 1, "--save-map", self.path("corridor.vmap"), "--out", self.path("run"))
        self.refused(1, "not of one place", "merge", self.path("first.vmap"), self.path("corridor.vmap"), "--out", self.path("no.vmap"))
        self.assertFalse(os.path.exists(self.path("no.vmap")))

    def test_a_map_is_not_merged_with_itself(self):
        self.refused(1, "one was made from the other", "merge", self.path("first.vmap"), self.path("first.vmap"), "--out", self.path("no.vmap"))
        self.make(REPLAY, self.path("laps"), "--frames", "100:300", "--odometry-profile", "drone", "--seed", 4, "--odometry-at-zero", "--map",
                  self.path("first.vmap"), "--save-map", self.path("later.vmap"), "--out", self.path("run"))
        self.refused(1, "one was made from the other", "merge", self.path("first.vmap"), self.path("later.vmap"), "--out", self.path("no.vmap"))

    def test_maps_of_two_cameras_are_not_merged(self):
        self.make(MAKE_WORLD, "laps", "--seconds", 10, "--rate", 10, "--camera", "bottom", "--out", self.path("below"), "--seed", 1)
        self.make(REPLAY, self.path("below"), "--odometry-profile", "drone", "--seed", 1, "--save-map", self.path("below.vmap"), "--out", self.path("run"))
        self.refused(1, "of two cameras", "merge", self.path("first.vmap"), self.path("below.vmap"), "--out", self.path("no.vmap"))

    def test_wrong_usage(self):
        self.refused(2, "subcommand", self.path("first.vmap"))
        self.refused(2, "--out", "prune", self.path("first.vmap"))
        for command in (("refine",), ("prune",), ("crop", "--from", -1, -1, -1, "--to", 1, 1, 1), ("merge", self.path("second.vmap"))):
            self.refused(2, "is the map that is read", command[0], self.path("first.vmap"), *command[1:], "--out", self.path("first.vmap"))
        self.assertGreater(self.facts("first.vmap")["keyframes"], 20, "views are lost")
        self.refused(2, "--most", "prune", self.path("first.vmap"), "--most", 0, "--out", self.path("no.vmap"))
        self.refused(2, "--most-sigma-m", "prune", self.path("first.vmap"), "--most-sigma-m", "nan", "--out", self.path("no.vmap"))


if __name__ == "__main__":
    unittest.main()
