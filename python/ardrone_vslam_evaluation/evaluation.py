# SPDX-License-Identifier: BSD-3-Clause
"""One row of the tables: all numbers of one estimate against one truth."""

from dataclasses import dataclass, field
from typing import Optional

import numpy as np

from . import consistency, metrics
from .align import alignment_of
from .associate import Pairs, associate
from .run_folder import RunFolder
from .trajectory import Trajectory


@dataclass(frozen=True)
class Settings:
    align: str = "se3"
    max_difference_s: float = 0.02
    interpolate: bool = False


@dataclass
class Row:
    """What belongs to one estimate, or to the odometry that it began with."""

    name: str
    kind: str  # "estimate" or "odometry"
    truth: Optional[Trajectory]
    trajectory: Trajectory
    run: Optional[RunFolder] = None
    pairs: Optional[Pairs] = None
    aligned: Optional[Trajectory] = None  # pairs.estimate, as --align asks
    errors_m: Optional[np.ndarray] = None  # of `aligned`
    nees: Optional[np.ndarray] = None  # of `nees_stamps_ns`
    nees_stamps_ns: Optional[np.ndarray] = None
    numbers: dict = field(default_factory=dict)  # what goes into the JSON file
    notes: list = field(default_factory=list)

    def start_ns(self):
        first = [self.trajectory.stamps_ns[0]] + ([] if self.truth is None else [self.truth.stamps_ns[0]])
        return min(first)


def _unmatched_note(row, settings):
    pairs = row.pairs
    if not pairs.unmatched_estimate and not pairs.unmatched_truth:
        return
    row.notes.append(f"{row.name}: {pairs.unmatched_estimate} of {len(row.trajectory)} poses have no truth within "
                     f"{settings.max_difference_s:g} s and are left out; {pairs.unmatched_truth} of {len(row.truth)} poses of "
                     "the truth have no estimate")


def _ate(row, settings):
    kinds = ("none", "se3", "sim3") if settings.align == "sim3" else ("none", "se3")
    alignments = {kind: alignment_of(row.pairs, kind) for kind in kinds}
    row.numbers["ate"] = {}
    for kind, alignment in alignments.items():
        if alignment is None:
            row.notes.append(f"{row.name}: does not move with the truth, so it has no scale: no error after {kind}")
            continue
        errors_m = metrics.position_errors_m(alignment.apply(row.pairs.estimate), row.pairs.truth)
        row.numbers["ate"][kind] = metrics.summary_of_errors(errors_m)
    chosen = alignments[settings.align] or alignments["se3"]
    row.aligned = chosen.apply(row.pairs.estimate)
    row.errors_m = metrics.position_errors_m(row.aligned, row.pairs.truth)
    row.numbers["align"] = settings.align
    row.numbers["scale"] = alignments["sim3"].scale if alignments.get("sim3") else None


def _relative(row):
    estimate, truth = row.aligned, row.pairs.truth
    kitti = metrics.kitti_errors(estimate, truth)
    row.numbers["t_rel_percent"] = kitti["t_rel_percent"] if kitti else None
    row.numbers["r_rel_deg_per_m"] = kitti["r_rel_deg_per_m"] if kitti else None
    row.numbers["kitti"] = kitti
    has_time = truth.has_time and estimate.has_time
    row.numbers["rpe_1s"] = metrics.relative_pose_errors_over_time(estimate, truth) if has_time else None
    row.numbers["rpe_1m"] = metrics.relative_pose_errors_over_way(estimate, truth)


def _nees(row):
    """The run's own numbers where there are some; else by the covariances that came with the poses."""
    own = row.run.column("nees") if row.run is not None and row.kind == "estimate" else None
    if own is not None:
        row.nees, row.nees_stamps_ns = own, row.run.frames["stamp_ns"]
    elif row.pairs is not None:
        row.nees, row.nees_stamps_ns = consistency.nees_of(row.aligned, row.pairs.truth), row.pairs.estimate.stamps_ns
    row.numbers["nees"] = None if row.nees is None else consistency.summary_of_nees(row.nees)
    fixes = row.run.column("fix_nis") if row.run is not None and row.kind == "estimate" else None
    row.numbers["nis"] = None if fixes is None else consistency.summary_of_nis(fixes)


def _spread(values):
    values = values[np.isfinite(values)]
    if not len(values):
        return None
    return {"median": np.median(values), "p95": np.percentile(values, 95), "max": values.max()}


def _cost(run):
    stages = run.stages()
    total = run.column("ms_total")
    if total is None and stages:
        total = np.sum(list(stages.values()), axis=0)
    counts = {name: run.column(name) for name in ("features", "landmark_matches", "feature_matches", "landmarks")}
    return {"ms_per_frame": None if total is None else _spread(total),
            "ms_per_stage": {name: _spread(values) for name, values in stages.items()},
            "peak_rss_mb": run.summary.get("peak_rss_mb"),
            "features_median": None if counts["features"] is None else np.median(counts["features"]),
            "landmark_matches_median": None if counts["landmark_matches"] is None else np.median(counts["landmark_matches"]),
            "feature_matches_median": None if counts["feature_matches"] is None else np.median(counts["feature_matches"]),
            "landmarks": len(run.landmarks.get("x_m", ())) if run.landmarks else
            (None if counts["landmarks"] is None else int(counts["landmarks"][-1]))}


def evaluate_row(row, settings):
    """Fills what the row lacks."""
    row.numbers.update(name=row.name, kind=row.kind, file=row.trajectory.file, poses=len(row.trajectory),
                       truth=None if row.truth is None else row.truth.file)
    if row.truth is None:
        row.notes.append(f"{row.name}: no truth, so no errors")
    else:
        row.pairs = associate(row.trajectory, row.truth, settings.max_difference_s, settings.interpolate)
        row.numbers.update(matched=len(row.pairs.truth), unmatched=row.pairs.unmatched_estimate,
                           unmatched_truth=row.pairs.unmatched_truth)
        _unmatched_note(row, settings)
        _ate(row, settings)
        _relative(row)
    _nees(row)
    if row.run is not None and row.kind == "estimate":
        row.numbers["cost"] = _cost(row.run)


def compare_with_odometry(row, odometry, scale_error):
    """No harm: errors without alignment over the odometry's, as they are and with the odometry's scale error taken from both."""
    row.numbers["ratio"] = row.numbers["ratio_scale_removed"] = None
    if row.pairs is None or odometry is None or odometry.pairs is None:
        return

    def rmse(one, error):
        truth_m = one.pairs.truth.positions_m
        if error:
            truth_m = metrics.with_scale_error(truth_m, error)
        return metrics.summary_of_errors(np.linalg.norm(one.pairs.estimate.positions_m - truth_m, axis=1))["rmse_m"]

    if rmse(odometry, 0) > 0:
        row.numbers["ratio"] = rmse(row, 0) / rmse(odometry, 0)
    if scale_error is not None and rmse(odometry, scale_error) > 0:
        row.numbers["ratio_scale_removed"] = rmse(row, scale_error) / rmse(odometry, scale_error)
