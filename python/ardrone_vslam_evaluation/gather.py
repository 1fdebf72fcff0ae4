# SPDX-License-Identifier: BSD-3-Clause
"""From files and folders to rows."""

import os
from dataclasses import replace

import numpy as np

from .evaluation import Row, compare_with_odometry, evaluate_row
from .faults import InputFault
from .read_bag import ESTIMATE_TOPICS, TRUTH_TOPICS, read_bag
from .read_text import is_kitti, read_kitti, read_tum
from .run_folder import find_runs, read_run


def is_bag(path):
    if path.endswith(".bag"):
        return True
    if not os.path.isfile(path):
        return False
    try:
        with open(path, "rb") as file:
            return file.read(8) == b"#ROSBAG "
    except OSError:
        return False  # the reader of text tells why


def read_trajectory(path, times, topic, usual_topics, topic_option):
    if os.path.isdir(path):
        raise InputFault(f"{path}: is a folder; name a file of it (a run's folder goes without --truth and --estimate)")
    if is_bag(path):
        return read_bag(path, topic, usual_topics, topic_option)
    return read_kitti(path, times) if is_kitti(path) else read_tum(path)


def short_names(paths):
    """The last parts of the paths, as few as tell them apart."""
    parts = [os.path.abspath(path).split(os.sep) for path in paths]
    for count in range(1, max(len(p) for p in parts) + 1):
        names = ["/".join(p[-count:]) for p in parts]
        if len(set(names)) == len(names):
            break
    return names if len(set(names)) == len(names) else [f"{name} ({i})" for i, name in enumerate(names, start=1)]


def check_names(names, paths, what):
    if names and len(names) != len(paths):
        raise InputFault(f"--name: {len(names)} names for {len(paths)} {what}; give one for each, in the same order")
    if names and len(set(names)) != len(names):
        raise InputFault("--name: two are the same; name each its own way")


def times_beside(truth):
    """KITTI keeps the stamps of poses.txt in times.txt."""
    path = os.path.join(os.path.dirname(os.path.abspath(truth)), "times.txt")
    return path if not is_bag(truth) and os.path.isfile(truth) and is_kitti(truth) and os.path.exists(path) else None


def rows_of_files(arguments, settings):
    times = arguments.times or times_beside(arguments.truth)
    notes = []
    truth = read_trajectory(arguments.truth, times, arguments.truth_topic, TRUTH_TOPICS, "--truth-topic")
    if truth.is_camera and not times:
        notes.append(f"{arguments.truth}: no times.txt beside it and no --times, so poses are paired by their number and there is no "
                     "error over 1 s")
    check_names(arguments.name, arguments.estimate, "estimates")
    names = arguments.name or [os.path.splitext(name)[0] for name in short_names(arguments.estimate)]
    sources = [("odometry", "odometry", arguments.odometry)] if arguments.odometry else []
    sources += [(name, "estimate", path) for name, path in zip(names, arguments.estimate)]
    rows = []
    for name, kind, path in sources:
        option = "--odometry-topic" if kind == "odometry" else "--estimate-topic"
        topic = arguments.odometry_topic if kind == "odometry" else arguments.estimate_topic
        trajectory = read_trajectory(path, times, topic, ESTIMATE_TOPICS if kind == "estimate" else (), option)
        check_kinds(trajectory, truth, times)
        rows.append(Row(name, kind, truth, trajectory))
        evaluate_row(rows[-1], settings)
    odometry = rows[0] if arguments.odometry else None
    for row in rows[1 if odometry else 0:]:
        compare_with_odometry(row, odometry, arguments.odometry_scale_error)
    return rows, notes


def check_kinds(trajectory, truth, times):
    """Stamps that count poses match no clock."""
    if truth.has_time != trajectory.has_time and not times:
        kitti = truth.file if truth.is_camera else trajectory.file
        raise InputFault(f"{kitti}: a KITTI file has no stamps, the other trajectory has; name the times.txt of its images by --times")
    if not truth.has_time and len(truth) != len(trajectory):
        raise InputFault(f"{trajectory.file}: {len(trajectory)} poses for the {len(truth)} of {truth.file}; KITTI files without --times "
                         "are paired line by line: give one pose for each image, or TUM files")


def _same(one, other):
    return (one is not None and other is not None and len(one) == len(other) and np.array_equal(one.stamps_ns, other.stamps_ns)
            and np.array_equal(one.positions_m, other.positions_m))


def _odometry_row(run, rows, name, settings):
    """Of several runs with the same odometry there is one row."""
    for row in rows:
        if row.kind == "odometry" and _same(row.trajectory, run.odometry) and (run.truth is None or _same(row.truth, run.truth)):
            return row
    row = Row(name, "odometry", run.truth, run.odometry, run)
    evaluate_row(row, settings)
    rows.append(row)
    return row


def rows_of_folders(arguments, settings):
    """Odometries before what was made of them."""
    folders = list(dict.fromkeys(run for folder in arguments.folder for run in find_runs(folder)))
    check_names(arguments.name, folders, "runs")
    names = arguments.name or short_names(folders)
    runs = [read_run(folder) for folder in folders]
    if not arguments.name:
        estimators = [run.summary.get("estimator") for run in runs]
        names = [f"{name} ({estimator})" if estimator and estimator not in name else name for name, estimator in zip(names, estimators)]
    odometries, estimates, notes = [], [], []
    for name, run in zip(names, runs):
        if run.summary.get("is_finished") is False:
            notes.append(f"{name}: the run was interrupted, so its numbers are of the part that it had done")
        its_rows = [Row(name, "estimate", run.truth, run.fused, run)]
        if run.refined is not None:  # frames and landmarks are those of the flight
            refined = replace(run, fused=run.refined, frames={}, landmarks={}, summary={})
            its_rows.append(Row(f"{name}, refined", "estimate", run.truth, run.refined, refined))
        estimates += its_rows
        for row in its_rows:
            evaluate_row(row, settings)
            for key in ("sequence", "profile", "seed", "estimator"):
                row.numbers[key] = run.summary.get(key)
        if run.refined is not None:
            its_rows[1].numbers["estimator"] = "refined"
        if run.odometry is None:
            notes.append(f"{name}: no odometry.tum, so no comparison with the odometry")
            continue
        odometry = _odometry_row(run, odometries, f"odometry of {name}", settings)
        is_truth = run.summary.get("profile") == "truth"  # nothing to compare with, as in replay
        in_loaded_map = run.summary.get("map_found_s") is not None  # whose scale is not this odometry's
        for row in its_rows:
            compare_with_odometry(row, None if is_truth else odometry, None if in_loaded_map else run.summary.get("odometry_scale_error"))
    if len(odometries) == 1:
        odometries[0].name = odometries[0].numbers["name"] = "odometry"
    notes_of_odometries(odometries)
    return in_groups(odometries, estimates), notes


def notes_of_odometries(odometries):
    """What lacks is told once, of the run itself."""
    for odometry in odometries:
        odometry.notes.clear()


def in_groups(odometries, estimates):
    """Each odometry followed by its estimates."""
    rows = []
    for odometry in odometries:
        rows.append(odometry)
        rows += [row for row in estimates if _same(row.run.odometry, odometry.trajectory) and row not in rows]
    return rows + [row for row in estimates if row not in rows]
