# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories in ROS 1 bags."""

import numpy as np

from .faults import InputFault, MachineFault
from .trajectory import Trajectory, rotations_of_quaternions

POSE_TYPES = ("nav_msgs/Odometry", "geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped")
# What replay.launch, make_bag and make_world call them.
TRUTH_TOPICS, ESTIMATE_TOPICS = ("/truth/pose",), ("/vslam/pose", "/vslam/odometry_fused")


def open_bag(path):
    try:
        import rosbag
    except ImportError as error:
        raise MachineFault(f"{path}: bags need Debian's python3-rosbag ({error}); run scripts/install_dependencies") from None
    try:
        return rosbag.Bag(path)
    except Exception as error:  # a damaged bag makes rosbag throw nearly anything
        raise InputFault(f"{path}: cannot be read as a bag ({error}); check the path, record it again, or try: "
                         f"rosbag reindex {path}") from None


def choose_topic(path, topics, wanted, usual, option):
    """Of {topic: type}; the wanted one, else one of the usual ones, else the only one with poses."""
    with_poses = sorted(topic for topic, kind in topics.items() if kind in POSE_TYPES)
    told = f"topics with poses: {', '.join(with_poses) or 'none'} (of the types {', '.join(POSE_TYPES)})"
    if wanted:
        if wanted in with_poses:
            return wanted
        raise InputFault(f"{path}: {option} {wanted}: no such poses in the bag; {told}")
    for topic in usual:
        if topic in with_poses:
            return topic
    if len(with_poses) == 1:
        return with_poses[0]
    raise InputFault(f"{path}: which topic? Name one by {option}; {told}")


def row_of(message, kind):
    """Stamp [ns], position, quaternion, position's covariance or None."""
    pose = message.pose if kind == "geometry_msgs/PoseStamped" else message.pose.pose
    covariance = None if kind == "geometry_msgs/PoseStamped" else message.pose.covariance
    p, q = pose.position, pose.orientation
    if covariance is not None:
        covariance = np.array(covariance, dtype=float).reshape(6, 6)[:3, :3]
    return message.header.stamp.to_nsec(), (p.x, p.y, p.z), (q.x, q.y, q.z, q.w), covariance


def check(path, topic, number, row, before_ns):
    stamp_ns, position, quaternion, _ = row
    if not np.isfinite([*position, *quaternion]).all() or abs(np.linalg.norm(quaternion) - 1) > 0.01:
        raise InputFault(f"{path}: message {number} of {topic} is not finite or its quaternion's norm is not 1; leave it out by "
                         "rosbag filter, or name another topic")
    if before_ns is not None and stamp_ns < before_ns:
        raise InputFault(f"{path}: message {number} of {topic} has a stamp before the one of the message before; the bag holds two "
                         "flights or a source that began anew: cut it by rosbag filter")


def read_bag(path, topic, usual, option):
    with open_bag(path) as bag:
        topics = {name: info.msg_type for name, info in bag.get_type_and_topic_info().topics.items()}
        topic = choose_topic(path, topics, topic, usual, option)
        rows = []
        for number, (_, message, _) in enumerate(bag.read_messages(topic), start=1):
            row = row_of(message, topics[topic])
            check(path, topic, number, row, rows[-1][0] if rows else None)
            if not rows or row[0] > rows[-1][0]:  # equal stamps: ardrone_autonomy's bursts; the first counts
                rows.append(row)
    if not rows:
        raise InputFault(f"{path}: {topic} holds no message; name another topic by {option}")
    stamps, positions, quaternions, covariances = zip(*rows)
    quaternions = np.array(quaternions) / np.linalg.norm(quaternions, axis=1)[:, None]
    # Zeros, or -1 in the first entry, say that the source knows none.
    has_covariance = covariances[0] is not None and all(np.trace(c) > 0 for c in covariances)
    return Trajectory(f"{path} {topic}", np.array(stamps, dtype=np.int64), np.array(positions),
                      rotations_of_quaternions(quaternions), np.array(covariances) if has_covariance else None)
