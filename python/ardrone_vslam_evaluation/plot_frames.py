# SPDX-License-Identifier: BSD-3-Clause
"""Plots of what frames.csv tells: matches and times."""

import numpy as np

from .plot_style import (GREY, LeftOut, clear_of_extremes, few_of, frame_seconds, legend, logarithmic_y, looks, panels, running_mean, runs_of,
                         with_columns)

LINES_OF_MATCHES = (("landmark_candidates", GREY, "landmarks, with mismatches"),
                    ("landmark_matches", "#1f77b4", "landmarks, mismatches removed"),
                    ("feature_candidates", "#a8d5a8", "features, with mismatches"),
                    ("feature_matches", "#2ca02c", "features, mismatches removed"))
MOST_POINTS = 5000  # of a scatter plot


def draw_matches_over_time(rows):
    runs, title = few_of(with_columns(rows, "landmark_candidates", "landmark_matches"))
    figure, axes = panels(len(runs), 3.2 if len(runs) > 1 else 4.0, title=title)
    for one, row in zip(axes, runs):
        seconds, frames = frame_seconds(row), row.run.frames
        for name, colour, label in LINES_OF_MATCHES:
            if row.run.column(name) is None:
                continue
            one.plot(seconds, frames[name], color=colour, linewidth=0.5, alpha=0.25)
            one.plot(seconds, running_mean(seconds, frames[name], 1.0), color=colour, linewidth=1.3, label=label)
        clear_of_extremes(one, frames["landmark_candidates"])
        one.set_title(row.name)
        one.set_xlabel("time [s]")
        one.set_ylabel("matches a frame")
    legend(axes[0])
    return figure


def errors_of_frames(row):
    """Of the fused position at each frame, NaN where the truth does not cover it."""
    own = row.run.column("fused_error_m")
    if own is not None:
        return own
    if row.pairs is None or len(row.trajectory) != len(row.run.frames.get("stamp_ns", ())):
        return None
    errors = np.full(len(row.trajectory), np.nan)
    errors[row.pairs.indices] = row.errors_m
    return errors


def draw_error_against_matches(rows):
    runs = [row for row in with_columns(rows, "landmark_matches") if errors_of_frames(row) is not None]
    if not runs:
        raise LeftOut("there is no truth")
    look = looks(rows)
    runs, title = few_of(runs)
    figure, axes = panels(len(runs), 3.4 if len(runs) > 1 else 4.2, title=title)
    for one, row in zip(axes, runs):
        matches, errors = row.run.frames["landmark_matches"], errors_of_frames(row)
        step = max(1, len(matches) // MOST_POINTS)
        one.plot(matches[::step], errors[::step], ".", markersize=3, alpha=0.5, rasterized=True, color=look[row.name]["color"])
        bins = np.unique(np.percentile(matches, np.linspace(0, 100, 11)))
        if len(bins) > 2:
            place = np.clip(np.searchsorted(bins, matches, side="right") - 1, 0, len(bins) - 2)
            middles = [0.5 * (bins[i] + bins[i + 1]) for i in range(len(bins) - 1)]
            medians = [np.nanmedian(errors[place == i]) if np.isfinite(errors[place == i]).any() else np.nan
                       for i in range(len(bins) - 1)]
            one.plot(middles, medians, "o-", color="#333333", markersize=4, linewidth=1.2, label="median of each tenth of the frames")
        one.set_title(row.name)
        one.set_xlabel("landmark matches")
        one.set_ylabel("position error [m]")
        one.set_ylim(bottom=0)
        one.set_xlim(left=0)
    legend(axes[0])
    return figure


def draw_histogram_of_matches(rows):
    runs, look = with_columns(rows, "landmark_matches"), looks(rows)
    figure, (axes,) = panels(1, 3.4)
    most = max(row.run.frames["landmark_matches"].max() for row in runs)
    edges = np.linspace(0, max(most, 1), 41)
    for row in runs:
        share = np.full(len(row.run.frames["landmark_matches"]), 100 / len(row.run.frames["landmark_matches"]))
        axes.hist(row.run.frames["landmark_matches"], bins=edges, weights=share, histtype="stepfilled", alpha=0.25, color=look[row.name]["color"])
        axes.hist(row.run.frames["landmark_matches"], bins=edges, weights=share, histtype="step", linewidth=1.5, **look[row.name])
    axes.set_xlabel("landmark matches a frame, mismatches removed")
    axes.set_ylabel("frames [%]")
    legend(axes)
    return figure


def draw_stage_times(rows):
    """Bars: means, as a stage that works in few frames has a median of nothing; beside them all stages over time."""
    runs = [row for row in runs_of(rows) if row.run.stages()]
    if not runs:
        raise LeftOut("frames.csv lacks stage times (columns ms_*)")
    look = looks(rows)
    figure, (bars, lines) = panels(2, 3.8)
    stages = list(dict.fromkeys(name for row in runs for name in row.run.stages()))
    width = 0.8 / len(runs)
    for i, row in enumerate(runs):
        times = row.run.stages()
        x = np.arange(len(stages)) + (i - 0.5 * (len(runs) - 1)) * width
        means = [np.nanmean(times[name]) if name in times else 0 for name in stages]
        p95 = [np.nanpercentile(times[name], 95) if name in times else 0 for name in stages]
        bars.bar(x, means, width, **look[row.name])
        bars.plot(x, p95, "_", color="#333333", markersize=9, label="95 %" if i == 0 else None)
        total = np.sum(list(times.values()), axis=0)
        lines.plot(frame_seconds(row), total, linewidth=0.8, color=look[row.name]["color"])
    bars.set_xticks(np.arange(len(stages)))
    bars.set_xticklabels(stages, rotation=30 if len(stages) > 6 else 0)
    bars.set_ylabel("mean time a frame [ms]")
    logarithmic_y(lines)
    lines.set_xlabel("time [s]")
    lines.set_ylabel("all stages, a frame [ms]")
    legend(bars)
    return figure
