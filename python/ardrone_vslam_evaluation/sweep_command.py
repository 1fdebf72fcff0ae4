# SPDX-License-Identifier: BSD-3-Clause
"""evaluate_all --sweep and --tuning: runs, tables and pictures."""

import os
import sys

from . import sweep, sweep_page
from .batch_run import Programs, run_jobs
from .command import write
from .faults import MachineFault, reason
from .parameters import of_replay, read_page


def plotting():
    try:
        from . import plot_sweep
    except ImportError as error:
        raise MachineFault(f"the plots need Debian's python3-matplotlib ({error}); run scripts/install_dependencies") from None
    return plot_sweep


def measured(groups, programs, work, arguments):
    folders, faults = run_jobs(sweep.jobs_of(groups), programs, work, arguments.jobs, arguments.sshlogin)
    for text in faults:
        print(f"evaluate_all: {text}", file=sys.stderr)
    return sweep.measure(groups, folders), faults


def run_sweep(arguments, jobs, source, work):
    """Of the user's own choice of sequences, estimators and values."""
    plot_sweep = plotting()
    programs = Programs(os.path.abspath(arguments.programs), os.path.join(source, "config"))
    group = sweep.group_of_options(arguments.sweep, jobs, of_replay(read_page(programs.parameters_page())))
    results, faults = measured([group], programs, work, arguments)
    table = sweep_page.full_table([group], results)
    print(table)
    write(os.path.join(work, "sweep.md"), f"# Sweep\n\n{table}")
    plot_sweep.save(plot_sweep.draw_errors(group, results, plot_sweep.colours_of([group])), os.path.join(work, "sweep.png"))
    return not faults


def run_tuning(arguments, source, work):
    """docs/tuning.md and its pictures; without --update in WORK only."""
    plot_sweep = plotting()
    config = os.path.join(source, "config")
    programs = Programs(os.path.abspath(arguments.programs), config)
    known = of_replay(read_page(programs.parameters_page()))
    plan = sweep.read_plan(os.path.join(source, "docs", "tuning_sweep.json"), known, os.environ.get("ARDRONE_VSLAM_DATA"), arguments.seeds, config)
    results, faults = measured(plan.groups, programs, work, arguments)
    timed = sweep.cost_jobs(plan)
    timed_folders, timed_faults = run_jobs(list(dict.fromkeys(timed.values())), programs, work, "1", [], "timed")
    costs, faults = sweep.costs(timed, timed_folders), faults + timed_faults
    docs = os.path.join(source, "docs") if arguments.update and not faults else os.path.join(work, "docs")
    os.makedirs(docs, exist_ok=True)
    pictures = {group.name: f"images/tuning_{group.name}.png" for group in plan.groups}
    pictures["cost"] = "images/tuning_cost.png"
    colours = plot_sweep.colours_of(plan.groups)
    for group in plan.groups:
        plot_sweep.save(plot_sweep.draw_errors(group, results, colours), os.path.join(docs, pictures[group.name]))
    plot_sweep.save(plot_sweep.draw_costs(costs, colours), os.path.join(docs, pictures["cost"]))
    write(os.path.join(work, "tuning_runs.md"), f"# All runs of the sweep\n\n{sweep_page.full_table(plan.groups, results)}")
    path = os.path.join(source, "docs", "tuning.md")
    try:
        with open(path, encoding="utf-8") as file:
            page = file.read()
    except OSError as error:
        raise MachineFault(f"{path}: cannot be read ({reason(error)})") from None
    part = sweep_page.measured_part(plan, results, arguments.seeds, pictures)
    write(os.path.join(docs, "tuning.md"), sweep_page.with_measured_part(page, part, path))
    return not faults
