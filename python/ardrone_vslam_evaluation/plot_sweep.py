# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a sweep: a small panel for each parameter."""

import io
import os

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image  # matplotlib writes its PNG files with it

from .command import write_bytes
from .parameters import is_same
from .plot_style import ESTIMATES, TRUTH, panels
from .sweep import OVERCONFIDENT_SHARE

COLUMNS, PANEL_HEIGHT_IN, DPI, COLOURS = 4, 1.75, 90, 48
LIMITS = (0.4, 4.0)  # what is beyond is drawn as a triangle at the edge
TICKS = (0.5, 0.7, 1, 1.5, 2, 3, 4)


def colours_of(groups):
    """{case's name: its colour}, the same in all pictures; thesis's cases, which no other picture has, begin anew."""
    result = {}
    for group in groups:
        own = list(dict.fromkeys(case.name for panel in group.panels for case, _ in panel.lines))
        for name in own:
            free = [colour for colour in ESTIMATES if colour not in [result.get(other) for other in own]]
            result.setdefault(name, free[0] if free else TRUTH)
    return result


def positions(panel, points):
    """Equal steps: the values go from 0 to thousands, or are words."""
    values = panel.values()
    return [next(i for i, value in enumerate(values) if is_same(value, point.value)) for point in points]


def prepare(axes, panel):
    values = panel.values()
    default = next(i for i, value in enumerate(values) if is_same(value, panel.default))
    axes.axvline(default, color=TRUTH, linewidth=0.9, linestyle=":")
    axes.set_xticks(range(len(values)))
    axes.set_xticklabels(values, fontsize=7)
    axes.set_xlim(-0.4, len(values) - 0.6)
    axes.set_title(panel.name + (f" [{panel.unit}]" if panel.unit not in ("", "-", "switch", "choice") else ""), fontsize=8)
    axes.tick_params(axis="y", labelsize=7)


def draw_line(axes, x, measured, colour):
    low, high = LIMITS
    change = np.array([m.change() for m in measured])
    axes.plot(x, np.clip(change, low, high), "-", color=colour, linewidth=1.2, clip_on=False)
    axes.vlines(x, [np.clip(min(m.relative), low, high) for m in measured], [np.clip(max(m.relative), low, high) for m in measured], color=colour,
                linewidth=3, alpha=0.3)
    for at, value, m in zip(x, change, measured):
        mark = "^" if value > high else "v" if value < low else "o"
        axes.plot(at, np.clip(value, low, high), mark, color=colour, markersize=4.5, markerfacecolor="white" if m.is_overconfident() else colour,
                  clip_on=False, zorder=3)


def legend_above(figure, shown):
    """In a strip of its own, as matplotlib 3.6 has no legend outside of the panels."""
    height = 0.3 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - height))
    figure.legend(shown.values(), shown.keys(), loc="upper center", ncol=max(len(shown), 1), fontsize=8, frameon=False)


def label_rows(axes, text):
    for one in axes[::COLUMNS]:
        one.set_ylabel(text, fontsize=7)


def draw_errors(group, results, colours):
    figure, axes = panels(len(group.panels), PANEL_HEIGHT_IN, COLUMNS)
    shown = {}
    for one, panel in zip(axes, group.panels):
        prepare(one, panel)
        for i, (case, points) in enumerate(panel.lines):
            known = [point for point in points if (case, point) in results]
            x = np.array(positions(panel, known), dtype=float) + 0.02 * len(panel.values()) * (i - 0.5 * (len(panel.lines) - 1))
            if known:
                draw_line(one, x, [results[case, point] for point in known], colours[case.name])
                shown[case.name] = plt.Line2D([], [], color=colours[case.name], marker="o", markersize=4)
        one.axhline(1, color=TRUTH, linewidth=0.6)
        one.set_yscale("log")
        one.set_ylim(*LIMITS)
        one.set_yticks(TICKS)
        one.set_yticklabels([f"{tick:g}" for tick in TICKS])
        one.set_yticks([], minor=True)
    marks = {f"over {OVERCONFIDENT_SHARE:.0%} of the images outside 3 sigma": plt.Line2D([], [], color=TRUTH, marker="o", markersize=4.5, linestyle="",
                                                                                     markerfacecolor="white"),
             "default": plt.Line2D([], [], color=TRUTH, linewidth=0.9, linestyle=":")}
    shown.update(marks)
    legend_above(figure, shown)
    label_rows(axes, "error, times\nthe default's")
    return figure


def draw_costs(costs, colours):
    """@param costs {(panel, case, point): ms of an image}"""
    chosen = list(dict.fromkeys(panel for panel, _, _ in costs))
    figure, axes = panels(len(chosen), PANEL_HEIGHT_IN, COLUMNS)
    shown = {}
    for one, panel in zip(axes, chosen):
        prepare(one, panel)
        for case, points in panel.lines:
            known = [point for point in points if (panel, case, point) in costs]
            if known:
                one.plot(positions(panel, known), [costs[panel, case, point] for point in known], "o-", color=colours[case.name], markersize=4,
                         linewidth=1.2)
                shown[case.name] = plt.Line2D([], [], color=colours[case.name], marker="o", markersize=4)
        one.set_ylim(0, 1.1 * one.get_ylim()[1])
    label_rows(axes, "an image,\nmedian [ms]")
    legend_above(figure, shown)
    return figure


def save(figure, path):
    """Few colours: small files, and the same bytes each time."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=DPI, metadata={"Software": None})
    plt.close(figure)
    buffer.seek(0)
    small = io.BytesIO()
    Image.open(buffer).convert("RGB").quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(small, "PNG", optimize=True)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    write_bytes(path, small.getvalue())
