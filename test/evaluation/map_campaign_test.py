# SPDX-License-Identifier: BSD-3-Clause
"""A little of scripts/map_campaign and map_again: flights are found in the maps of their own rooms, and in no other one's."""
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

from paths import TestWithFolder

PROGRAMS = os.path.dirname(os.environ["ARDRONE_VSLAM_REPLAY"])
CAMPAIGN = Path(__file__).resolve().parent.parent / "campaign" / "map_campaign.py"


HELP = subprocess.run([os.environ["ARDRONE_VSLAM_REPLAY"], "--help"], capture_output=True, text=True, check=False).stdout


@unittest.skipUnless("--refine" in HELP, "built without Ceres")
class MapCampaign(TestWithFolder):
    def test_flights_are_found_in_their_own_rooms(self):
        done = subprocess.run([sys.executable, "-B", CAMPAIGN, "--programs", PROGRAMS, "--work", self.path("work"), "--json", self.path("tries.json"),
                               "--starts", "2", "--rooms", "2", "--starts-in-each", "1", "--carries", "1", "--jobs", "2"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("found in the map of their own room 2 of 2; at a wrong place, or in the map of another room, 0 of 4", done.stdout)
        self.assertIn("Carried elsewhere with the camera covered: found 1 of 1", done.stdout)
        with open(self.path("tries.json"), encoding="utf-8") as file:
            one_room = json.load(file)["one room"]
        self.assertEqual(set(one_room), {"first", "first_refined"})
        for tries in one_room.values():
            self.assertNotIn(None, tries)
            for one in tries:
                self.assertLess(one["found_s"], 6)
                self.assertLess(one["error_m"], 0.3)
                self.assertLess(one["error_in_map_m"], 0.1)

    def test_flights_again_in_the_maps_of_others(self):
        made = subprocess.run([f"{PROGRAMS}/make_world", "laps", "--seconds", "12", "--rate", "10", "--out", self.path("laps")],
                              capture_output=True, text=True, check=False)
        self.assertEqual(made.returncode, 0, made.stderr)
        done = subprocess.run([sys.executable, "-B", CAMPAIGN.with_name("map_again.py"), self.path("laps"), "--programs", PROGRAMS,
                               "--work", self.path("again"), "--json", self.path("again.json"), "--seeds", "0:1", "--jobs", "2",
                               "--", "--set", "features_per_frame=200"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(self.path("again.json"), encoding="utf-8") as file:
            tries = json.load(file)
        self.assertEqual(len(tries), 2)
        for one in tries:
            for kind in ("flown", "refined"):
                again, = one[kind]
                self.assertLess(again["map_found_s"], 6)
                self.assertLess(again["map_scale_removed_m"], 0.3)
                self.assertNotEqual(again["map_scale_removed_m"], again["fused_ate_rmse_m"])


if __name__ == "__main__":
    unittest.main()
