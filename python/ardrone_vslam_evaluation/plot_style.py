# SPDX-License-Identifier: BSD-3-Clause
"""What all plots share."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

TRUTH, GREY = "#333333", "#b5b5b5"
ODOMETRIES = ("#d62728", "#ff9896", "#e377c2", "#8c564b")
ESTIMATES = ("#1f77b4", "#2ca02c", "#ff7f0e", "#9467bd", "#17becf", "#bcbd22", "#7f7f7f", "#aec7e8")
WIDTH_IN = 11.0
MOST_PANELS = 8
RUNNING_MEAN_S = 5.0

plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False,
                     "legend.framealpha": 0.8, "svg.hashsalt": "ardrone_vslam", "axes.titlesize": 10, "figure.max_open_warning": 0})


class LeftOut(Exception):
    """A plot's data are not there; the message says which."""


def family_of(row):
    """What many runs have in common."""
    return row.kind if row.kind == "odometry" else row.numbers.get("estimator") or row.kind


def looks(rows):
    """{row's name: colour and label}, the same in all plots. Too many rows for the colours: one for each family."""
    kinds = [row.kind for row in rows]
    is_crowded = kinds.count("estimate") > len(ESTIMATES) or kinds.count("odometry") > len(ODOMETRIES)
    keys = [family_of(row) if is_crowded else row.name for row in rows]
    colours, result = {}, {}
    free = {"odometry": list(ODOMETRIES), "estimate": list(ESTIMATES)}
    for key, row in zip(keys, rows):
        is_first = key not in colours
        if is_first:
            colours[key] = free[row.kind].pop(0) if free[row.kind] else GREY
        label = key if keys.count(key) == 1 else f"{key}, {keys.count(key)} runs"
        result[row.name] = {"color": colours[key], "label": label if is_first else None}
    return result


def few_of(runs):
    """Runs that get a panel of their own, and what to say of the others."""
    if len(runs) <= MOST_PANELS:
        return runs, None
    return runs[:MOST_PANELS], f"the first {MOST_PANELS} of {len(runs)} runs"


def panels(count, height_in, columns=2, title=None, **options):
    """So many axes, at most `columns` side by side; one alone takes the whole width."""
    columns = min(columns, count)
    lines = math.ceil(count / columns)
    figure, axes = plt.subplots(lines, columns, figsize=(WIDTH_IN, height_in * lines), squeeze=False, constrained_layout=True, **options)
    if title:
        figure.suptitle(title, fontsize=10)
    for empty in axes.flat[count:]:
        empty.set_visible(False)
    return figure, list(axes.flat[:count])


def legend(axes, **options):
    """Beside the plot when there are many lines."""
    count = len(axes.get_legend_handles_labels()[1])
    if count > 6:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1), fontsize=8, **options)
    elif count:
        axes.legend(loc="best", **options)


def running_mean(seconds, values, width_s=RUNNING_MEAN_S):
    """Over the window about each stamp; what is not finite counts as not there."""
    is_known = np.isfinite(values)
    sums = np.concatenate([[0.0], np.cumsum(np.where(is_known, values, 0))])
    counts = np.concatenate([[0], np.cumsum(is_known)])
    first = np.searchsorted(seconds, seconds - 0.5 * width_s, side="left")
    last = np.searchsorted(seconds, seconds + 0.5 * width_s, side="right")
    count = counts[last] - counts[first]
    return np.where(count > 0, (sums[last] - sums[first]) / np.maximum(count, 1), np.nan)


def runs_of(rows):
    """Rows that are a run's estimate."""
    runs = [row for row in rows if row.run is not None and row.kind == "estimate"]
    if not runs:
        raise LeftOut("only folders that replay or record_run wrote hold it; these are trajectories")
    return runs


def with_columns(rows, *names):
    """Runs whose frames.csv has all of these columns."""
    runs = [row for row in runs_of(rows) if all(row.run.column(name) is not None for name in names)]
    if not runs:
        raise LeftOut(f"frames.csv lacks {' or '.join(names)}")
    return runs


def frame_seconds(row):
    """Of the run's frames."""
    stamps_ns = row.run.frames["stamp_ns"]
    return (stamps_ns - row.start_ns()) * 1e-9


def logarithmic_y(axes, bottom=None):
    """With plain numbers at 1, 2 and 5, as most plots span little more than a decade; call it when all is drawn."""
    axes.set_yscale("log")
    axes.set_ylim(bottom=bottom)
    axis = axes.yaxis
    low, high = axes.get_ylim()
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 1e3 * low else (1,)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def clear_of_extremes(axes, values):
    """The upper end so that a few wild values do not flatten the rest."""
    values = values[np.isfinite(values)]
    if len(values):
        axes.set_ylim(0, 1.15 * max(np.percentile(values, 99.5), 1e-9))
