#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""While a bag is played, threads of tracker and mapper hardly ever wait for each other: locks are held for a few instructions."""
import os
import struct
import sys
import unittest

import rosbag
import rospy
import rostest
from geometry_msgs.msg import PoseWithCovarianceStamped

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder, play  # noqa: E402

PLAY_TIMEOUT_S = 60
MOST_WAITS = 0.01  # of all locks; measured: 1 of 12,551 beside six busy programs


def report():
    """Locks, waits, the longest wait [ns]: struct Report of lock_hook.cpp."""
    with open(rospy.get_param("~report"), "rb") as file:
        return struct.unpack("3q", file.read())


class LockWaits(unittest.TestCase):
    def test_hardly_any(self):
        rospy.init_node("lock_waits_test")
        with rosbag.Bag(rospy.get_param("~bag")) as bag:
            images = bag.get_message_count("/camera/camera_info")
        poses = Recorder("/vslam/pose", PoseWithCovarianceStamped)
        play([poses])  # once the manager runs, and with it the hook
        before = report()[0]
        self.assertIsNotNone(poses.wait(lambda _: len(poses.all()) >= images - 2, PLAY_TIMEOUT_S))
        locks, waits, longest_ns = report()
        print(f"{images} images, {locks} locks, {waits} of them waited, {longest_ns / 1e6} ms at most")
        self.assertGreater(locks, before + images, "the manager does not run under the hook")
        self.assertLessEqual(waits, MOST_WAITS * locks)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "lock_waits", LockWaits)
