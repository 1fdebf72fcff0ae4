# SPDX-License-Identifier: BSD-3-Clause
"""evaluate_all --sweep, --tuning: one parameter at a time is set to other values, all else stays as it is."""

import json
import os
from dataclasses import dataclass, replace

import numpy as np

from .batch_jobs import Job, Sequence
from .faults import InputFault, reason
from .parameters import configured, in_order, is_same
from .run_folder import read_summary

OVERCONFIDENT_SHARE = 0.05  # of the frames outside 3 sigma; 0.003 would be honest


@dataclass(frozen=True)
class Case:
    """What the parameters are tried on."""

    name: str
    job: Job
    what: str = ""
    config: str = ""
    measure: str = "ratio_scale_removed"

    def value_of(self, parameter):
        """What it has where the sweep leaves it alone."""
        if parameter.name == "estimator":
            return self.job.estimator
        own = [setting.split("=", 1)[1] for setting in self.job.settings if setting.split("=", 1)[0] == parameter.name]
        return (own or [(configured(self.config) if self.config else {}).get(parameter.name, parameter.default)])[-1]

    def with_settings(self, settings):
        return replace(self, job=replace(self.job, settings=(*self.job.settings, *settings))) if settings else self

    def job_with(self, name, value):
        if name == "estimator":
            return replace(self.job, estimator=value)
        return replace(self.job, settings=(*self.job.settings, f"{name}={value}"))


@dataclass(frozen=True)
class Point:
    value: str
    job: Job
    is_base: bool


@dataclass(frozen=True)
class Panel:
    """One parameter: for each case its points, by value."""

    name: str
    unit: str
    default: str
    lines: tuple  # of (Case, tuple of Point)

    def values(self):
        return in_order([self.default] + [point.value for _, points in self.lines for point in points])


@dataclass(frozen=True)
class Group:
    name: str
    title: str
    panels: tuple


@dataclass(frozen=True)
class Measured:
    """Of one point: the seeds' errors over the odometry's, the same over those of the base, and what else is shown."""

    ratios: tuple
    relative: tuple
    outside: float

    def ratio(self):
        return float(np.median(self.ratios))

    def change(self):
        return float(np.median(self.relative))

    def is_overconfident(self):
        return self.outside is not None and self.outside > OVERCONFIDENT_SHARE


def text_of(value):
    """As `replay --set` wants it."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def panel_of(name, values, cases, known):
    if name not in known:
        raise InputFault(f"{name}: is no parameter of replay; docs/parameters.md lists them")
    parameter, lines = known[name], []
    default = cases[0].value_of(parameter) if name == "estimator" else parameter.default
    for case in cases:
        base = case.value_of(parameter)
        tried = in_order([base, default, *values])
        lines.append((case, tuple(Point(v, case.job if is_same(v, base) else case.job_with(name, v), is_same(v, base)) for v in tried)))
    return Panel(name, parameter.unit, default, tuple(lines))


def group_of_options(options, jobs, known):
    """Of --sweep NAME=V1,V2,...: on each of the jobs."""
    cases = [Case(job.name(), job) for job in jobs]
    panels = []
    for option in options:
        name, _, values = option.partition("=")
        if not values:
            raise InputFault(f"--sweep '{option}': must be NAME=VALUE,VALUE,..., for example features_per_frame=300,600")
        panels.append(panel_of(name, values.split(","), cases, known))
    return Group("sweep", "", tuple(panels))


@dataclass(frozen=True)
class Plan:
    """docs/tuning_sweep.json."""

    groups: tuple
    cost_cases: tuple  # names
    cost_parameters: tuple
    without: dict  # why -> parameters
    sections_without: dict  # section -> why
    left_out: tuple  # cases whose data are not there


def case_of(name, entry, data, seeds, config_folder, names):
    """@param names {source: name of the sequence}, so that cases share what is rendered. None when its data are not there."""
    folder = os.path.join(os.path.abspath(data), entry["data"]) if data and "data" in entry else ""
    if "data" in entry and not os.path.isdir(folder):
        return None
    config = os.path.join(config_folder, entry["config"]) if "config" in entry else ""
    options = (*entry.get("replay", ()), *(("--config", config) if config else ()))
    flight, bag = tuple(entry.get("make_world", ())), entry.get("bag", False)
    sequence = Sequence(names.setdefault((flight, bag, folder, options), name), (entry["profile"],), flight, folder, options, bag)
    job = Job(sequence, entry["profile"], entry.get("estimator", "msckf"), seeds, tuple(entry.get("set", ())))
    return Case(name, job, entry["what"], config, entry.get("measure", "ratio_scale_removed"))


def read_plan(path, known, data, seeds, config_folder):
    try:
        with open(path, encoding="utf-8") as file:
            plan = json.load(file)
        names = {}
        cases = {name: case_of(name, entry, data, seeds, config_folder, names) for name, entry in plan["cases"].items()}
        groups = []
        for group in plan["groups"]:
            panels = []
            for name, entry in group["parameters"].items():
                entry = entry if isinstance(entry, dict) else {"values": entry}
                own = [cases[case] for case in entry.get("cases", group["cases"])]
                own = [case.with_settings(entry.get("set", ())) for case in own if case]
                if own:
                    panels.append(panel_of(name, [text_of(value) for value in entry["values"]], own, known))
            if panels:
                groups.append(Group(group["name"], group["title"], tuple(panels)))
        return Plan(tuple(groups), tuple(plan["cost"]["cases"]), tuple(plan["cost"]["parameters"]), plan["without"],
                    plan["sections_without"], tuple(name for name, case in cases.items() if case is None))
    except OSError as error:
        raise InputFault(f"{path}: cannot be read ({reason(error)}); check the path") from None
    except (ValueError, KeyError, TypeError) as error:
        raise InputFault(f"{path}: is no list of sweeps ({error!r}); docs/tuning_sweep.json is one") from None


def jobs_of(groups):
    """Each once: most points of a panel are the same base."""
    return list(dict.fromkeys(job for group in groups for panel in group.panels for case, points in panel.lines
                              for job in (case.job, *(point.job for point in points))))


def runs_in(folder):
    """What summary.json says of each seed."""
    summary = read_summary(os.path.join(folder, "summary.json"))
    return summary.get("runs", [summary])


def measure(groups, folders):
    """{(case, point): Measured} of what could be run and has a ratio in all seeds."""
    runs_of_job = {job: runs_in(folder) for job, folder in folders.items()}
    result = {}
    for group in groups:
        for case, points in (line for panel in group.panels for line in panel.lines):
            ratios = {}
            for point in points:
                runs = runs_of_job.get(point.job, [])
                values = [run.get(case.measure) for run in runs]
                if values and None not in values:
                    ratios[point] = values, runs
            base = next((ratios[point][0] for point in points if point.is_base and point in ratios), None)
            if base is None or not all(base):
                continue
            for point, (values, runs) in ratios.items():
                outside = [run.get("outside_3_sigma") for run in runs]
                result[case, point] = Measured(tuple(values), tuple(v / b for v, b in zip(values, base)),
                                               None if None in outside else float(np.median(outside)))
    return result


def cost_jobs(plan):
    """{(panel, case, point): job} of what takes time: one seed, as they run alone."""
    panels = [panel for name in plan.cost_parameters for group in plan.groups for panel in group.panels if panel.name == name]
    return {(panel, case, point): replace(point.job, seeds="1:1") for panel in panels for case, points in panel.lines
            if case.name in plan.cost_cases for point in points}


def costs(jobs, folders):
    """{(panel, case, point): ms of an image}"""
    return {key: runs_in(folders[job])[0]["ms_per_frame_median"] for key, job in jobs.items() if job in folders}
