#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""doctor --live takes the running mapper's parameters: what they answer is no warning, and is one when they do not."""
import json
import subprocess
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseWithCovarianceStamped

# Of the emulated driver's faults, those that config/ardrone.yaml answers. A few seconds do not tell the last two always.
ANSWERED = ("odometry_covariance", "odometry_yaw", "height_ground", "image_time_offset")


class DoctorFake(unittest.TestCase):
    def examine(self):
        answer = subprocess.run([rospy.get_param("~doctor"), "--live", "--seconds", "15", "--json", "-"],
                                stdout=subprocess.PIPE, timeout=90)
        report = json.loads(answer.stdout)
        self.assertEqual(answer.returncode, 0, report)
        self.assertEqual(report["in_force"], "/vslam/mapper")
        return report, {check["check"]: check["verdict"] for check in report["checks"]}

    def test_the_fake_drone_is_told_of_what_its_configuration_lacks_alone(self):
        rospy.init_node("doctor_fake_test")
        rospy.wait_for_message("/vslam/pose", PoseWithCovarianceStamped, 60)
        report, verdicts = self.examine()
        self.assertEqual(verdicts["odometry_yaw"], "configured", report)
        self.assertEqual(verdicts["odometry_covariance"], "configured", report)
        self.assertEqual([check for check in ANSWERED if verdicts[check] == "warning"], [], report)

        rospy.set_param("/vslam/mapper/odometry_mode", "pose")
        report, verdicts = self.examine()
        self.assertEqual(verdicts["odometry_yaw"], "warning", report)
        self.assertEqual(report["parameters"]["mapper/odometry_mode"]["value"], "twist")


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "doctor_fake", DoctorFake)
