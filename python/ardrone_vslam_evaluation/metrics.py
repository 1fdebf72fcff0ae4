# SPDX-License-Identifier: BSD-3-Clause
"""Errors of an estimate against the truth, as tools/trajectory/metrics.cpp and the KITTI development kit define them.

Estimates are Trajectory objects with the truth's poses at equal indices."""

import numpy as np

from .trajectory import NS_PER_S, angles_rad

KITTI_LENGTHS_M = tuple(range(100, 900, 100))
KITTI_START_STEP = 10


def position_errors_m(estimate, truth):
    return np.linalg.norm(estimate.positions_m - truth.positions_m, axis=1)


def summary_of_errors(errors_m):
    errors_m = errors_m[np.isfinite(errors_m)]
    if not len(errors_m):
        return {"rmse_m": None, "mean_m": None, "median_m": None, "max_m": None, "last_m": None}
    return {"rmse_m": np.sqrt(np.mean(errors_m**2)), "mean_m": errors_m.mean(), "median_m": np.median(errors_m),
            "max_m": errors_m.max(), "last_m": errors_m[-1]}


def relative_motions(trajectory, first, last):
    """Of the poses `last` in the frames of the poses `first`: rotations and translations."""
    inverse = np.transpose(trajectory.rotations[first], (0, 2, 1))
    way = (trajectory.positions_m[last] - trajectory.positions_m[first])[:, :, None]
    return inverse @ trajectory.rotations[last], (inverse @ way)[:, :, 0]


def motion_errors(estimate, truth, first, last):
    """Translations [m] and angles [rad] of motion^-1 * true motion."""
    rotation, translation = relative_motions(estimate, first, last)
    true_rotation, true_translation = relative_motions(truth, first, last)
    errors_m = np.linalg.norm(true_translation - translation, axis=1)  # turning does not change the length
    return errors_m, angles_rad(np.transpose(rotation, (0, 2, 1)) @ true_rotation)


def kitti_errors(estimate, truth):
    """t_rel and r_rel over sub-paths of 100, 200 .. 800 m that start at every 10th pose; None below 100 m of way.

    A sub-path ends at the first pose that is further than its length, and is divided by its nominal length."""
    displacement_m = truth.displacement_m()
    starts = np.arange(0, len(truth), KITTI_START_STEP)
    by_length, translations, rotations = [], [], []
    for length_m in KITTI_LENGTHS_M:
        ends = np.searchsorted(displacement_m, displacement_m[starts] + length_m, side="right")
        is_whole = ends < len(truth)
        if not is_whole.any():
            continue
        errors_m, errors_rad = motion_errors(estimate, truth, starts[is_whole], ends[is_whole])
        translations.append(100 * errors_m / length_m)
        rotations.append(np.degrees(errors_rad) / length_m)
        by_length.append({"length_m": length_m, "sub_paths": int(is_whole.sum()), "t_rel_percent": translations[-1].mean(),
                          "r_rel_deg_per_m": rotations[-1].mean()})
    if not by_length:
        return None
    return {"t_rel_percent": np.concatenate(translations).mean(), "r_rel_deg_per_m": np.concatenate(rotations).mean(),
            "sub_paths": sum(entry["sub_paths"] for entry in by_length), "by_length": by_length}


def relative_pose_errors(estimate, truth, passed, step):
    """RPE: from each pose to the one at which `passed` (ascending: seconds, or metres of way) has grown most nearly by `step`.

    Errors are scaled to exactly one step; pairs that are more than half off are left out. None when none is left."""
    after = np.searchsorted(passed, passed + step)
    inside = after < len(passed)
    first, after = np.flatnonzero(inside), after[inside]
    before = np.maximum(after - 1, first)
    is_before_nearer = (passed[first] + step - passed[before]) < (passed[after] - passed[first] - step)
    last = np.where(is_before_nearer, before, after)
    lengths = passed[last] - passed[first]
    is_near = np.abs(lengths - step) <= 0.5 * step
    first, last, lengths = first[is_near], last[is_near], lengths[is_near]
    if not len(first):
        return None
    errors_m, errors_rad = motion_errors(estimate, truth, first, last)
    errors_m, errors_deg = errors_m * step / lengths, np.degrees(errors_rad) * step / lengths
    return {"translation_rmse_m": np.sqrt(np.mean(errors_m**2)), "translation_mean_m": errors_m.mean(),
            "rotation_rmse_deg": np.sqrt(np.mean(errors_deg**2)), "rotation_mean_deg": errors_deg.mean(), "pairs": len(first)}


def relative_pose_errors_over_time(estimate, truth, seconds=1.0):
    passed_s = (truth.stamps_ns - truth.stamps_ns[0]) / NS_PER_S
    return relative_pose_errors(estimate, truth, passed_s, seconds)


def relative_pose_errors_over_way(estimate, truth, metres=1.0):
    return relative_pose_errors(estimate, truth, truth.displacement_m(), metres)


def with_scale_error(positions_m, scale_error):
    """Truth as odometry with this scale error alone reports it: positions about the first one times (1 + error)."""
    return positions_m[0] + (1 + scale_error) * (positions_m - positions_m[0])
