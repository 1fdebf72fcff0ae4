#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Images come far faster than the tracker works, some without camera_info: every single one is either
answered or in a counter, the newest is answered, and the log says what helps. For an image the mapper
has next to no time, too: what it leaves out is said and counted."""
import os
import sys
import unittest

import numpy as np
import rospy
import rostest
from ardrone_vslam.msg import Status
from diagnostic_msgs.msg import DiagnosticArray

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from drone import Drone, Recorder  # noqa: E402

IMAGES = 150
TILES = 4  # a large image: some 50 ms for the tracker, next to nothing for who sends it
STEP_S = 0.001
WITHOUT_INFO = 7


def lost(status):
    """All images that were received but not answered."""
    return (status.images_dropped + status.images_dropped_queue +
            status.images_without_camera_info + status.dropped_bad_message +
            status.dropped_stamp + status.dropped_queue + status.dropped_no_odometry +
            status.dropped_no_extrinsics)


class Overload(unittest.TestCase):
    def large_image(self, drone):
        image = drone.image()
        pixels = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width)
        image.width, image.height, image.step = (TILES * n for n in
                                                 (image.width, image.height, image.step))
        image.data = np.tile(pixels, (TILES, TILES)).tobytes()
        return image

    def large_info(self, drone):
        info = drone.info()
        info.width, info.height = TILES * info.width, TILES * info.height
        return info

    def test_every_image_is_accounted_for(self):
        rospy.init_node("overload_test")
        diagnostics = Recorder("/diagnostics", DiagnosticArray)
        drone = Drone(queue_size=None)
        drone.connect()
        drone.mount_camera()

        # One image's features give the mapper what it needs to know before the flood.
        drone.next()
        drone.send(drone.odometry())
        image, info = self.large_image(drone), self.large_info(drone)
        drone.send(image, info)
        self.assertIsNotNone(drone.answered(drone.stamp()))

        drone.time_s += IMAGES * STEP_S
        after = drone.odometry()
        after.header.stamp = rospy.Time.from_sec(drone.time_s + 0.1)
        drone.send(after)
        first_s = drone.time_s - IMAGES * STEP_S
        for i in range(1, IMAGES + 1):
            stamp = rospy.Time.from_sec(round(first_s + i * STEP_S, 3))
            image.header.stamp = info.header.stamp = stamp
            drone.send(image)
            if i > WITHOUT_INFO:
                drone.send(info)

        self.assertIsNotNone(drone.answered(stamp), "the newest image is never the one that goes")
        status = drone.status.wait(lambda s: s.header.stamp == stamp)
        self.assertIsNotNone(status)
        self.assertEqual(status.images + lost(status), 1 + IMAGES)
        self.assertEqual(status.images_without_camera_info, WITHOUT_INFO)
        self.assertGreater(status.images_dropped_queue, 0)
        self.assertEqual(len(drone.pose.all()), status.images)
        left_out = dict(zip(status.left_out, status.left_out_count))
        self.assertEqual(left_out["keyframe"], status.images, "one is due at each: none was ever taken")
        self.assertIn("frame_budget_ms leaves no time for all (left out: keyframe", status.reason)

        def is_complete(array):
            for tracker in (s for s in array.status if "tracker" in s.name):
                values = {v.key: v.value for v in tracker.values}
                return (values["images received"] == str(1 + IMAGES) and
                        values["images dropped while the tracker was busy"] ==
                        str(status.images_dropped_queue) and
                        values["images without camera_info"] == str(WITHOUT_INFO) and
                        values["images waiting"] == "0")
            return False
        self.assertIsNotNone(diagnostics.wait(is_complete))
        said = drone.log.wait(lambda log: "come faster than the tracker works" in log.msg)
        self.assertIsNotNone(said)
        self.assertIn("/camera/image_raw", said.msg)
        self.assertIn("features_per_frame", said.msg)


if __name__ == "__main__":
    rostest.rosrun("ardrone_vslam", "overload", Overload)
