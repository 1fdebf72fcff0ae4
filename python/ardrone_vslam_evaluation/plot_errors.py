# SPDX-License-Identifier: BSD-3-Clause
"""Plots of errors over time and way, and of their consistency."""

import numpy as np

from .consistency import NEES_3_SIGMA, bounds_95, DEGREES, is_after_first_fix
from .plot_style import LeftOut, RUNNING_MEAN_S, TRUTH, legend, logarithmic_y, looks, panels, running_mean, runs_of

SMALLEST_SHOWN_M = 1e-4  # both begin at the same pose, whose error of zero has no logarithm


def draw_error_over_time(rows):
    known = [row for row in rows if row.errors_m is not None]
    if not known:
        raise LeftOut("there is no truth")
    look = looks(rows)
    figure, (axes,) = panels(1, 4.2)
    has_time = all(row.trajectory.has_time for row in known)
    for row in known:
        x = row.pairs.seconds(row.start_ns())
        errors = np.maximum(row.errors_m, SMALLEST_SHOWN_M)
        axes.plot(x, errors, linewidth=0.6, alpha=0.45, color=look[row.name]["color"])
        width = RUNNING_MEAN_S if has_time else 50
        axes.plot(x, running_mean(x, errors, width), linewidth=1.8, **look[row.name])
    errors = np.concatenate([row.errors_m for row in known])
    logarithmic_y(axes, max(0.5 * np.nanpercentile(errors, 1), SMALLEST_SHOWN_M))
    axes.grid(which="both", alpha=0.2)
    axes.set_xlabel("time [s]" if has_time else "pose")
    axes.set_ylabel("position error [m]")
    legend(axes)
    return figure


def draw_error_over_length(rows):
    known = [row for row in rows if row.numbers.get("kitti")]
    if not known:
        raise LeftOut("no truth with 100 m of way")
    look = looks(rows)
    figure, (translation, rotation) = panels(2, 3.6)
    for row in known:
        parts = row.numbers["kitti"]["by_length"]
        lengths = [part["length_m"] for part in parts]
        translation.plot(lengths, [part["t_rel_percent"] for part in parts], "o-", markersize=4, **look[row.name])
        rotation.plot(lengths, [part["r_rel_deg_per_m"] for part in parts], "o-", markersize=4, color=look[row.name]["color"])
    for axes, label in ((translation, "translation error [%]"), (rotation, "rotation error [deg/m]")):
        axes.set_ylim(bottom=0)
        axes.set_xlabel("length of the sub-path [m]")
        axes.set_ylabel(label)
    legend(translation)
    return figure


def draw_nees(rows):
    known = [row for row in rows if row.numbers.get("nees")]
    if not known:
        raise LeftOut("the trajectories have no covariance, or no truth (frames.csv: column nees)")
    look = looks(rows)
    figure, (axes,) = panels(1, 4.2)
    low, high = bounds_95(DEGREES)
    axes.axhspan(low, high, color="#2ca02c", alpha=0.10, linewidth=0, label="95 % of an honest filter's")
    axes.axhline(DEGREES, color=TRUTH, linewidth=1, linestyle="--", label="expected mean: 3")
    axes.axhline(NEES_3_SIGMA, color=TRUTH, linewidth=1, linestyle=":", label="3 sigma: 14.16")
    for row in known:
        seconds = (row.nees_stamps_ns - row.start_ns()) * 1e-9
        values = np.maximum(row.nees, 1e-2)
        axes.plot(seconds, values, linewidth=0.5, alpha=0.4, color=look[row.name]["color"])
        axes.plot(seconds, running_mean(seconds, row.nees), linewidth=1.8, **look[row.name])
    logarithmic_y(axes, 1e-2)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("NEES of the position")
    legend(axes)
    return figure


def draw_nis(rows):
    known = [row for row in rows if row.numbers.get("nis")]
    if not known:
        if any(row.run is not None and row.run.column("fix_nis") is not None for row in rows):
            raise LeftOut("no landmark of an earlier visit gave a fix")
        raise LeftOut("frames.csv lacks fix_nis (the filter of the thesis has no fixes in that sense)")
    look = looks(rows)
    figure, (axes,) = panels(1, 3.2)
    axes.axhline(1, color=TRUTH, linewidth=1, linestyle="--", label="honest: 1")
    for row in known:
        seconds = (row.run.frames["stamp_ns"] - row.start_ns()) * 1e-9
        values = row.run.column("fix_nis")
        axes.plot(seconds, np.where(is_after_first_fix(values), values, np.nan), linewidth=1.2, **look[row.name])
    axes.set_ylim(bottom=0)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("NIS of the fixes")
    legend(axes)
    return figure


def draw_odometry_noise(rows):
    known = [row for row in runs_of(rows) if row.run.column("track_nis") is not None
             and np.isfinite(row.run.column("track_nis")).any()]
    if not known:
        raise LeftOut("frames.csv has no track_nis (with estimator msckf alone)")
    look = looks(rows)
    figure, (nis, bias) = panels(2, 3.2)
    nis.axhline(1, color=TRUTH, linewidth=1, linestyle="--", label="honest: 1")
    for row in known:
        seconds = (row.run.frames["stamp_ns"] - row.start_ns()) * 1e-9
        nis.plot(seconds, running_mean(seconds, row.run.column("track_nis")), linewidth=1.2, **look[row.name])
        bias.plot(seconds, row.run.column("velocity_bias_sigma_m_s"), linewidth=1.2, **look[row.name])
    for axes, label in ((nis, "NIS of the tracks"), (bias, "velocity bias counted with [m/s]")):
        axes.set_ylim(bottom=0)
        axes.set_xlabel("time [s]")
        axes.set_ylabel(label)
    legend(nis)
    return figure
