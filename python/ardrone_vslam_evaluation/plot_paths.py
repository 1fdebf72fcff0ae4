# SPDX-License-Identifier: BSD-3-Clause
"""Plots of trajectories and maps, from above, and of heights."""

import numpy as np

from .plot_style import LeftOut, TRUTH, few_of, legend, looks, panels, runs_of


def plane_of(trajectory):
    """Axes seen from above: x and y; of a camera (KITTI) x and z."""
    return ((0, 2), "x, to the right [m]", "z, forward [m]") if trajectory.is_camera else ((0, 1), "x [m]", "y [m]")


def trajectory_of(row):
    """Aligned as --align asks, where there is a truth."""
    return row.trajectory if row.aligned is None else row.aligned


def groups_of(rows):
    """Rows with the same truth share a panel; without one each has its own."""
    groups = []
    for row in rows:
        for group in groups:
            other = group[0].truth
            if row.truth is not None and other is not None and (row.truth is other or np.array_equal(
                    row.truth.positions_m, other.positions_m)):
                group.append(row)
                break
        else:
            groups.append([row])
    return groups


def draw_trajectories(rows):
    look = looks(rows)
    groups, title = few_of(groups_of(rows))
    figure, axes = panels(len(groups), 5.0 if len(groups) > 1 else 6.5, title=title)
    for one, group in zip(axes, groups):
        (x, y), x_label, y_label = plane_of(group[0].trajectory)
        if group[0].truth is not None:
            truth = group[0].truth.positions_m
            one.plot(truth[:, x], truth[:, y], "--", color=TRUTH, linewidth=1.4, label="truth")
        for row in group:
            position = trajectory_of(row).positions_m
            one.plot(position[:, x], position[:, y], linewidth=1.2, **look[row.name])
        start = trajectory_of(group[0]).positions_m[0]
        one.plot(start[x], start[y], "o", color=TRUTH, markersize=4)
        one.set_aspect("equal", adjustable="datalim")
        one.set_xlabel(x_label)
        one.set_ylabel(y_label)
        legend(one)
    return figure


def draw_heights(rows):
    """What a picture from above cannot show."""
    look = looks(rows)
    groups, title = few_of(groups_of(rows))
    figure, axes = panels(len(groups), 3.0, title=title)
    for one, group in zip(axes, groups):
        begin_ns = group[0].start_ns()
        lines = [] if group[0].truth is None else [(group[0].truth, {"linestyle": "--", "color": TRUTH, "label": "truth"})]
        for trajectory, style in lines + [(trajectory_of(row), look[row.name]) for row in group]:
            time = (trajectory.stamps_ns - begin_ns) * 1e-9 if trajectory.has_time else trajectory.stamps_ns
            height_m = -trajectory.positions_m[:, 1] if trajectory.is_camera else trajectory.positions_m[:, 2]
            one.plot(time, height_m, linewidth=1.2, **style)
        one.set_xlabel("time [s]" if group[0].trajectory.has_time else "pose")
        one.set_ylabel("height [m]")
        legend(one)
    return figure


def in_map(run):
    """The fused path from where the place in a loaded map is known: before, the deviation is 1 km."""
    searching = run.frames.get("sigma_m", np.zeros(0)) >= 1000
    if not searching.any() or searching.all():  # if never, its landmarks are in its own frame, too
        return run.fused
    return run.fused.at(~np.isin(run.fused.stamps_ns, run.frames["stamp_ns"][searching]))


def draw_maps(rows):
    """Landmarks, coloured by their deviation, under the path."""
    runs = [row for row in runs_of(rows) if row.run.landmarks and len(row.run.landmarks.get("x_m", ()))]
    if not runs:
        raise LeftOut("no run has landmarks in landmarks.csv")
    runs, title = few_of(runs)
    figure, axes = panels(len(runs), 4.6 if len(runs) > 1 else 6.5, title=title)
    for one, row in zip(axes, runs):
        marks = row.run.landmarks
        deviation = marks.get("sigma_m", np.zeros(len(marks["x_m"])))
        order = np.argsort(-deviation)  # the surest on top
        shown = one.scatter(marks["x_m"][order], marks["y_m"][order], c=deviation[order], s=3, linewidths=0, cmap="viridis_r",
                            vmin=0, vmax=max(np.percentile(deviation, 95), 1e-6), rasterized=True)
        figure.colorbar(shown, ax=one, label="landmark deviation [m]", shrink=0.8)
        paths = [(row.run.truth, TRUTH, "--", "truth"), (row.run.odometry, "#d62728", "-", "odometry"),
                 (in_map(row.run), "#1f77b4", "-", "fused")]
        drawn = [path for path in paths if path[0] is not None]
        for path, colour, style, label in drawn:
            one.plot(path.positions_m[:, 0], path.positions_m[:, 1], style, color=colour, linewidth=1.2, label=label)
        # The path decides what is shown: a few landmarks are always far away.
        everywhere = np.vstack([path[0].positions_m[:, :2] for path in drawn])
        low, high = everywhere.min(axis=0), everywhere.max(axis=0)
        margin = 0.25 * (high - low).max() + 2
        one.set_xlim(low[0] - margin, high[0] + margin)
        one.set_ylim(low[1] - margin, high[1] + margin)
        one.set_aspect("equal", adjustable="datalim")
        one.set_title(f"{row.name}: {len(order)} landmarks")
        one.set_xlabel("x, map [m]")
        one.set_ylabel("y, map [m]")
        legend(one)
    return figure
