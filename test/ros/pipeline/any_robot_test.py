#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""docs/any_robot.md as a user follows it: its commands are run as they stand there, and a rendered robot on wheels drives."""
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np
import rosbag
import rospkg
import rospy
import rostest
from ardrone_vslam.msg import Status
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Image

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder  # noqa: E402

PACKAGE = rospkg.RosPack().get_path("ardrone_vslam")
TOPICS = {"/camera/image_raw": ("/camera/image_raw", Image), "/camera/camera_info": ("/camera/camera_info", CameraInfo),
          "/odometry": ("/odom", Odometry)}


def command(begin):
    """The page's only command that begins so."""
    with open(os.path.join(PACKAGE, "docs/any_robot.md"), encoding="utf-8") as page:
        blocks = re.findall(r"^```\n(.*?)^```", page.read(), re.M | re.S)
    found, = [line for block in blocks for line in block.splitlines() if line.startswith(begin)]
    return found


def where(pose):
    return np.array([pose.position.x, pose.position.y, pose.position.z])


class AnyRobot(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        os.symlink(os.path.join(PACKAGE, "config"), os.path.join(self.folder, "config"))
        self.started = []

    def tearDown(self):
        for process in self.started:
            process.terminate()
            process.wait(timeout=30)

    def start(self, line):
        self.started.append(subprocess.Popen("exec " + line, shell=True, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True))
        return self.started[-1]

    def drive(self, before):
        """Publishes what the robot does, in its time. @param before  called once all is advertised"""
        with rosbag.Bag(rospy.get_param("~bag")) as bag:
            publishers = {topic: rospy.Publisher(name, kind, queue_size=100) for topic, (name, kind) in TOPICS.items()}
            before()
            begin_s, first_s = time.monotonic(), bag.get_start_time()
            for topic, message, stamp in bag.read_messages(topics=list(TOPICS)):
                time.sleep(max(0, begin_s + stamp.to_sec() - first_s - time.monotonic()))
                if topic == "/odometry":
                    message.child_frame_id = "base_footprint"
                publishers[topic].publish(message)

    def test_the_page(self):
        poses, odometry = Recorder("/vslam/pose", PoseWithCovarianceStamped), Recorder("/odom", Odometry)
        status = Recorder("/vslam/status", Status)
        self.start(command("rosrun tf2_ros static_transform_publisher"))
        subprocess.run(command("cp config/"), shell=True, cwd=self.folder, check=True)
        launch = self.start(command("roslaunch ardrone_vslam vslam.launch"))
        doctor = []

        def ready():
            self.assertTrue(status.wait(lambda m: True), launch.poll())
            doctor.append(self.start(command("rosrun ardrone_vslam doctor --live")))

        self.drive(ready)
        report, _ = doctor[0].communicate(timeout=60)
        self.assertEqual(doctor[0].returncode, 0, report)
        self.assertRegex(report, r"ok +camera_tf +'base_footprint' -> 'camera_optical'")
        with rosbag.Bag(rospy.get_param("~bag")) as bag:
            truth = {m.header.stamp: where(m.pose) for _, m, _ in bag.read_messages(topics=["/truth/pose"])}
        told = {m.header.stamp: where(m.pose.pose) for m in odometry.all()}
        fused = {m.header.stamp: where(m.pose.pose) for m in poses.all()}
        self.assertGreater(len(fused), 250)
        stamps = sorted(set(truth) & set(told) & set(fused))
        self.assertGreater(len(stamps), 100)
        second_lap = stamps[-len(stamps) // 3:]

        def error_m(path):
            ways = [path[s] - path[stamps[0]] - truth[s] + truth[stamps[0]] for s in second_lap]
            return np.sqrt(np.mean(np.square(np.linalg.norm(ways, axis=1))))

        self.assertIn(Status.LOCALISED, {m.state for m in status.all()})
        self.assertGreater(error_m(told), 0.1)
        self.assertLess(error_m(fused), 0.3 * error_m(told))


if __name__ == "__main__":
    rospy.init_node("any_robot_test")
    rostest.rosrun("ardrone_vslam", "any_robot", AnyRobot)
