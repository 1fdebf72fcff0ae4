#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every image is of another camera than the one before: the newest is answered, and the log stays readable."""
import os
import sys
import time
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Drone  # noqa: E402

IMAGES = 150
PERIOD_S = 0.02
NODELETS = 2  # tracker and mapper
AT_ONCE, A_SECOND = 5, 5  # of EventLimiter, for each of them
CAMERAS = ("camera_optical", "other_optical")


class LogStorm(unittest.TestCase):
    def test_a_camera_that_changes_with_each_image(self):
        rospy.init_node("log_storm_test")
        drone = Drone(queue_size=None)
        drone.connect()
        for camera in CAMERAS:
            drone.mount_camera(camera=camera)
        drone.next()
        drone.send(drone.odometry(), drone.image(), drone.info())
        self.assertIsNotNone(drone.answered(drone.stamp()))
        began_s = time.monotonic()
        for i in range(1, IMAGES):
            drone.next()
            drone.camera = CAMERAS[i % 2]
            drone.send(drone.odometry(), drone.image(), drone.info())
            time.sleep(PERIOD_S)
        self.assertIsNotNone(drone.answered(drone.stamp()))
        seconds = time.monotonic() - began_s
        changes = drone.status.wait(lambda s: s.header.stamp == drone.stamp()).camera_changes
        lines = [log.msg for log in drone.log.all() if "camera changed" in log.msg or log.msg.startswith("frames: ")]
        print(f"{changes} camera changes in {seconds:.1f} s, {len(lines)} lines of them")
        self.assertGreater(changes, IMAGES / 3)
        self.assertTrue(lines)
        self.assertLessEqual(len(lines), NODELETS * (AT_ONCE + A_SECOND * seconds) + 1, lines[-5:])


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "log_storm", LogStorm)
