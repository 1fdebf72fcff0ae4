#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two drones side by side, told apart by namespace and tf_prefix: each gets its own poses, and tf
has a tree of each. The left one's images are raw, the right one's compressed."""
import os
import sys
import unittest

import rospy
import rostest
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Drone, Recorder  # noqa: E402

IMAGES = 20


class TwoDrones(unittest.TestCase):
    def test_side_by_side(self):
        rospy.init_node("two_drones_test")
        tf = Recorder("/tf", TFMessage)
        mountings = []
        drones = [Drone("/" + name, "/" + name + "/camera", "/" + name + "/odometry", name, seed,
                        direction, compressed, mountings=mountings)
                  for name, seed, direction, compressed in [("left", 1, 1, False),
                                                            ("right", 2, -1, True)]]
        for drone in drones:
            drone.connect()
        for drone in drones:
            drone.mount_camera()
        for _ in range(IMAGES):
            for drone in drones:
                self.assertIsNotNone(drone.fly(1)[0])
        for drone in drones:
            poses = drone.pose.all()
            self.assertEqual(len(poses), IMAGES)
            self.assertEqual({p.header.frame_id for p in poses}, {drone.prefix + "/map"})
            # Opposite ways: a pose of the other drone would be far off.
            self.assertAlmostEqual(poses[-1].pose.pose.position.y, drone.position_m(), delta=0.05)
        edges = {(t.header.frame_id, t.child_frame_id) for m in tf.all() for t in m.transforms}
        self.assertEqual(edges, {("left/map", "left/odom"), ("right/map", "right/odom")})


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "two_drones", TwoDrones)
