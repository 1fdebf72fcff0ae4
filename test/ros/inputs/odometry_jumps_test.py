#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Odometry whose heading jumps, and odometry that is started again in flight: pose, tf and status."""
import os
import sys
import unittest

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import STEP_M, Drone, Recorder, matrix, pose_of  # noqa: E402


def turned(message, yaw_rad, origin_m):
    """In a frame that is turned and begins where y was origin_m."""
    position, orientation = message.pose.pose.position, message.pose.pose.orientation
    way_m = position.y - origin_m
    position.x, position.y = -np.sin(yaw_rad) * way_m, np.cos(yaw_rad) * way_m
    orientation.z, orientation.w = np.sin(yaw_rad / 2), np.cos(yaw_rad / 2)
    return message


def count_of(status, fault):
    return dict(zip(status.odometry_fault, status.odometry_fault_count)).get(fault, 0)


class OdometryJumps(unittest.TestCase):
    """The tests are one flight, in the order of their numbers."""

    @classmethod
    def setUpClass(cls):
        rospy.init_node("odometry_jumps_test")
        cls.drone = Drone()
        cls.tf_publisher = rospy.Publisher("/tf", TFMessage, queue_size=100)
        cls.tf = Recorder("/tf", TFMessage)
        cls.drone.connect()
        cls.drone.mount_camera()

    def step(self, change=lambda message: message):
        """One image. @return what was published of map -> base, by the pose and by tf with the driver's own odom -> base"""
        stamp = self.drone.next()
        odometry = change(self.drone.odometry())
        transform = TransformStamped()
        transform.header, transform.child_frame_id = odometry.header, odometry.child_frame_id
        transform.transform.translation.x, transform.transform.translation.y = odometry.pose.pose.position.x, odometry.pose.pose.position.y
        transform.transform.rotation = odometry.pose.pose.orientation
        self.tf_publisher.publish(TFMessage([transform]))
        rospy.sleep(0.02)  # tf has a thread of its own
        self.drone.send(odometry, self.drone.image(), self.drone.info())
        pose = self.drone.answered(stamp)
        self.assertIsNotNone(pose)
        def is_of_map(message):  # transform_tolerance_s dates it ahead
            return any(t.header.frame_id == "map" and abs((t.header.stamp - stamp).to_sec() - 0.2) < 0.01 for t in message.transforms)
        T_map_odom = self.tf.wait(is_of_map).transforms[0].transform
        T_odom_base = pose_of(odometry.pose.pose)
        return pose_of(pose.pose.pose), matrix(T_map_odom.translation, T_map_odom.rotation) @ T_odom_base, stamp

    def test_1_a_heading_that_jumps_goes_on(self):
        for _ in range(25):
            before, _, _ = self.step()
        there_m = self.drone.position_m()
        for _ in range(25):
            after, by_tf, stamp = self.step(lambda message: turned(message, 2.0, there_m))
        self.assertLess(np.linalg.norm((after - before)[:3, 3] - [0, 25 * STEP_M, 0]), 0.2)
        np.testing.assert_allclose(after[:3, :3], before[:3, :3], atol=0.1)
        np.testing.assert_allclose(by_tf, after, atol=0.02)
        status = self.drone.status.wait(lambda s: s.header.stamp == stamp)
        self.assertEqual((count_of(status, "turn"), count_of(status, "started_again")), (1, 0))
        self.assertIsNotNone(self.drone.log.wait(lambda log: "turned at once" in log.msg and "/odometry" in log.msg))

    def test_2_after_a_new_start_the_place_is_looked_for(self):
        self.drone.time_s += 2
        there_m = self.drone.position_m() + STEP_M
        for _ in range(3):
            _, _, stamp = self.step(lambda message: turned(message, 0.0, there_m))
        status = self.drone.status.wait(lambda s: s.header.stamp == stamp)
        self.assertEqual(count_of(status, "started_again"), 1)
        self.assertEqual(status.state_name, "searching_map")
        self.assertGreater(self.drone.answered(stamp).pose.covariance[0], 1e5)
        self.assertIsNotNone(self.drone.log.wait(lambda log: "began anew at its origin" in log.msg and "searching_map" in log.msg))


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "odometry_jumps", OdometryJumps)
