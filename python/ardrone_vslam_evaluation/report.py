# SPDX-License-Identifier: BSD-3-Clause
"""One page with tables and plots in it, which needs no network."""

import base64
import html
import io
import os
from dataclasses import dataclass
from typing import Callable

import matplotlib.pyplot as plt

from .faults import MachineFault, reason
from .plot_errors import draw_error_over_length, draw_error_over_time, draw_nees, draw_nis, draw_odometry_noise
from .plot_frames import draw_error_against_matches, draw_histogram_of_matches, draw_matches_over_time, draw_stage_times
from .plot_paths import draw_heights, draw_maps, draw_trajectories
from .plot_rates import draw_error_against_rate, has_several_rates
from .plot_style import LeftOut
from .table import tables
from .verdict import consistency_of, told_of


@dataclass
class Figure:
    name: str
    title: str
    caption: str
    draw: Callable
    picture: object = None  # of matplotlib
    left_out: str = ""  # why there is none


def all_figures(rows):
    """Those that compare rates only where there are several."""
    rates = Figure("error_against_rate", "Accuracy against images used a second", "A dot is a run, the lines go through the medians. Fewer images "
                   "than there are: replay --image-ms or --cpu-factor.", draw_error_against_rate)
    return ([rates] if has_several_rates(rows) else []) + [
        Figure("trajectories", "Trajectories", "From above. The dot is the start.", draw_trajectories),
        Figure("heights", "Heights", "Upwards, from where the frame's origin is.", draw_heights),
        Figure("error_over_time", "Position error over time", "Thick: mean over 5 s (poses without stamps: over 50). The "
               "smallest hundredth of the errors is below the picture.", draw_error_over_time),
        Figure("error_over_length", "Error by length of the way", "Sub-paths from every 10th pose, as in the KITTI development kit.",
               draw_error_over_length),
        Figure("matches_over_time", "Matches over time", "With mismatches, and after their removal. Thick: mean over 1 s.", draw_matches_over_time),
        Figure("error_against_matches", "Error against matches", "A dot is a frame.", draw_error_against_matches),
        Figure("histogram_of_matches", "How many matches", "Of the landmarks, after the removal of mismatches.", draw_histogram_of_matches),
        Figure("maps", "Map", "From above; landmarks are coloured by their deviation. Landmarks far away are outside the picture.", draw_maps),
        Figure("nees", "Consistency: NEES", "Squared error over the claimed variance. Above the band: over-confident, below: too modest. "
               "Thick: mean over 5 s.", draw_nees),
        Figure("nis", "Consistency: NIS", "Squared deviations of the fixes over what is expected, a running mean of about ten fixes, from the "
               "first one on. frames.csv does not tell their number, so there are no bounds.", draw_nis),
        Figure("odometry_noise", "Tracks, and what they say of the odometry", "Left: squared deviations of the tracks over what is expected, "
               "mean over 5 s. Right: the odometry's slow velocity error, as learned so far.", draw_odometry_noise),
        Figure("stage_times", "Stage times", "Decoding of images is not in it.", draw_stage_times),
    ]


def draw(rows):
    figures = all_figures(rows)
    for figure in figures:
        try:
            figure.picture = figure.draw(rows)
        except LeftOut as fault:
            figure.left_out = str(fault)
    return figures


def write_pictures(figures, folder):
    try:
        os.makedirs(folder, exist_ok=True)
        for figure in figures:
            if figure.picture is not None:
                figure.picture.savefig(os.path.join(folder, f"{figure.name}.png"), dpi=110, metadata={"Software": None})
    except OSError as error:
        raise MachineFault(f"{folder}: cannot be written ({reason(error)}); choose another --figures") from None


def as_image(figure):
    """As an image of its own: its names cannot meet those of the next plot."""
    buffer = io.BytesIO()
    figure.picture.savefig(buffer, format="svg", dpi=150, metadata=dict.fromkeys(("Date", "Creator", "Format", "Type")))
    plt.close(figure.picture)
    data = base64.b64encode(buffer.getvalue()).decode("ascii")
    return f'<img alt="{html.escape(figure.title)}" src="data:image/svg+xml;base64,{data}">'


STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; color: #222; background: #fff; max-width: 1150px; margin: 2em auto; padding: 0 1em }
h1 { font-size: 1.5em } h2 { font-size: 1.15em; margin-top: 2em; border-bottom: 1px solid #ddd }
.wide { overflow-x: auto } table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 13px }
th, td { padding: 3px 9px; text-align: right; border-bottom: 1px solid #e6e6e6 } th { vertical-align: bottom; font-weight: 600 }
th:first-child, td:first-child { text-align: left; white-space: nowrap } td { white-space: nowrap }
img { width: 100%; height: auto } p.caption, ul { color: #555; font-size: 13px } p.none { color: #8a5a00 }
"""


def _table(headings, lines):
    head = "".join(f"<th>{html.escape(text)}</th>" for text in headings)
    body = "\n".join("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in line) + "</tr>" for line in lines)
    return f'<div class="wide"><table>\n<tr>{head}</tr>\n{body}\n</table></div>'


def _facts(rows):
    """What was compared with what; of runs also where they come from."""
    lines = []
    for row in rows:
        parts = [row.trajectory.file] + ([f"against {row.truth.file}"] if row.truth is not None else ["no truth"])
        known = [f"{key} {row.numbers[key]}" for key in ("sequence", "profile", "seed", "estimator") if row.numbers.get(key) is not None]
        lines.append(f"<li><b>{html.escape(row.name)}</b>: {html.escape('; '.join(parts + known))}</li>")
    return "<ul>\n" + "\n".join(lines) + "\n</ul>"


def page(rows, figures, notes, align, version):
    title = ", ".join(row.name for row in rows if row.kind == "estimate")
    parts = [f"<h1>Evaluation: {html.escape(title)}</h1>"]
    for row, verdict in told_of(rows):
        parts.append(f"<p><b>{html.escape(row.name)}</b>: {html.escape(' '.join(filter(None, (verdict, consistency_of(row)))))}</p>")
    for name, headings, lines in tables(rows, align):
        parts.append(f"<h2>{html.escape(name)}</h2>\n{_table(headings, lines)}")
    if notes:
        parts.append("<h2>Notes</h2>\n<ul>\n" + "\n".join(f"<li>{html.escape(note)}</li>" for note in notes) + "\n</ul>")
    for figure in figures:
        shown = (f'<p class="none">Left out: {html.escape(figure.left_out)}.</p>' if figure.picture is None else
                 f'{as_image(figure)}\n<p class="caption">{html.escape(figure.caption)}</p>')
        parts.append(f"<h2>{html.escape(figure.title)}</h2>\n{shown}")
    parts.append(f"<h2>What was read</h2>\n{_facts(rows)}\n<p class=\"caption\">evaluate {html.escape(version)}</p>")
    body = "\n".join(parts)
    return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>{html.escape(title)}</title>\n'
            f"<style>{STYLE}</style>\n</head>\n<body>\n{body}\n</body>\n</html>\n")
