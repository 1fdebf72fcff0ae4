# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a table against those of an earlier one: what is worse by more than a margin is named."""

import json

from .faults import InputFault, reason

KEY = ("sequence", "profile", "estimator", "seeds")
# Row's key -> (its name, what of a difference is too small to count).
WATCHED = {"fused_rmse_m": ("fused RMSE [m]", 0.005), "ratio": ("fused / odometry", 0.01),
           "ratio_scale_removed": ("fused / odometry, scale removed", 0.01), "nees": ("NEES / 3", 0.3),
           "outside_3_sigma": ("outside 3 sigma", 0.02)}
MARGIN = 0.1


def key_of(row):
    return tuple(row[name] for name in KEY)


def as_json(rows):
    """One row a line, so that a change shows as its lines."""
    names = KEY + ("frames",) + tuple(WATCHED)
    kept = [{name: round(row[name], 6) if isinstance(row[name], float) else row[name] for name in names} for row in rows]
    return '{"rows": [\n' + ",\n".join(json.dumps(row) for row in kept) + "\n]}\n"


def read(path):
    """{key: row}"""
    try:
        with open(path, encoding="utf-8") as file:
            rows = json.load(file)["rows"]
        for row in rows:
            for name in KEY + ("frames",) + tuple(WATCHED):
                row[name]
        return {key_of(row): row for row in rows}
    except OSError as error:
        raise InputFault(f"{path}: cannot be read ({reason(error)}); check --baseline") from None
    except (ValueError, KeyError, TypeError) as error:
        raise InputFault(f"{path}: is no baseline ({error!r}); write one by --update") from None


def is_above(value, limit, small, margin):
    return value - limit > margin * abs(limit) + small


def compare(rows, before, margin):
    """@return (texts about what is worse, what is better, how many rows were compared)"""
    worse, better, compared = [], [], 0
    for row in rows:
        old = before.get(key_of(row))
        if old is None:
            continue
        compared += 1
        name = " ".join(key_of(row)[:3])
        if row["frames"] < old["frames"]:
            worse.append(f"{name}: frames {old['frames']} -> {row['frames']}")
        for key, (what, small) in WATCHED.items():
            was, is_now = old[key], row[key]
            if was is None or is_now is None:
                if was is not None:
                    worse.append(f"{name}: {what} {was:.3f} -> none")
                continue
            text = f"{name}: {what} {was:.3f} -> {is_now:.3f}"
            if is_above(is_now, was, small, margin):
                worse.append(text)
            elif is_above(was, is_now, small, margin):
                better.append(text)
    return worse, better, compared
