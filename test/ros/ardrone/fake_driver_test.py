#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The fake drone flown by hand: it takes off, flies where it is told, lands; its driver has
ardrone_autonomy's topics, frames and services; what it is given wrongly it refuses with a message."""
import os
import subprocess
import sys
import time
import unittest

import numpy as np
import rospy
import rostest
from ardrone_vslam.msg import Navdata
from ardrone_vslam.srv import CamSelect
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo, Image, Imu
from std_msgs.msg import Empty as EmptyMessage
from std_srvs.srv import Empty
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder, matrix  # noqa: E402

LANDED, FLYING, HOVERING, TAKING_OFF, LANDING = 2, 3, 4, 6, 8


def twist(forward=0.0, left=0.0):
    message = Twist()
    message.linear.x, message.linear.y = forward, left
    return message


class FakeDriver(unittest.TestCase):
    refusals = 0

    @classmethod
    def setUpClass(cls):
        rospy.init_node("fake_driver_test")
        cls.navdata = Recorder("/ardrone/navdata", Navdata)
        cls.odometry = Recorder("/ardrone/odometry", Odometry)
        cls.imu = Recorder("/ardrone/imu", Imu)
        cls.truth = Recorder("/truth/pose", PoseStamped)
        cls.tf = Recorder("/tf", TFMessage)
        cls.log = Recorder("/rosout", Log)
        cls.infos = {name: Recorder("/ardrone/" + name + "camera_info", CameraInfo) for name in ["", "front/", "bottom/"]}
        cls.images = {name: Recorder("/ardrone/" + name + "image_raw", Image) for name in ["", "front/", "bottom/"]}
        cls.commands = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
        cls.buttons = {name: rospy.Publisher("/ardrone/" + name, EmptyMessage, queue_size=1)
                       for name in ["takeoff", "land", "reset"]}
        assert cls.images["front/"].wait(lambda m: True), "no image came"
        while not all(p.get_num_connections() for p in [cls.commands, *cls.buttons.values()]):
            time.sleep(0.05)

    def await_state(self, state):
        after = self.navdata.all()[-1].header.stamp
        self.assertIsNotNone(self.navdata.wait(lambda m: m.header.stamp > after and m.state == state),
                             "state %d does not come" % state)

    def pose(self):
        pose = self.truth.all()[-1].pose
        return matrix(pose.position, pose.orientation)

    def logged(self, text):
        self.assertIsNotNone(self.log.wait(lambda m: text in m.msg), "not logged: " + text)

    def test_closed_loop(self):
        self.await_state(LANDED)
        self.assertLess(np.linalg.norm(self.pose()[:3, 3]), 0.2)
        self.buttons["takeoff"].publish()
        self.await_state(TAKING_OFF)
        self.await_state(HOVERING)
        before = self.pose()
        self.commands.publish(twist(forward=0.5))
        self.await_state(FLYING)

        def way_m(pose):
            return (np.linalg.inv(before) @ matrix(pose.position, pose.orientation))[:3, 3]

        self.assertIsNotNone(self.truth.wait(lambda m: way_m(m.pose)[0] > 0.3), "it does not fly forward")
        self.commands.publish(twist())
        self.await_state(HOVERING)
        self.assertLess(abs(way_m(self.truth.all()[-1].pose)[1]), 0.4)  # the wind's
        self.commands.publish(twist(forward=1.0, left=float("nan")))
        self.logged("not finite")
        self.await_state(HOVERING)
        self.commands.publish(twist(forward=7.0))
        self.logged("beyond +-1")
        self.commands.publish(twist())
        self.buttons["land"].publish()
        self.await_state(LANDING)
        self.await_state(LANDED)
        self.assertLess(self.pose()[2, 3], 0.11)
        # Profile truth: the odometry is the truth, to the driver's integration.
        odometry, truth = self.odometry.all(), {m.header.stamp: m.pose.position for m in self.truth.all()}
        errors = [abs(o.pose.pose.position.x - truth[o.header.stamp].x) for o in odometry if o.header.stamp in truth]
        self.assertGreater(len(errors), 500)
        self.assertLess(max(errors), 0.05)

    def test_cameras(self):
        def streams(name):
            after = rospy.Time.now() + rospy.Duration(0.5)
            for topic in [name, ""]:
                info = self.infos[topic].wait(lambda m: m.header.stamp > after)
                image = self.images[topic].wait(lambda m: m.header.stamp > after)
                self.assertEqual(info.header.frame_id, "ardrone_base_%scam" % name.rstrip("/"))
                self.assertEqual((image.header.frame_id, image.width, image.height, image.encoding),
                                 (info.header.frame_id, 640, 360, "rgb8"))
            self.assertTrue({m.header.stamp for m in self.images[name].all()} & {m.header.stamp for m in self.infos[name].all()})
            other = "front/" if name == "bottom/" else "bottom/"
            self.assertFalse([m for m in self.images[other].all() if m.header.stamp > after])

        toggle = rospy.ServiceProxy("/ardrone/togglecam", Empty)
        select = rospy.ServiceProxy("/ardrone/setcamchannel", CamSelect)
        streams("front/")
        toggle()
        streams("bottom/")
        toggle()
        streams("front/")
        self.assertTrue(select(channel=1).result)
        streams("bottom/")
        self.assertTrue(select(channel=2).result)
        streams("front/")
        rospy.ServiceProxy("/ardrone/flattrim", Empty)()

    def test_frames(self):
        edges = {(t.header.frame_id, t.child_frame_id) for m in self.tf.all() for t in m.transforms}
        self.assertEqual(edges, {("odom", "ardrone_base_link"), ("ardrone_base_link", "ardrone_base_frontcam"),
                                 ("ardrone_base_link", "ardrone_base_bottomcam")})
        self.assertEqual({m.header.frame_id for m in self.imu.all()}, {"ardrone_base_link"})
        self.assertEqual({m.header.frame_id for m in self.truth.all()}, {"map"})

    def refused(self, *arguments):
        self.__class__.refusals += 1  # a name of its own, as parameters stay with the master
        environment = dict(os.environ, ROSCONSOLE_FORMAT="${message}")
        process = subprocess.run(["rosrun", "ardrone_vslam", "fake_driver", "__name:=refused_%d" % self.refusals, *arguments], text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=30, env=environment, check=False)
        self.assertEqual(process.returncode, 1, process.stdout)
        return process.stdout

    def test_refuses_what_cannot_be(self):
        self.assertIn("no fault 'gremlins'; known are", self.refused("_faults:=bursts,gremlins"))
        self.assertIn("no camera 'rear'; known are", self.refused("_camera:=rear"))
        self.assertIn("no flight 'loop'; known are", self.refused("_autopilot:=loop"))
        self.assertIn("must be between 0.1 and 100", self.refused("_rate:=0"))
        self.assertIn("does not fit into the world", self.refused("_autopilot:=corridor", "_world:=room"))
        self.assertIn("known", self.refused("_odometry_profile:=perfect"))


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "fake_driver", FakeDriver)
