# SPDX-License-Identifier: BSD-3-Clause
"""Publishes a flight's messages, each image after the answer to the one before, and keeps what the nodelets answer."""
import collections
import threading
import time

import rospy
from ardrone_vslam.msg import Features, Status
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock, Log
from sensor_msgs.msg import CameraInfo, Image
from tf2_msgs.msg import TFMessage

CONNECT_S, END_S = 60, 5
RATE_HZ = 10  # of images while something is done to the nodelets
# How long an answer is waited for; after three that did not come. Less than odometry_wait_s: where the mapper has moved the clock,
# it needs odometry that is published next.
ANSWER_S, SILENT_ANSWER_S = 0.4, 0.1
# What becomes of an image: each counter of Status.
ANSWERED_OR_LOST = ("images", "images_dropped", "images_dropped_queue", "images_without_camera_info", "dropped_bad_message", "dropped_stamp",
                    "dropped_queue", "dropped_no_odometry", "dropped_no_extrinsics", "results_not_finite")

# pose: geometry_msgs/PoseWithCovariance
Answer = collections.namedtuple("Answer", "item pose status")


class Answers:
    """What came, in its order."""

    def __init__(self):
        self.sent = {}  # the last image with each stamp
        self.answers, self.strangers, self.status, self.log_lines = [], 0, None, 0
        self.states = collections.Counter()
        self.parts = collections.defaultdict(dict)  # pose and status of a stamp, until both are there
        self.came = threading.Condition()
        self.subscribers = [rospy.Subscriber("/vslam/pose", PoseWithCovarianceStamped, self.on_pose, queue_size=1000),
                            rospy.Subscriber("/vslam/status", Status, self.on_status, queue_size=1000),
                            rospy.Subscriber("/rosout", Log, self.on_log, queue_size=1000)]

    def on_pose(self, message):
        with self.came:
            if message.header.stamp.to_nsec() not in self.sent:
                self.strangers += 1
            self.add(message.header.stamp.to_nsec(), pose=message.pose)

    def on_status(self, message):
        with self.came:
            self.status = message
            self.states[message.state_name] += 1
            if message.header.stamp.to_nsec() in self.sent:
                self.add(message.header.stamp.to_nsec(), status=message)
            self.came.notify_all()

    def add(self, stamp_ns, **part):
        parts = self.parts[stamp_ns]
        parts.update(part)
        if len(parts) == 2 and stamp_ns in self.sent:
            self.answers.append(Answer(self.sent[stamp_ns], **self.parts.pop(stamp_ns)))
            self.came.notify_all()

    def on_log(self, message):
        if "/vslam" in message.name:
            self.log_lines += 1

    def counts(self):
        return {name: getattr(self.status, name) for name in ANSWERED_OR_LOST} if self.status else {}


class Player:
    def __init__(self, change_features=None):
        """change_features: what becomes of a Features message between tracker and mapper"""
        self.publishers = {"image": rospy.Publisher("/camera/image_raw", Image, queue_size=100),
                           "info": rospy.Publisher("/camera/camera_info", CameraInfo, queue_size=100),
                           "odometry": rospy.Publisher("/odometry", Odometry, queue_size=1000),
                           "tf_static": rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True),
                           "clock": rospy.Publisher("/clock", Clock, queue_size=100)}
        self.answers = Answers()
        self.images_sent, self.silent = 0, 0
        self.needed = [self.publishers[kind] for kind in ("image", "info", "odometry")] + self.answers.subscribers[:2]
        if change_features:
            changed = rospy.Publisher("/relay/features", Features, queue_size=100)
            self.needed += [changed, rospy.Subscriber("/vslam/features", Features, lambda message: changed.publish(change_features(message)), queue_size=100)]

    def connect(self):
        end_s = time.monotonic() + CONNECT_S
        while not all(topic.get_num_connections() for topic in self.needed):
            if time.monotonic() > end_s:
                raise RuntimeError("nobody is connected to " + ", ".join(topic.name for topic in self.needed if not topic.get_num_connections()))
            time.sleep(0.05)

    def wait_for_answer(self, answered_before):
        wait_s = SILENT_ANSWER_S if self.silent >= 3 else ANSWER_S
        with self.answers.came:
            came = self.answers.came.wait_for(lambda: len(self.answers.answers) > answered_before, wait_s)
        self.silent = 0 if came else self.silent + 1

    def play(self, items, nodelets):
        calls = []
        for item in items:
            if item.kind == "call":
                calls.append(threading.Thread(target=item.call, args=(nodelets,)))
                calls[-1].start()
                continue
            if item.kind == "image" and any(call.is_alive() for call in calls):
                time.sleep(1 / RATE_HZ)
            answered_before = len(self.answers.answers)
            if item.kind == "image":
                self.images_sent += 1
                self.answers.sent[item.message.header.stamp.to_nsec()] = item
            self.publishers[item.kind].publish(item.message)
            if item.kind == "image" and item.waits:
                self.wait_for_answer(answered_before)
        for call in calls:
            call.join()
        with self.answers.came:  # Status comes once a second when no image does
            self.answers.came.wait_for(lambda: sum(self.answers.counts().values()) >= self.images_sent, END_S)
