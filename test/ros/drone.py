# SPDX-License-Identifier: BSD-3-Clause
"""A drone for rostests: it slides sideways along a wall of random dots and publishes what a driver
publishes, with stamps of its own that do not depend on the machine's speed."""
import threading
import time
import xmlrpc.client

import numpy as np
import rosgraph
import rospy
from ardrone_vslam.msg import Status
from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage

WIDTH, HEIGHT, FOCAL_PX, WALL_M, WALL_PX = 320, 240, 300.0, 3.0, 4000
STEP_PX = 5  # between two images; whole, so that the same pixels are seen again
STEP_M = STEP_PX * WALL_M / FOCAL_PX
PERIOD_S = 0.1
TIMEOUT_S = 20.0  # of wall time, for an answer that normally takes milliseconds


class Recorder:
    """Keeps all messages of a topic."""

    def __init__(self, topic, message_type):
        self._lock = threading.Lock()
        self._messages = []
        self._subscriber = rospy.Subscriber(topic, message_type, self._add, queue_size=None)

    def _add(self, message):
        with self._lock:
            self._messages.append(message)

    def all(self):
        with self._lock:
            return list(self._messages)

    def wait(self, condition, timeout_s=TIMEOUT_S):
        """The first message that fulfils the condition, or None. Wall time: /clock may stand."""
        end_s = time.monotonic() + timeout_s
        while time.monotonic() < end_s:
            for message in self.all():
                if condition(message):
                    return message
            time.sleep(0.02)
        return None


    def connected(self):
        return self._subscriber.get_num_connections() > 0


def points_shown(arrays):
    """How many points rviz shows of these messages, in their order, with markers of points."""
    shown = {marker.id: len(marker.points) for array in arrays for marker in array.markers}  # DELETE has none
    return sum(shown.values())


def matrix(position, q):
    """4x4 transform of a position and a quaternion."""
    x, y, z, w = q.x, q.y, q.z, q.w
    result = np.eye(4)
    result[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    result[:3, 3] = [position.x, position.y, position.z]
    return result


def pose_of(pose):
    """4x4 transform of a geometry_msgs/Pose."""
    return matrix(pose.position, pose.orientation)


def is_heard(topic):
    """Whether somebody subscribes to it, and all who do are connected to who publishes it."""
    me = rospy.get_name()
    master = rosgraph.Master(me)
    nodes = [node for name, nodes in master.getSystemState()[1] if name == topic for node in nodes]
    inputs = [xmlrpc.client.ServerProxy(master.lookupNode(node)).getBusInfo(me)[2] for node in nodes if node != me]
    return bool(inputs) and all(any(direction == "i" and name == topic for _, _, direction, _, name, *_ in one) for one in inputs)


def play(recorders):
    """Lets the paused player of replay.launch begin, once all recorders are connected."""
    end_s = time.monotonic() + TIMEOUT_S
    while not all(recorder.connected() for recorder in recorders):
        if time.monotonic() > end_s:
            raise RuntimeError("the nodelets do not publish what the test wants to record")
        time.sleep(0.05)
    rospy.wait_for_service("/player/pause_playback", TIMEOUT_S)
    rospy.ServiceProxy("/player/pause_playback", SetBool)(False)


def paint_wall(random):
    """Black and white dots of 3x3 pixels (each a FAST corner) on faint blocks."""
    blocks = random.integers(90, 140, (HEIGHT // 10, WALL_PX // 10))
    wall = np.kron(blocks, np.ones((10, 10))).astype(np.uint8)
    for row in range(6, HEIGHT - 6, 14):
        for column in range(6, WALL_PX - 6, 14):
            y, x = (row, column) + random.integers(-3, 4, 2)
            wall[y - 1:y + 2, x - 1:x + 2] = random.choice([0, 20, 220, 255])
    return wall


class Drone:
    """Publishes images, calibration, odometry and mounting; records what the nodelets answer."""

    def __init__(self, vslam="/vslam", camera="/camera", odometry="/odometry", prefix="", seed=1,
                 direction=1, compressed=False, queue_size=10, mountings=None):
        """queue_size: of images and camera_info; None: sending blocks, so nothing is lost here
        mountings: a list that all drones of a node share, as its latched topic keeps the last message only"""
        self.prefix = prefix
        self.direction = direction
        self.steps = 0
        self.time_s = 1000.0
        self.camera, self.camera_left_px = "camera_optical", 0  # the one that sees, and how far left it is
        self._wall = paint_wall(np.random.default_rng(seed))
        self._image = self.compressed_image if compressed else self.image
        self._images = rospy.Publisher(
            camera + "/image_raw" + ("/compressed" if compressed else ""),
            CompressedImage if compressed else Image, queue_size=queue_size)
        self._infos = rospy.Publisher(camera + "/camera_info", CameraInfo, queue_size=queue_size)
        self._odometry = rospy.Publisher(odometry, Odometry, queue_size=100)
        self._mountings = [] if mountings is None else mountings
        self._tf = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        self._features = rospy.resolve_name(vslam + "/features")
        self.pose = Recorder(vslam + "/pose", PoseWithCovarianceStamped)
        self.status = Recorder(vslam + "/status", Status)
        self.log = Recorder("/rosout", Log)

    def frame(self, name):
        return self.prefix + "/" + name if self.prefix else name

    def connect(self):
        """Waits until the nodelets listen, to the drone and to each other."""
        end_s = time.monotonic() + TIMEOUT_S
        topics = [p.resolved_name for p in (self._images, self._infos, self._odometry, self._tf)] + [self._features]
        while not all(map(is_heard, topics)):
            if time.monotonic() > end_s:
                raise RuntimeError("the nodelets do not subscribe to " + ", ".join(t for t in topics if not is_heard(t)))
            time.sleep(0.05)

    def mount_camera(self, forward_m=0.21, camera="camera_optical", left_px=0):
        """base_link -> camera: looks forward (REP-103)."""
        mounting = TransformStamped()
        mounting.header.frame_id = self.frame("base_link")
        mounting.child_frame_id = self.frame(camera)
        rotation = mounting.transform.rotation
        rotation.x, rotation.y, rotation.z, rotation.w = -0.5, 0.5, -0.5, 0.5
        mounting.transform.translation.x = forward_m
        mounting.transform.translation.y = left_px * WALL_M / FOCAL_PX
        self._mountings.append(mounting)
        self._tf.publish(TFMessage(self._mountings))

    def position_m(self):
        return self.steps * STEP_M * self.direction

    def next(self):
        """Moves on by one image. @return its stamp"""
        self.steps += 1
        self.time_s += PERIOD_S
        return self.stamp()

    def stamp(self):
        return rospy.Time.from_sec(round(self.time_s, 3))

    def image(self):
        message = Image()
        message.header.stamp = self.stamp()
        message.header.frame_id = self.frame(self.camera)
        message.width, message.height, message.step = WIDTH, HEIGHT, WIDTH
        message.encoding = "mono8"
        # To the left the wall's pixels move to the right.
        left_px = 1500 - self.direction * self.steps * STEP_PX - self.camera_left_px
        message.data = self._wall[:, left_px:left_px + WIDTH].tobytes()
        return message

    def compressed_image(self):
        """In PGM, which OpenCV decodes as it does JPEG."""
        image = self.image()
        message = CompressedImage()
        message.header, message.format = image.header, "pgm"
        message.data = b"P5 %d %d 255\n" % (WIDTH, HEIGHT) + image.data
        return message

    def info(self):
        message = CameraInfo()
        message.header.stamp = self.stamp()
        message.header.frame_id = self.frame(self.camera)
        message.width, message.height = WIDTH, HEIGHT
        message.distortion_model = "plumb_bob"
        message.D = [0.0] * 5
        cx, cy = (WIDTH - 1) / 2, (HEIGHT - 1) / 2
        message.K = [FOCAL_PX, 0, cx, 0, FOCAL_PX, cy, 0, 0, 1]
        message.P = [FOCAL_PX, 0, cx, 0, 0, FOCAL_PX, cy, 0, 0, 0, 1, 0]
        return message

    def odometry(self):
        message = Odometry()
        message.header.stamp = self.stamp()
        message.header.frame_id = self.frame("odom")
        message.child_frame_id = self.frame("base_link")
        message.pose.pose.position.y = self.position_m()
        message.pose.pose.orientation.w = 1.0
        return message

    def send(self, *messages):
        for message in messages:
            publisher = {Image: self._images, CompressedImage: self._images, CameraInfo: self._infos,
                         Odometry: self._odometry}[type(message)]
            publisher.publish(message)

    def answered(self, stamp, timeout_s=TIMEOUT_S):
        """@return the pose with this stamp, or None"""
        return self.pose.wait(lambda pose: pose.header.stamp == stamp, timeout_s)

    def fly(self, images):
        """Sends good images, each after the answer to the one before. @return the poses"""
        poses = []
        for _ in range(images):
            stamp = self.next()
            self.send(self.odometry(), self._image(), self.info())
            poses.append(self.answered(stamp))
            if poses[-1] is None:
                break
        return poses
