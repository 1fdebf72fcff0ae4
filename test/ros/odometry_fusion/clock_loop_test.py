#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A bag that plays in a loop sets /clock back: each round gives poses again within a second of its
own time, the map begins anew, and it is said."""
import os
import sys
import time
import unittest

import rospy
import rostest
from ardrone_vslam.msg import Status
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock, Log

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder  # noqa: E402

TIMEOUT_S = 80


def rounds(messages, stamp_of):
    """Their stamps [s], split where they go back."""
    split = []
    for message in messages:
        stamp = stamp_of(message).to_sec()
        if not split or stamp < split[-1][-1] - 1:
            split.append([])
        split[-1].append(stamp)
    return split


class ClockLoop(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("clock_loop_test")
        cls.clock = Recorder("/clock", Clock)
        cls.pose = Recorder("/vslam/pose", PoseWithCovarianceStamped)
        cls.live = Recorder("/vslam/odometry_live", Odometry)
        cls.status = Recorder("/vslam/status", Status)
        cls.log = Recorder("/rosout", Log)
        cls.status.wait(lambda s: s.restarts >= 2, TIMEOUT_S)
        # A pose of the third round, so that the second one is whole. The first images of a round have none: three that agree begin it.
        end_s = time.monotonic() + TIMEOUT_S
        while len(rounds(cls.pose.all(), lambda p: p.header.stamp)) < 3 and time.monotonic() < end_s:
            time.sleep(0.05)

    def test_each_round_gives_poses_again(self):
        begin = rounds(self.clock.all(), lambda c: c.clock)[0][0]
        for recorder, fewest in [(self.pose, 15), (self.live, 100)]:
            split = rounds(recorder.all(), lambda m: m.header.stamp)
            self.assertGreaterEqual(len(split), 2)
            for stamps in split[:2]:
                self.assertLess(stamps[0], begin + 1)
                self.assertGreater(len(stamps), fewest)
                self.assertEqual(stamps, sorted(stamps))

    def test_the_map_begins_anew_once_a_round(self):
        restarts = [s.restarts for s in self.status.all()]
        self.assertEqual(restarts, sorted(restarts))
        self.assertEqual(restarts[-1], len(rounds(self.pose.all(), lambda p: p.header.stamp)) - 1)
        self.assertIsNotNone(self.log.wait(
            lambda entry: "jumped back" in entry.msg and "the map begins anew" in entry.msg))

    def test_nothing_complains_of_old_transforms(self):
        self.assertEqual([e.msg for e in self.log.all() if "TF_OLD_DATA" in e.msg], [])


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "clock_loop", ClockLoop)
