#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The standalone executables give the same poses as the nodelets: they answer every image."""
import os
import sys
import unittest

import rospy
import rostest
from ardrone_vslam.msg import Status

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Drone  # noqa: E402

IMAGES = 30


class Standalone(unittest.TestCase):
    def test_every_image_is_answered(self):
        rospy.init_node("standalone_test")
        drone = Drone()
        drone.connect()
        drone.mount_camera()
        poses = drone.fly(IMAGES)
        self.assertEqual(len(poses), IMAGES)
        self.assertIsNotNone(poses[-1])
        # The parameter given in the launch file reached the tracker.
        statuses = [s for s in drone.status.all() if s.images > 0]
        self.assertLessEqual(max(s.features for s in statuses), 200)
        self.assertGreater(max(s.features for s in statuses), 100)
        # The default estimator: too short a flight to come back to anything.
        self.assertEqual(statuses[-1].state, Status.TRACKING)
        self.assertGreater(statuses[-1].landmarks, 0)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "standalone", Standalone)
