#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""doctor --live takes part in a running system and finds what it would find in the bag."""
import json
import subprocess
import time
import unittest

import rospy
import rostest

TOPICS = {"/camera/image_raw", "/odometry", "/tf_static"}
TIMEOUT_S = 30.0


class DoctorLive(unittest.TestCase):
    def test_live_topics_are_examined(self):
        rospy.init_node("doctor_live_test")
        end_s = time.monotonic() + TIMEOUT_S
        while not TOPICS <= {topic for topic, _ in rospy.get_published_topics()}:
            self.assertLess(time.monotonic(), end_s, "the bag does not play")
            time.sleep(0.1)
        rospy.set_param("/vslam/mapper/odometry_mode", "twist")  # as of a mapper that has ended
        answer = subprocess.run([rospy.get_param("~doctor"), "--live", "--seconds", "5", "--json", "-"],
                                stdout=subprocess.PIPE, timeout=TIMEOUT_S)
        report = json.loads(answer.stdout)
        self.assertEqual(answer.returncode, 0, report)
        self.assertEqual(report["in_force"], "", "no mapper runs")
        verdicts = {check["check"]: check["verdict"] for check in report["checks"]}
        for check in ("topics", "camera_info", "calibration", "camera_tf", "images_tracked"):
            self.assertEqual(verdicts[check], "ok", (check, report))


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "doctor_live", DoctorLive)
