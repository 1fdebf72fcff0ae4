#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/open_rviz gives rviz the robot's own frames; a program that notes what it is given stands for rviz."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import rospy
import rostest
import yaml
from nav_msgs.msg import Odometry

NOTES = """#!/bin/sh
printf '%s\\n' "$@" > "$NOTES/arguments"
cp "$2" "$NOTES/layout"
"""


class OpenRvizTest(unittest.TestCase):
    def setUp(self):
        rospy.init_node("open_rviz_test")
        self.package = pathlib.Path(rospy.get_param("~package"))
        self.layout = self.package / "config/vslam.rviz"
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.notes = pathlib.Path(self.folder.name)
        (self.notes / "rviz").write_text(NOTES)
        (self.notes / "rviz").chmod(0o755)

    def open(self, namespace):
        """As roslaunch does. @return the program"""
        environment = dict(os.environ, PATH=f"{self.notes}:{os.environ['PATH']}", NOTES=str(self.notes), ROS_NAMESPACE=namespace)
        return subprocess.Popen([self.package / "scripts/open_rviz", "-d", self.layout, "__name:=rviz"], env=environment,
                                stderr=subprocess.PIPE, text=True)

    def end(self, program):
        """@return what rviz was given: arguments and layout, and what was said"""
        said = program.communicate(timeout=30)[1]
        self.assertEqual(program.returncode, 0, said)
        return (self.notes / "arguments").read_text().split("\n"), yaml.safe_load((self.notes / "layout").read_text()), said

    def test_the_frames_are_the_robots(self):
        publisher = rospy.Publisher("/robot/odometry_fused", Odometry, queue_size=1, latch=True)
        pose = Odometry(child_frame_id="left/base_footprint")
        pose.header.frame_id = "vslam_map"
        publisher.publish(pose)
        arguments, layout, _ = self.end(self.open("/robot"))
        self.assertNotEqual(arguments[1], str(self.layout))
        self.assertEqual(arguments[2], "__name:=rviz")
        manager = layout["Visualization Manager"]
        self.assertEqual(manager["Global Options"]["Fixed Frame"], "vslam_map")
        views = [manager["Views"]["Current"]] + manager["Views"]["Saved"]
        self.assertEqual({view["Target Frame"] for view in views}, {"<Fixed Frame>", "left/base_footprint"})

    def test_without_a_pose_the_layout_is_as_it_was(self):
        arguments, layout, said = self.end(self.open("/nobody"))
        self.assertEqual(arguments[1], str(self.layout))
        self.assertEqual(layout, yaml.safe_load(self.layout.read_text()))
        self.assertIn("no pose on odometry_fused within 5 s", said)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "open_rviz", OpenRvizTest)
