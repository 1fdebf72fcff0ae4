#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Messages with the topics and frames of other drones' drivers lead to fused poses through their launch files. MAVROS calls the frame of its
odometry map, so the fused poses' frame has another name; the Tello's frames begin with a slash."""
import os
import sys
import unittest

import rospy
import rostest
from ardrone_vslam.msg import Status
from sensor_msgs.msg import Range
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Drone, Recorder  # noqa: E402

IMAGES = 15


class OtherDrone(Drone):
    """Its driver's odometry has the frames odom and base."""

    def __init__(self, vslam, camera, odometry, odom, base, camera_frame):
        super().__init__(vslam, camera, odometry)
        self.odom, self.base, self.camera = odom, base, camera_frame

    def odometry(self):
        message = super().odometry()
        message.header.frame_id, message.child_frame_id = self.odom, self.base
        return message


class OtherDronesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("other_drones_test")
        cls.tf = Recorder("/tf", TFMessage)

    def fly(self, drone, map_frame):
        """@return its poses: in map_frame, and those of the flight; tf joins map_frame and the odometry's frame"""
        drone.connect()
        poses = drone.fly(IMAGES)
        self.assertIsNotNone(poses[-1])
        self.assertEqual({pose.header.frame_id for pose in poses}, {map_frame})
        self.assertAlmostEqual(poses[-1].pose.pose.position.y, drone.position_m(), delta=0.05)
        self.assertIsNotNone(drone.status.wait(lambda status: status.state == Status.TRACKING), "no image corrects the pose")
        joined = (map_frame, drone.odom.lstrip("/"))
        self.assertIsNotNone(self.tf.wait(lambda m: joined in {(t.header.frame_id, t.child_frame_id) for t in m.transforms}))

    def test_bebop(self):
        drone = OtherDrone("/bebop_vslam", "/bebop", "/bebop/odom", "odom", "base_link", "camera_optical")
        drone.mount_camera(forward_m=0.1)  # the driver's robot_state_publisher does
        self.fly(drone, "map")

    def test_tello(self):
        self.fly(OtherDrone("/tello_vslam", "/tello/camera", "/tello/odom", "/tello/local_origin", "/tello/base_link", "/tello/camera_front"), "map")

    def test_mavros(self):
        drone = OtherDrone("/mavros_vslam", "/front", "/mavros/local_position/odom", "map", "base_link", "front_optical")
        ranges = rospy.Publisher("/mavros/distance_sensor/hrlv_ez4_pub", Range, queue_size=10)
        next_image = drone.next

        def next_with_range():
            stamp = next_image()
            message = Range(min_range=0.2, max_range=5, range=1.5)
            message.header.stamp = stamp
            ranges.publish(message)
            return stamp
        drone.next = next_with_range
        self.fly(drone, "vslam_map")
        status = drone.status.all()[-1]
        self.assertLess(status.heights_missing, status.images, "no range was used")

    def test_one_name_for_two_frames_is_told(self):
        drone = OtherDrone("/one_map_vslam", "/side", "/side/odom", "map", "base_link", "side_optical")
        drone.mount_camera()
        drone.connect()
        drone.fly(1)
        told = "is called map as well as the map's: set the parameter map_frame to another name"
        self.assertIsNotNone(drone.status.wait(lambda status: told in status.reason), "the clash is not told")


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "other_drones", OtherDronesTest)
