# SPDX-License-Identifier: BSD-3-Clause
"""The numbers as a table, for the terminal and for the page."""


def look_up(numbers, path):
    """"ate.se3.rmse_m" in nested dictionaries; None where there is no such thing."""
    value = numbers
    for key in path.split("."):
        value = value.get(key) if isinstance(value, dict) else None
    return value


def shown(value, digits, factor=1):
    if value is None:
        return "-"
    return f"{value * factor:.{digits}f}" if isinstance(value, float) or factor != 1 else str(value)


# Heading, key of the row's numbers, digits, factor.
ERRORS = (("matched", "matched", 0, 1),)
RELATIVE = (("t_rel [%]", "t_rel_percent", 3, 1), ("r_rel [deg/m]", "r_rel_deg_per_m", 5, 1),
            ("RPE 1 s [m]", "rpe_1s.translation_rmse_m", 3, 1), ("RPE 1 s [deg]", "rpe_1s.rotation_rmse_deg", 3, 1),
            ("RPE 1 m [m]", "rpe_1m.translation_rmse_m", 3, 1), ("RPE 1 m [deg]", "rpe_1m.rotation_rmse_deg", 3, 1))
CONSISTENCY = (("NEES mean (3)", "nees.mean", 2, 1), ("inside 3 sigma [%]", "nees.inside_3_sigma", 2, 100),
               ("inside 95 % bounds [%]", "nees.inside_95", 1, 100), ("NIS mean (1)", "nis.mean", 2, 1),
               ("/ observer", "ratio", 3, 1), ("/ observer, scale removed", "ratio_scale_removed", 3, 1))
COST = (("ms median", "cost.ms_per_frame.median", 2, 1), ("ms 95 %", "cost.ms_per_frame.p95", 2, 1),
        ("ms max", "cost.ms_per_frame.max", 2, 1), ("memory [MB]", "cost.peak_rss_mb", 0, 1),
        ("features", "cost.features_median", 0, 1), ("landmark matches", "cost.landmark_matches_median", 0, 1),
        ("feature matches", "cost.feature_matches_median", 0, 1), ("landmarks", "cost.landmarks", 0, 1))


def error_columns(align):
    """After the alignment that was asked for; beside it the RMSE after the other ones."""
    ate = tuple((name, f"ate.{align}.{key}", 3, 1) for name, key in
                (("ATE RMSE [m]", "rmse_m"), ("mean", "mean_m"), ("median", "median_m"), ("max", "max_m"), ("last", "last_m")))
    others = {"none": (("SE(3) RMSE", "ate.se3.rmse_m", 3, 1),), "se3": (("unaligned RMSE", "ate.none.rmse_m", 3, 1),),
              "sim3": (("SE(3) RMSE", "ate.se3.rmse_m", 3, 1), ("scale", "scale", 4, 1))}
    return ERRORS + ate + others[align] + RELATIVE


def tables(rows, align):
    """(title, headings, lines of cells): one line a row; tables and columns without any number are left out."""
    aligned = {"none": "no alignment", "se3": "SE(3) alignment", "sim3": "Sim(3) alignment"}[align]
    result = []
    for title, columns in ((f"Position error, {aligned}", error_columns(align)),
                           ("Consistency, and no harm to the observer", CONSISTENCY), ("Cost, medians of the frames", COST)):
        known = [column for column in columns if any(look_up(row.numbers, column[1]) is not None for row in rows)]
        lines = [[row.name] + [shown(look_up(row.numbers, key), digits, factor) for _, key, digits, factor in known]
                 for row in rows if any(look_up(row.numbers, column[1]) is not None for column in known)]
        if lines:
            result.append((title, [""] + [column[0] for column in known], lines))
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
