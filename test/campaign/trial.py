# SPDX-License-Identifier: BSD-3-Clause
"""One flight with one fault through nodelets of its own: what became of it, as JSON. A process for each, as rospy serves one master."""
import argparse
import json
import os
import sys

import numpy as np
import rospy
from changes import Context
from faults import FAULTS
from flight import matrix_of, of_kind, read_flight
from nodelets import Nodelets
from player import Player

LOOSE_LAUNCH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "loose.launch")


def squared_error(error_m, covariance):
    """Over the covariance; 3 is the mean of an honest filter."""
    variance_m2 = np.reshape(covariance, (6, 6))[:3, :3]
    if not np.isfinite(variance_m2).all() or np.linalg.eigvalsh(variance_m2).min() <= 0:
        return float("inf")
    return float(error_m @ np.linalg.solve(variance_m2, error_m))


def errors_of(answers):
    """Of each answer: its time in the flight [s], the error [m], the same over its covariance, what the odometry's error would be
    without the fault, the state. Each map begins where its first pose is, so there the truth is laid onto it."""
    rows, map_of_last, last_images = [], None, 0
    for item, pose, status in answers:
        is_of_new_mapper = status.images < last_images
        if is_of_new_mapper or status.restarts != map_of_last:
            T_map_world, T_odom_world = (T @ np.linalg.inv(item.T_world_base) for T in (matrix_of(pose.pose), item.T_odom_base))
        map_of_last, last_images = status.restarts, status.images
        error_m = (matrix_of(pose.pose) - T_map_world @ item.T_world_base)[:3, 3]
        odometry_error_m = (item.T_odom_base - T_odom_world @ item.T_world_base)[:3, 3]
        rows.append((item.time_ns * 1e-9, float(np.linalg.norm(error_m)), squared_error(error_m, pose.covariance),
                     float(np.linalg.norm(odometry_error_m)), status.state_name))
    return rows


def fly(fault, flight, other, seed, folder):
    context = Context(np.random.default_rng(seed), other)
    begin_ns, end_ns = context.window_ns(flight)
    items = fault.change(flight, context)

    def change_features(message):
        inside = begin_ns <= message.header.stamp.to_nsec() < end_ns
        return fault.features(message, context.random) if inside else message

    launch = ("ardrone_vslam", "vslam.launch")
    if fault.features or fault.is_loose:
        launch = (LOOSE_LAUNCH, "mapped:=" + ("/relay/features" if fault.features else "features"))
    nodelets = Nodelets(folder, *launch, uses_clock=fault.uses_clock)
    try:
        rospy.init_node("campaign", disable_signals=True)
        player = Player(change_features if fault.features else None)
        player.connect()
        player.play(items, nodelets)
        is_alive = nodelets.is_alive("launch") and nodelets.is_alive("master")
    finally:
        nodelets.stop()
    answers, images = player.answers, of_kind(items, "image")
    last = images[-len(images) // 5:]
    return {"fault": fault.name, "seed": seed, "is_alive": is_alive, "images": player.images_sent,
            "counts": answers.counts(), "uncounted": player.images_sent - sum(answers.counts().values()), "strangers": answers.strangers,
            "answered_last": sum(any(answer.item is item for answer in answers.answers) for item in last) / len(last),
            "odometry_refused": answers.status.odometry_refused if answers.status else 0, "log_lines": answers.log_lines,
            "states": dict(answers.states), "rows": errors_of(answers.answers)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fault", choices=[fault.name for fault in FAULTS])
    for name in ("flight", "other", "folder"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--seed", type=int, required=True)
    arguments = parser.parse_args()
    fault = next(fault for fault in FAULTS if fault.name == arguments.fault)
    result = fly(fault, read_flight(arguments.flight), read_flight(arguments.other), arguments.seed, arguments.folder)
    json.dump(result, sys.stdout)


if __name__ == "__main__":
    main()
