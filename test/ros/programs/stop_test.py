#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How launch files end: the manager without a crash, also right after its nodelets were loaded; a replay without its bag."""
import os
import signal
import subprocess
import time
import unittest

import rosgraph
import rospkg
import rospy
import rostest
from roslaunch.parent import ROSLaunchParent

TIMEOUT_S = 30.0
PUBLISHED = {"/vslam/features", "/vslam/status"}  # one of each nodelet


def wait_for_nodelets():
    master = rosgraph.Master("/stop_test")
    end_s = time.monotonic() + TIMEOUT_S
    while not PUBLISHED <= {topic for topic, _ in master.getSystemState()[0]}:
        if time.monotonic() > end_s:
            raise RuntimeError("the nodelets do not publish")
        time.sleep(0.02)


class Stop(unittest.TestCase):
    def test_the_manager_ends_without_a_crash(self):
        rospy.init_node("stop_test")
        launch_file = os.path.join(rospkg.RosPack().get_path("ardrone_vslam"), "launch", "vslam.launch")
        launch = ROSLaunchParent(rospy.get_param("/run_id"), [launch_file])
        launch.start()
        try:
            wait_for_nodelets()
            # Alone: roslaunch stops the loaders as well, and who is first is chance.
            manager = next(p.popen for p in launch.pm.procs if p.name.startswith("vslam/manager"))
            manager.send_signal(signal.SIGINT)
            self.assertEqual(manager.wait(TIMEOUT_S), 0)
        finally:
            launch.shutdown()

    def test_a_replay_ends_when_its_bag_is_missing(self):
        command = ["roslaunch", "ardrone_vslam", "replay.launch", "bag:=/no/such.bag"]
        ended = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=TIMEOUT_S, check=False)
        self.assertIn("play_bag: /no/such.bag: there is no such file", ended.stdout)

    def test_a_replay_of_a_bag_with_other_topics_says_which_it_has(self):
        bag = os.path.join(rospkg.RosPack().get_path("ardrone_vslam"), "bags", "laps_20s.bag")
        command = ["roslaunch", "ardrone_vslam", "replay.launch", "bag:=" + bag, "camera:=/front", "odometry:=/odom"]
        ended = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=TIMEOUT_S, check=False)
        self.assertIn("has no /front/image_raw, /front/camera_info, /odom; camera:=, image:=, odometry:= and imu:= name the topics", ended.stdout)
        self.assertIn("/camera/image_raw/compressed: compressed images (image_transport:=compressed); /odometry: odometry", ended.stdout)
        command = [os.path.join(os.path.dirname(os.path.dirname(bag)), "scripts/play_bag"), "--needs=/odometry", "--needs=/camera/image_raw", "--bags=" + bag]
        player = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            self.assertIn("has no /camera/image_raw; camera:=", player.stderr.readline())
            self.assertIsNone(player.poll(), "another node may give what one topic lacks, so it plays")
        finally:
            player.terminate()
            player.communicate(timeout=TIMEOUT_S)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "stop", Stop)
