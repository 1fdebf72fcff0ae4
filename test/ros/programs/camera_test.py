#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""camera_node publishes what a video holds, with its calibration, and the tracker takes it; what it cannot open it names."""
import io
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rospy
import rostest
from ardrone_vslam.msg import Features
from PIL import Image as Picture
from sensor_msgs.msg import CameraInfo, Image
from sensor_msgs.srv import SetCameraInfo

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Recorder  # noqa: E402

WIDTH, HEIGHT, IMAGES, RATE_HZ = 320, 240, 60, 25  # what FFmpeg takes for JPEG images one after the other
FOCAL_PX = 300.0
CALIBRATION = """image_width: {width}
image_height: {height}
camera_name: front
camera_matrix: {{rows: 3, cols: 3, data: [{f}, 0, {cx}, 0, {f}, {cy}, 0, 0, 1]}}
distortion_model: plumb_bob
distortion_coefficients: {{rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}}
rectification_matrix: {{rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}}
projection_matrix: {{rows: 3, cols: 4, data: [{f}, 0, {cx}, 0, 0, {f}, {cy}, 0, 0, 0, 1, 0]}}
"""


def frame(i):
    """Squares that move by 2 px an image."""
    grey = np.random.default_rng(1).integers(30, 220, (HEIGHT // 12 + 1, WIDTH // 12 + 20)).astype(np.uint8)
    wide = np.kron(grey, np.ones((12, 12), np.uint8))
    return wide[:HEIGHT, 2 * i:2 * i + WIDTH]


class Camera(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.started = []

    def tearDown(self):
        for process in self.started:
            process.terminate()
            process.wait(timeout=30)

    def start(self, *command):
        environment = dict(os.environ, ROSCONSOLE_FORMAT="${message}")
        self.started.append(subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment))
        return self.started[-1]

    def video(self):
        path = os.path.join(self.folder, "video.mjpg")
        with open(path, "wb") as file:
            for i in range(IMAGES):
                jpeg = io.BytesIO()
                Picture.fromarray(frame(i)).save(jpeg, "JPEG", quality=90)
                file.write(jpeg.getvalue())
        return path

    def calibration(self, width=WIDTH):
        path = os.path.join(self.folder, "calibration.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(CALIBRATION.format(width=width, height=HEIGHT, f=FOCAL_PX, cx=WIDTH / 2, cy=HEIGHT / 2))
        return path

    def test_a_video_becomes_images_and_features(self):
        images, infos = Recorder("/front/image_raw", Image), Recorder("/front/camera_info", CameraInfo)
        features = Recorder("/vslam/features", Features)
        self.start("roslaunch", "ardrone_vslam", "camera.launch", "camera:=/front", "device:=" + self.video(),
                   "calibration:=" + self.calibration(), "camera_frame:=front_optical")

        def shows(image, i):
            green = np.frombuffer(image.data, np.uint8).reshape(HEIGHT, WIDTH, 3)[:, :, 1]
            return np.abs(green.astype(int) - frame(i)).mean() < 5

        self.assertTrue(images.wait(lambda m: shows(m, IMAGES - 1)), "the last of %d images did not come" % len(images.all()))
        # The video begins for the tracker, which may listen a little earlier than the test.
        first = IMAGES - len(images.all())
        self.assertLess(first, IMAGES / 2)
        for i, image in enumerate(images.all(), first):
            self.assertEqual((image.width, image.height, image.encoding, image.header.frame_id), (WIDTH, HEIGHT, "bgr8", "front_optical"))
            self.assertTrue(shows(image, i), "image %d is another" % i)
        stamps = np.array([m.header.stamp.to_sec() for m in images.all()])
        np.testing.assert_allclose(np.diff(stamps), 1 / RATE_HZ, atol=1e-5)
        self.assertTrue(infos.wait(lambda m: m.header.stamp == images.all()[-1].header.stamp))
        both = min(len(infos.all()), len(images.all()))
        self.assertEqual([m.header.stamp for m in infos.all()][-both:], [m.header.stamp for m in images.all()][-both:])
        self.assertEqual((infos.all()[0].K[0], infos.all()[0].width, infos.all()[0].header.frame_id), (FOCAL_PX, WIDTH, "front_optical"))
        self.assertTrue(features.wait(lambda m: m.header.stamp == images.all()[-1].header.stamp), "no features")
        self.assertGreater(len(features.all()[-1].x), 15)

    def test_a_calibration_can_be_set_and_is_kept(self):
        infos = Recorder("/side/camera_info", CameraInfo)
        kept = os.path.expanduser("~/.ros") if "ROS_HOME" not in os.environ else os.environ["ROS_HOME"]
        kept = os.path.join(kept, "camera_info", "side.yaml")
        if os.path.exists(kept):
            os.remove(kept)
        self.start("rosrun", "ardrone_vslam", "camera_node", "image_raw:=/side/image_raw", "_device:=" + self.video())
        rospy.wait_for_service("/side/set_camera_info", 20)
        info = CameraInfo(width=WIDTH, height=HEIGHT, distortion_model="plumb_bob", D=[0] * 5, K=[FOCAL_PX, 0, 160, 0, FOCAL_PX, 120, 0, 0, 1],
                          R=[1, 0, 0, 0, 1, 0, 0, 0, 1], P=[FOCAL_PX, 0, 160, 0, 0, FOCAL_PX, 120, 0, 0, 0, 1, 0])
        self.assertTrue(infos.wait(lambda m: m.width == WIDTH and m.K[0] == 0), "an uncalibrated camera says so")
        self.assertTrue(rospy.ServiceProxy("/side/set_camera_info", SetCameraInfo)(info).success)
        self.assertTrue(infos.wait(lambda m: m.K[0] == FOCAL_PX))
        self.assertTrue(os.path.exists(kept), kept)

    def test_a_calibration_of_another_size_is_not_taken(self):
        infos = Recorder("/other/camera_info", CameraInfo)
        node = self.start("rosrun", "ardrone_vslam", "camera_node", "image_raw:=/other/image_raw", "_device:=" + self.video(),
                          "_camera:=" + self.calibration(width=640))
        self.assertTrue(infos.wait(lambda m: m.width == WIDTH))
        self.assertTrue(all(m.K[0] == 0 for m in infos.all()))
        node.terminate()
        self.assertIn("the calibration is for 640x240 but images are 320x240: calibrate at this size", node.communicate(timeout=30)[0])

    def test_what_cannot_be_opened_is_named(self):
        node = self.start("rosrun", "ardrone_vslam", "camera_node", "_device:=/none/video.avi", "__name:=none")
        output, _ = node.communicate(timeout=30)
        self.assertEqual(node.returncode, 1, output)
        self.assertIn("device '/none/video.avi': is not there; `ls /dev/video*` shows", output)


if __name__ == "__main__":
    rospy.init_node("camera_test")
    rostest.rosrun("ardrone_vslam", "camera", Camera)
