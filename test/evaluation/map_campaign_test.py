# SPDX-License-Identifier: BSD-3-Clause
"""A little of scripts/map_campaign: flights are found in the maps of their own rooms, and in no other one's."""
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


if __name__ == "__main__":
    unittest.main()
