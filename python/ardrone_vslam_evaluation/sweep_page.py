# SPDX-License-Identifier: BSD-3-Clause
"""A sweep in words: the table of all runs, and the measured part of docs/tuning.md. No times in them, so they are the same each time."""

import re

import numpy as np

from .faults import InputFault
from .parameters import is_same

SMALLEST_CLEAR = 0.05  # an error that changes by less, in the median of the seeds, counts as none
ENOUGH, OTHERWISE_CLEAR = 40, 0.1  # so many runs tell the scatter; with fewer, chosen to have an effect, it is taken for this
DEVIATIONS = 2.5  # nor does one within so many deviations of what a case's error changes with most parameters
BEGIN, END = "<!-- measured: written by scripts/evaluate_all --tuning --update -->", "<!-- end of what is measured -->"


def row(cells):
    return f"| {' | '.join(cells)} |\n"


def head(cells, numbers):
    """@param numbers of the last columns, to the right"""
    return row(cells) + row(["---"] * (len(cells) - numbers) + ["---:"] * numbers)


def percent(share):
    return "-" if share is None else f"{100 * share:.1f}"


def full_table(groups, results):
    text = head(["parameter", "on", "value", "fused / odometry, median", "least", "most", "times the default's", "outside 3 sigma [%]"], 5)
    for panel in (panel for group in groups for panel in group.panels):
        for case, point in ((case, point) for case, points in panel.lines for point in points):
            measured = results.get((case, point))
            numbers = ["-"] * 5 if measured is None else [f"{measured.ratio():.3f}", f"{min(measured.ratios):.3f}", f"{max(measured.ratios):.3f}",
                                                          f"{measured.change():.2f}", percent(measured.outside)]
            text += row([f"`{panel.name}`", case.name, f"{point.value} (base)" if point.is_base else point.value, *numbers])
    return text


def scatter(results):
    """{case's name: by which factor its error has to change to count}. Whatever is changed a little, tracks begin and end elsewhere and
    the error is another one: most parameters do no more than this, so their median change tells how much that is."""
    changes = {}
    for (case, point), measured in results.items():
        changes.setdefault(case.name, [])
        if not point.is_base and measured.change() not in (0, 1):
            changes[case.name].append(abs(np.log(measured.change())))
    return {name: max(1 + SMALLEST_CLEAR, float(np.exp(DEVIATIONS * 1.4826 * np.median(values)))) if len(values) >= ENOUGH else 1 + OTHERWISE_CLEAR
            for name, values in changes.items()}


def effects(panel, results, limits):
    """(change, value, case's name) of those beyond the scatter, with no seed that goes clearly the other way."""
    found = []
    for case, point in ((case, point) for case, points in panel.lines for point in points if not point.is_base):
        measured, limit = results.get((case, point)), limits.get(case.name)
        if measured is None or size(measured.change()) <= limit:
            continue
        if min(measured.relative) > 1 / limit if measured.change() > 1 else max(measured.relative) < limit:
            found.append((measured.change(), point.value, case.name))
    return found


def size(change):
    return max(change, 1 / change) if change > 0 else float("inf")


def strength(panel, results, limits):
    return max((size(change) for change, _, _ in effects(panel, results, limits)), default=1)


def changes_nothing(panel, results):
    """Not a single number of any run."""
    return all(relative == 1 for case, points in panel.lines for point in points if (case, point) in results
               for relative in results[case, point].relative)


def overconfident(panel, results):
    """Values that make a case over-confident that is not so as it is."""
    texts = []
    for case, points in panel.lines:
        known = [point for point in points if (case, point) in results]
        if any(point.is_base and results[case, point].is_overconfident() for point in known):
            continue
        values = [point.value for point in known if results[case, point].is_overconfident()]
        texts += [f"{', '.join(values)} ({case.name})"] if values else []
    return "; ".join(texts)


def shown(effect):
    return "-" if effect is None else f"{effect[0]:.2f}: {effect[1]} ({effect[2]})"


def table_of_group(group, results, limits):
    """The strongest first; those without a clear effect are left out."""
    text = head(["parameter", "default", "tried", "least error", "most error", "over-confident with"], 0)
    for panel in sorted(group.panels, key=lambda panel: -strength(panel, results, limits)):
        known = effects(panel, results, limits)
        if not known and not overconfident(panel, results):
            continue
        tried = [value for value in panel.values() if not is_same(value, panel.default)]
        least = min((effect for effect in known if effect[0] < 1), default=None)
        most = max((effect for effect in known if effect[0] > 1), default=None)
        text += row([f"`{panel.name}`", panel.default, ", ".join(tried), shown(least), shown(most), overconfident(panel, results) or "-"])
    return text


def names(panels):
    return ", ".join(f"`{panel.name}`" for panel in panels) or "none"


def cases_table(groups, results, limits):
    cases = list(dict.fromkeys(case for group in groups for panel in group.panels for case, _ in panel.lines))
    bases = {}  # those without a panel's own settings
    for case, point in sorted(results, key=lambda key: len(key[0].job.settings)):
        if point.is_base:
            bases.setdefault(case.name, results[case, point])
    text = head(["on", "what it is", "odometry", "fused / odometry", "images outside 3 sigma [%]", "a clear change is beyond"], 3)
    for case in {case.name: case for case in reversed(cases)}.values():
        if case.name in bases:
            text += row([f"`{case.name}`", case.what, case.job.profile, f"{bases[case.name].ratio():.2f}", percent(bases[case.name].outside),
                         f"{1 / limits[case.name]:.2f} to {limits[case.name]:.2f}"])
    return text


def measured_part(plan, results, seeds, pictures):
    """@param pictures {group's name: path beside the page}; `cost` is one more"""
    limits = scatter(results)
    text = f"{BEGIN}\nSeeds {seeds}.\n\n{cases_table(plan.groups, results, limits)}\n"
    if plan.left_out:
        text += f"Left out, as the data were not at hand: {', '.join(plan.left_out)}.\n\n"
    for group in plan.groups:
        text += f"### {group.title}\n![Error against each parameter]({pictures[group.name]})\n\n{table_of_group(group, results, limits)}\n"
        small = [panel for panel in group.panels if not effects(panel, results, limits) and not overconfident(panel, results)]
        nothing = [panel for panel in small if changes_nothing(panel, results)]
        text += f"No clear effect: {names([panel for panel in small if panel not in nothing])}. Not a digit changed with: {names(nothing)}.\n\n"
    text += f"### Cost\n![Milliseconds an image against each parameter]({pictures['cost']})\n\n### Without a panel\n" + head(["why", "parameters"], 0)
    for why, parameters in plan.without.items():
        text += row([why, ", ".join(f"`{name}`" for name in parameters)])
    for section, why in plan.sections_without.items():
        text += row([why, f"all of {section}"])
    return text + END


def with_measured_part(page, part, path):
    pattern = re.compile(re.escape(BEGIN) + ".*" + re.escape(END), re.DOTALL)
    if len(pattern.findall(page)) != 1:
        raise InputFault(f"{path}: has no place for the measured part, from '{BEGIN}' to '{END}'; put both lines back")
    return pattern.sub(lambda _: part, page)
