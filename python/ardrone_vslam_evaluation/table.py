# SPDX-License-Identifier: BSD-3-Clause
"""The numbers as a table, for the terminal and for the page."""

from typing import Callable, NamedTuple, Optional

import numpy as np


class Column(NamedTuple):
    heading: str
    key: str  # in a row's numbers, with dots between the levels
    digits: int = 0
    factor: float = 1
    worst: Optional[Callable] = max  # of several runs


SHOWN_MATCHED = (Column("matched", "matched", worst=min),)
RELATIVE = (Column("t_rel [%]", "t_rel_percent", 3), Column("r_rel [deg/m]", "r_rel_deg_per_m", 5),
            Column("RPE 1 s [m]", "rpe_1s.translation_rmse_m", 3), Column("RPE 1 s [deg]", "rpe_1s.rotation_rmse_deg", 3),
            Column("RPE 1 m [m]", "rpe_1m.translation_rmse_m", 3), Column("RPE 1 m [deg]", "rpe_1m.rotation_rmse_deg", 3))
CONSISTENCY = (Column("NEES mean (3)", "nees.mean", 2), Column("inside 3 sigma [%]", "nees.inside_3_sigma", 2, 100, min),
               Column("inside 95 % bounds [%]", "nees.inside_95", 1, 100, min), Column("NIS mean (1)", "nis.mean", 2),
               Column("/ odometry", "ratio", 3), Column("/ odometry, scale removed", "ratio_scale_removed", 3))
COST = (Column("ms median", "cost.ms_per_frame.median", 2), Column("ms 95 %", "cost.ms_per_frame.p95", 2),
        Column("ms max", "cost.ms_per_frame.max", 2), Column("memory [MB]", "cost.peak_rss_mb"),
        Column("features", "cost.features_median", worst=min), Column("landmark matches", "cost.landmark_matches_median", worst=min),
        Column("feature matches", "cost.feature_matches_median", worst=min), Column("landmarks", "cost.landmarks", worst=None))


def look_up(numbers, path):
    """"ate.se3.rmse_m" in nested dictionaries; None where there is no such thing."""
    value = numbers
    for key in path.split("."):
        value = value.get(key) if isinstance(value, dict) else None
    return value


def shown(value, column):
    if value is None:
        return "-"
    return str(value) if isinstance(value, int) and column.factor == 1 else f"{value * column.factor:.{column.digits}f}"


def error_columns(align):
    """After the alignment that was asked for; beside it the RMSE after another one."""
    ate = tuple(Column(name, f"ate.{align}.{key}", 3) for name, key in
                (("ATE RMSE [m]", "rmse_m"), ("mean", "mean_m"), ("median", "median_m"), ("max", "max_m"), ("last", "last_m")))
    others = {"none": (Column("SE(3) RMSE", "ate.se3.rmse_m", 3),), "se3": (Column("unaligned RMSE", "ate.none.rmse_m", 3),),
              "sim3": (Column("SE(3) RMSE", "ate.se3.rmse_m", 3), Column("scale", "scale", 4, 1, None))}
    return SHOWN_MATCHED + ate + others[align] + RELATIVE


def families(rows):
    """{name: rows} of the runs that differ only in their seed, where there are several."""
    found = {}
    for row in rows:
        if row.kind == "estimate" and row.numbers.get("seed") is not None:
            key = tuple(row.numbers.get(name) for name in ("sequence", "profile", "estimator"))
            found.setdefault(key, []).append(row)
    is_one_sequence = len({key[:2] for key in found}) == 1
    return {str(key[2]) if is_one_sequence else ", ".join(map(str, key)): members for key, members in found.items() if len(members) > 1}


def lines_of_families(rows, columns):
    for name, members in families(rows).items():
        for kind in ("median", "worst"):
            cells = []
            for column in columns:
                values = [look_up(row.numbers, column.key) for row in members]
                of_all = np.median if kind == "median" else column.worst
                known = None if None in values or of_all is None else float(of_all(values))
                cells.append(shown(known, column))
            yield [f"{kind} of {len(members)}: {name}"] + cells


def tables(rows, align):
    """(title, headings, lines of cells): one line a row; tables and columns without any number are left out."""
    aligned = {"none": "no alignment", "se3": "SE(3) alignment", "sim3": "Sim(3) alignment"}[align]
    result = []
    for title, columns in ((f"Position error, {aligned}", error_columns(align)),
                           ("Consistency, and no harm to the odometry", CONSISTENCY), ("Cost, medians of the frames", COST)):
        known = [column for column in columns if any(look_up(row.numbers, column.key) is not None for row in rows)]
        lines = [[row.name] + [shown(look_up(row.numbers, column.key), column) for column in known]
                 for row in rows if any(look_up(row.numbers, column.key) is not None for column in known)]
        if lines:
            lines += lines_of_families(rows, known)
            result.append((title, [""] + [column.heading for column in known], lines))
    return result


def as_text(rows, align):
    parts = []
    for title, headings, lines in tables(rows, align):
        widths = [max(len(line[i]) for line in [headings] + lines) for i in range(len(headings))]
        parts.append(title + ":")
        for line in [headings] + lines:
            parts.append("  ".join([line[0].ljust(widths[0])] + [cell.rjust(width) for cell, width in zip(line[1:], widths[1:])]).rstrip())
        parts.append("")
    return "\n".join(parts)
