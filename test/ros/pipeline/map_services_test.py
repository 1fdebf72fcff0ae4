#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A map is saved, the map begins anew, and in the loaded one the drone is found from another origin and heading of its
odometry; so is the next flight, which leaves the file as it is."""
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

import rospy
import rostest
from ardrone_vslam.msg import Status
from ardrone_vslam.srv import MapFile
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import PoseWithCovarianceStamped
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import STEP_M, TIMEOUT_S, Drone  # noqa: E402

HEADING_RAD = 2.0
ORIGIN_M = (5.0, -3.0, 1.0)


KEPT = os.path.join(os.environ["ROS_HOME"], "maps", "kept.vmap")


def facts_of(path):
    return json.loads(subprocess.run([rospy.get_param("~map_tool"), "info", path, "--json"], check=True, capture_output=True, text=True).stdout)


def landmarks_in(path):
    return facts_of(path)["landmarks"]


class TurnedDrone(Drone):
    """Whose odometry may begin elsewhere."""
    is_turned = False

    def odometry(self):
        message = super().odometry()
        if self.is_turned:
            y = message.pose.pose.position.y
            position, rotation = message.pose.pose.position, message.pose.pose.orientation
            position.x = ORIGIN_M[0] - math.sin(HEADING_RAD) * y
            position.y = ORIGIN_M[1] + math.cos(HEADING_RAD) * y
            position.z = ORIGIN_M[2]
            rotation.z, rotation.w = math.sin(HEADING_RAD / 2), math.cos(HEADING_RAD / 2)
        return message


def status_of(drone):
    """After its newest image."""
    stamp = drone.stamp()
    return drone.status.wait(lambda status: status.header.stamp == stamp)


def call(service, kind, *arguments):
    name = "/vslam/mapper/" + service
    rospy.wait_for_service(name, TIMEOUT_S)
    return rospy.ServiceProxy(name, kind)(*arguments)


class MapServicesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("map_services_test")
        cls.drone = TurnedDrone()
        cls.drone.connect()
        cls.drone.mount_camera()
        cls.clicks = rospy.Publisher("/initialpose", PoseWithCovarianceStamped, queue_size=1, latch=False)

    def status(self):
        return status_of(self.drone)

    def test_1_there_must_be_a_map_and_a_name(self):
        for name, part in (("house.vmap", "no landmark to save"), ("../house.vmap", "out of reach"), ("/tmp/house.vmap", "out of reach"),
                           ("", "out of reach"), ("..", "out of reach")):
            answer = call("save_map", MapFile, name)
            self.assertFalse(answer.success, name)
            self.assertIn(part, answer.message)
        answer = call("load_map", MapFile, "none.vmap")
        self.assertFalse(answer.success)
        self.assertIn("none.vmap", answer.message)

    def test_2_a_map_outlives_the_reset(self):
        self.assertIsNotNone(self.drone.fly(60)[-1])
        landmarks = self.status().landmarks
        self.assertGreater(landmarks, 100)
        answer = call("save_map", MapFile, "rostest.vmap")
        self.assertTrue(answer.success, answer.message)
        self.assertIn(f"{landmarks} landmarks written to ", answer.message)
        facts = facts_of(os.path.join(os.path.dirname(KEPT), "rostest.vmap"))
        self.assertGreater(facts["keyframes"], 3)  # for map_tool refine
        self.assertGreater(facts["views"], 20 * facts["keyframes"])
        end_s = time.time() + 2 * TIMEOUT_S  # after ten seconds, or twenty where there was no landmark yet
        while not os.path.exists(KEPT) and time.time() < end_s:
            time.sleep(0.1)
        self.assertGreater(landmarks_in(KEPT), 0)

        self.assertTrue(call("reset", Trigger).success)
        self.drone.fly(2)
        self.assertEqual((self.status().landmarks, self.status().state_name), (0, "building_map"))

        maps = os.path.dirname(KEPT)
        shutil.copy(os.path.join(rospy.get_param("~data"), "maps", "version_1.vmap"), os.path.join(maps, "other.vmap"))
        answer = call("load_map", MapFile, "other.vmap")
        self.assertFalse(answer.success)
        self.assertIn("another camera (640 x 360 px", answer.message)

        answer = call("load_map", MapFile, "rostest.vmap")
        self.assertTrue(answer.success, answer.message)
        self.drone.is_turned, self.drone.steps = True, 10
        self.drone.fly(1)
        self.assertEqual(self.status().state_name, "searching_map")
        self.assertIn("not been found in the map", self.status().reason)
        answer = call("save_map", MapFile, "rostest.vmap")
        self.assertFalse(answer.success, "half a map would take the whole one's place")
        self.drone.fly(12)
        self.assertIn(self.status().state_name, ("localised", "relocated"))
        pose = self.drone.fly(1)[-1].pose.pose
        # In the map's frame again.
        self.assertLess(abs(pose.position.y - self.drone.position_m()), 2 * STEP_M)
        self.assertLess(math.hypot(pose.position.x, pose.position.z), 0.1)
        self.assertLess(abs(2 * math.asin(pose.orientation.z)), 0.05)

    def test_3_the_flight_is_looked_for_near_a_click(self):
        self.assertNotEqual(self.status().state_name, "searching_map")
        # The drone slides on meanwhile, out of what it has mapped.
        for frame, x_m, images, state in (("odom", 0, 1, None), ("map", 20, 8, "searching_map"), ("map", 0.2, 10, None)):
            self.click(frame, x_m)
            self.drone.fly(1)
            self.assertEqual(self.status().state_name == "searching_map", frame == "map", frame)
            self.drone.fly(images)
            self.assertEqual(self.status().state_name == "searching_map", state is not None, f"{x_m} m in {frame}")
        pose = self.drone.fly(1)[-1].pose.pose
        self.assertLess(abs(pose.position.y - self.drone.position_m()), 2 * STEP_M)

    def click(self, frame, x_m):
        message = PoseWithCovarianceStamped()
        message.header.frame_id = frame
        message.pose.pose.position.x = x_m
        message.pose.pose.position.y = self.drone.position_m()
        message.pose.pose.orientation.w = 1
        message.pose.covariance[0] = message.pose.covariance[7] = 0.25
        message.pose.covariance[35] = 0.07
        self.clicks.publish(message)
        time.sleep(0.5)  # a topic does not answer

    def test_4_the_map_is_kept_in_flight(self):
        self.drone.fly(1)
        self.assert_kept()

    def test_4a_when_it_is_kept_changes_in_flight(self):
        mapper = Client("/vslam/mapper", timeout=TIMEOUT_S)
        mapper.update_configuration({"autosave_s": 0})
        kept = pathlib.Path(KEPT).read_bytes()
        self.drone.fly(1)
        self.assert_stays(kept)
        mapper.update_configuration({"autosave_s": 1})
        self.assert_kept()

    def test_4b_localise_only_counts_from_load_map_on(self):
        mapper = Client("/vslam/mapper", timeout=TIMEOUT_S)
        for is_fixed in (True, False):
            mapper.update_configuration({"localise_only": is_fixed})
            answer = call("load_map", MapFile, "rostest.vmap")
            self.assertTrue(answer.success, answer.message)
            self.drone.steps = 10
            self.assertIsNotNone(self.drone.fly(20)[-1])
            self.assertNotEqual(self.status().state_name, "searching_map")
            loaded, kept = self.status().landmarks, pathlib.Path(KEPT).read_bytes()
            self.drone.fly(80)  # out of what is mapped
            self.assertEqual(self.status().landmarks == loaded, is_fixed)
            if is_fixed:
                self.assertEqual(loaded, landmarks_in(os.path.join(os.path.dirname(KEPT), "rostest.vmap")))
                self.assert_stays(kept)

    def assert_kept(self):
        landmarks = self.status().landmarks
        end_s = time.monotonic() + TIMEOUT_S  # of a second
        while time.monotonic() < end_s and landmarks_in(KEPT) != landmarks:
            time.sleep(0.2)
        self.assertEqual(landmarks_in(KEPT), landmarks)

    def assert_stays(self, kept):
        time.sleep(2)  # in which it would have been saved
        self.assertEqual(pathlib.Path(KEPT).read_bytes(), kept)

    def test_5_the_map_is_kept_at_the_end(self):
        self.drone.fly(1)
        landmarks = self.status().landmarks
        subprocess.run(["rosrun", "nodelet", "nodelet", "unload", "/vslam/mapper", "/vslam/manager"], check=True, timeout=TIMEOUT_S)
        self.assertEqual(landmarks_in(KEPT), landmarks)
        self.assertGreater(landmarks_in(KEPT + ".before"), 0, "the map before the reset is gone")

    def launch(self, ns, *arguments):
        """Another flight beside the first one's. @return its drone, which the nodelets hear"""
        flight = subprocess.Popen(["roslaunch", "ardrone_vslam", "vslam.launch", "ns:=" + ns, *arguments])
        self.addCleanup(flight.wait, TIMEOUT_S)
        self.addCleanup(flight.terminate)
        rospy.wait_for_message(f"/{ns}/status", Status, 2 * TIMEOUT_S)  # one a second without an image
        drone = TurnedDrone(vslam="/" + ns)
        drone.connect()
        drone.mount_camera()
        return drone

    def test_6_the_next_flight_leaves_it_as_it_is(self):
        kept = pathlib.Path(KEPT).read_bytes()
        drone = self.launch("next", "map:=kept.vmap", "localise_only:=true", "save_map:=kept.vmap", "autosave_s:=1")
        drone.is_turned, drone.steps = True, 10
        drone.fly(1)
        self.assertEqual(status_of(drone).state_name, "searching_map")
        pose = drone.fly(20)[-1].pose.pose
        self.assertEqual(status_of(drone).landmarks, landmarks_in(KEPT))
        self.assertLess(abs(pose.position.y - drone.position_m()), 2 * STEP_M)
        self.assertIsNotNone(drone.fly(80)[-1])  # out of what is mapped
        self.assertEqual(status_of(drone).landmarks, landmarks_in(KEPT))
        self.assert_stays(kept)

    def test_7_a_map_of_another_camera_stops_a_flight_before_it_begins(self):
        drone = self.launch("other", "map:=other.vmap")
        stamp = drone.next()
        drone.send(drone.odometry(), drone.image(), drone.info())
        self.assertIsNone(drone.answered(stamp, 2))
        status = drone.status.wait(lambda status: status.state_name == "waiting_for_extrinsics" and "camera" in status.reason)
        self.assertIn("another camera (640 x 360 px", status.reason)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "map_services", MapServicesTest)
