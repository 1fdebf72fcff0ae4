# SPDX-License-Identifier: BSD-3-Clause
"""What was expected of a flight with a fault, and what came of it."""

NEES_3_SIGMA = 14.156  # 99.73 % of an honest filter's squared errors are below, as in replay
# Wrong in silence: a pose that claims to be right, is not, and is worse than the odometry.
MOST_SEARCHING = 80  # images: 8 s; measured are 42
SILENT_NEES, SILENT_M, SILENT_RATIO = 25, 0.1, 1.2


def is_silent(row):
    _, error_m, nees, odometry_error_m, state = row
    return nees > SILENT_NEES and error_m > SILENT_M + SILENT_RATIO * odometry_error_m and state != "distrusted"


def figures_of(trial):
    """The trial's rows in a few numbers."""
    rows = trial["rows"]
    placed = [row for row in rows if row[4] != "searching_map"]  # the others say that they are nowhere
    return {"answered": len(rows), "largest_m": max((row[1] for row in placed), default=0.0), "odometry_largest_m": max((row[3] for row in rows), default=0.0),
            "outside": sum(row[2] > NEES_3_SIGMA for row in rows) / max(1, len(rows)), "silent": sum(map(is_silent, rows)),
            "silent_m": max((row[1] for row in rows if is_silent(row)), default=0.0)}


def failures_of(fault, trial):
    """@return what is not as expected, a few words each"""
    if "rows" not in trial:
        return ["no result: " + trial["said"]]
    figures, failures = figures_of(trial), []
    if not trial["is_alive"]:
        failures.append("the nodelets have ended")
    if trial["answered_last"] < fault.answered:
        failures.append(f"{100 * trial['answered_last']:.0f} % of the last images answered")
    if trial["uncounted"] and not fault.is_counted_anew:
        failures.append(f"{trial['uncounted']} images lost and not counted" if trial["uncounted"] > 0 else
                        f"{-trial['uncounted']} images counted twice")
    if trial["strangers"]:
        failures.append(f"{trial['strangers']} poses of no image")
    most_m = max(fault.largest_m, fault.of_odometry * figures["odometry_largest_m"])
    if not figures["largest_m"] <= most_m:
        failures.append(f"off by {figures['largest_m']:.2f} m, {most_m:.2f} expected at most")
    if figures["silent"]:
        failures.append(f"wrong in silence in {figures['silent']} images, by up to {figures['silent_m']:.2f} m")
    searching = sum(row[4] == "searching_map" for row in trial["rows"])
    if searching > (MOST_SEARCHING if fault.state == "searching_map" else 0) or trial["rows"] and trial["rows"][-1][4] == "searching_map":
        failures.append(f"looked for its place in {searching} images")
    if fault.state and fault.state not in trial["states"]:
        failures.append(f"never {fault.state}")
    if trial["log_lines"] > fault.log_lines:
        failures.append(f"{trial['log_lines']} lines of log")
    return failures


def table_of(faults, trials):
    """Markdown: a row for each fault over its seeds. trials: of each fault's name a list."""
    lines = ["| fault | what | answered | lost, counted | off by at most [m] | the odometry [m] | beyond 3 sigma [%] | wrong in silence [m] | as expected |",
             "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |"]
    for fault in faults:
        flown = [trial for trial in trials[fault.name] if "rows" in trial]
        if not flown:
            lines.append(f"| {fault.name} | {fault.what} | | | | | | | no: no result |")
            continue
        figures = [figures_of(trial) for trial in flown]
        images, answered = sum(trial["images"] for trial in flown), sum(one["answered"] for one in figures)
        failed = sum(bool(failures_of(fault, trial)) for trial in trials[fault.name])
        silent = max(one["silent_m"] for one in figures)
        verdict = "yes" if not failed else f"no, {failed} of {len(trials[fault.name])}"
        lines.append(f"| {fault.name} | {fault.what} | {answered} | {images - answered} | {max(one['largest_m'] for one in figures):.2f} "
                     f"| {max(one['odometry_largest_m'] for one in figures):.2f} | {100 * max(one['outside'] for one in figures):.0f} "
                     f"| {f'{silent:.2f}' if silent else '-'} | {verdict} |")
    return "\n".join(lines)
