# SPDX-License-Identifier: BSD-3-Clause
"""How much accuracy is left when there is time for few images only (replay --image-ms)."""

import numpy as np

from .plot_style import ESTIMATES, ODOMETRIES, TRUTH, LeftOut, family_of, legend, panels
from .table import look_up
from .trajectory import NS_PER_S

THESIS_HZ = 1  # what it expected on the drone


def images_per_second(row):
    """That were used; None when it cannot be told."""
    stamps_ns = row.run.frames.get("stamp_ns") if row.run is not None else None
    if stamps_ns is None or len(stamps_ns) < 2:
        return None
    return float((len(stamps_ns) - 1) * NS_PER_S / (stamps_ns[-1] - stamps_ns[0]))


def errors_by_rate(rows):
    """{family: {images per second: [RMSE of each run]}}, runs at the same rate together."""
    result = {}
    for row in rows:
        rate_hz, error_m = images_per_second(row), look_up(row.numbers, "ate.none.rmse_m")
        if rate_hz is not None and error_m is not None:
            result.setdefault(family_of(row), {}).setdefault(round(rate_hz, 2), []).append(error_m)
    return result


def has_several_rates(rows):
    return any(len(by_rate) > 1 for by_rate in errors_by_rate(rows).values())


def draw_error_against_rate(rows):
    known = errors_by_rate(rows)
    if not has_several_rates(rows):
        raise LeftOut("all runs use as many images a second")
    figure, (axes,) = panels(1, 4.2)
    colours = {"odometry": ODOMETRIES[0], **dict(zip((name for name in known if name != "odometry"), ESTIMATES))}
    for name, by_rate in known.items():
        rates = sorted(by_rate)
        colour = colours.get(name, TRUTH)
        for rate_hz in rates:
            axes.plot([rate_hz] * len(by_rate[rate_hz]), by_rate[rate_hz], ".", color=colour, alpha=0.5)
        axes.plot(rates, [np.median(by_rate[rate_hz]) for rate_hz in rates], "--" if name == "odometry" else "o-", markersize=4, color=colour,
                  label=name)
    axes.axvline(THESIS_HZ, color=TRUTH, linewidth=1, linestyle=":", label="the thesis's expectation on the drone")
    axes.set_xscale("log")
    axes.set_yscale("log")
    ticks = sorted({rate_hz for by_rate in known.values() for rate_hz in by_rate} | {THESIS_HZ})
    clear = [tick for i, tick in enumerate(ticks) if i == 0 or tick > 1.15 * ticks[i - 1]]
    axes.set_xticks(clear)
    axes.set_xticklabels([f"{tick:.3g}" for tick in clear])
    axes.set_xticks([], minor=True)
    axes.set_xlabel("images used a second")
    axes.set_ylabel("position error, RMSE without alignment [m]")
    legend(axes)
    return figure
