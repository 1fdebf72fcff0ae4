# SPDX-License-Identifier: BSD-3-Clause
"""A rendered flight as the list of messages that a driver would publish, in the order of their arrival."""
from dataclasses import dataclass
from typing import Any, Callable, Optional

import numpy as np
import rosbag

KINDS = {"/camera/image_raw": "image", "/camera/camera_info": "info", "/odometry": "odometry", "/tf_static": "tf_static"}
ODOMETRY_AHEAD_NS = 6_000_000  # an image is sent after the odometry that comes next


@dataclass
class Item:
    """One message, or something that is done at its time."""
    kind: str  # image, info, odometry, tf_static, clock; call
    time_ns: int  # when it comes, in the flight's time
    message: Any = None
    call: Optional[Callable] = None  # gets the nodelets, while messages go on
    T_world_base: Optional[np.ndarray] = None  # of an image: the truth, 4x4
    T_odom_base: Optional[np.ndarray] = None  # of an image: by the odometry before any fault
    waits: bool = True  # of an image: the next message is sent after its answer


def matrix_of(pose):
    """4x4 of a geometry_msgs/Pose."""
    p, q = pose.position, pose.orientation
    x, y, z, w = q.x, q.y, q.z, q.w
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), p.x],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), p.y],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), p.z],
                     [0, 0, 0, 1]])


def read_flight(path):
    """@return items in their order, without tf that moves: the mapper does not ask for it"""
    with rosbag.Bag(path) as bag:
        messages = [(topic, message) for topic, message, _ in bag.read_messages()]
    truth = {m.header.stamp.to_nsec(): matrix_of(m.pose) for topic, m in messages if topic == "/truth/pose"}
    odometry = {m.header.stamp.to_nsec(): matrix_of(m.pose.pose) for topic, m in messages if topic == "/odometry"}
    items = []
    for topic, message in messages:
        kind = KINDS.get(topic)
        if kind is None:
            continue
        item = Item(kind, 0 if kind == "tf_static" else message.header.stamp.to_nsec(), message)
        if kind == "image":
            item.T_world_base, item.T_odom_base = truth[item.time_ns], odometry[item.time_ns]
        if kind in ("image", "info"):
            item.time_ns += ODOMETRY_AHEAD_NS
        items.append(item)
    order = {"tf_static": 0, "odometry": 1, "info": 2, "image": 3}
    return sorted(items, key=lambda item: (item.time_ns, order[item.kind]))


def of_kind(items, kind):
    return [item for item in items if item.kind == kind]


def span(items, begin, end):
    """@return the times of two shares of the flight [ns]"""
    times = [item.time_ns for item in items if item.kind == "image"]
    return tuple(int(times[0] + share * (times[-1] - times[0])) for share in (begin, end))

