# SPDX-License-Identifier: BSD-3-Clause
"""What a run comes to, in a few sentences."""

from .table import families, look_up

# As of replay (tools/summary/run_words.cpp), which also knows why a flight gained nothing.
BETTER, WORSE = 0.9, 1.1  # fused over odometry
MODEST, OVERCONFIDENT = 0.3, 1.5  # NEES / 3


def metres(value_m):
    return f"{value_m:.{3 if value_m < 0.1 else 2}f} m"


def verdict_of(row):
    """Whether the fused pose was better than the odometry; None where that is not known."""
    told = row.run.summary.get("verdict") if row.run is not None else None
    if isinstance(told, str):
        return told
    ratio, fused_m = row.numbers.get("ratio"), look_up(row.numbers, "ate.none.rmse_m")
    if not ratio or fused_m is None:
        return None
    word = "It helped" if ratio <= BETTER else "It did not help" if ratio <= WORSE else "It did harm"
    return f"{word}: the odometry is off by {metres(fused_m / ratio)}, the fused pose by {metres(fused_m)} (RMSE)."


def consistency_of(row):
    """NEES and NIS in words; None without a covariance or a truth."""
    nees, nis = look_up(row.numbers, "nees.mean"), look_up(row.numbers, "nis.mean")
    if nees is None:
        return None
    ratio = nees / 3
    word = "too small" if ratio > OVERCONFIDENT else "larger than the errors" if ratio < MODEST else "honest"
    sentence = f"The covariance is {word}: squared errors are {ratio:.2f} times the expected ones (NEES / 3)."
    return sentence if nis is None else f"{sentence} Those of the fixes are {nis:.2f} times (NIS)."


def told_of(rows):
    """(row, verdict) of the estimates that have one; of several seeds the table tells median and worst instead."""
    seeds = [member for members in families(rows).values() for member in members]
    single = [row for row in rows if row.kind == "estimate" and not any(row is member for member in seeds)]
    return [(row, verdict_of(row)) for row in single if verdict_of(row)]
