# SPDX-License-Identifier: BSD-3-Clause
"""Runs jobs by GNU parallel; what is done already, by the same programs on the same input, is left as it is.

Each piece of work has a folder, and in it, written last, a file `key`: a digest of all that its result follows from."""

import contextlib
import glob
import hashlib
import os
import shlex
import subprocess
import sys
import tempfile

from .faults import InputFault, MachineFault, reason


def digest(*parts):
    """Of texts and bytes."""
    sum_ = hashlib.sha256()
    for part in parts:
        data = part if isinstance(part, bytes) else str(part).encode()
        sum_.update(len(data).to_bytes(8, "little") + data)
    return sum_.hexdigest()


def contents(path):
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        raise MachineFault(f"{path}: cannot be read ({reason(error)}); build the package again") from None


class Programs:
    """replay and make_world of one build."""

    def __init__(self, folder, config_folder):
        self.replay, self.make_world = os.path.join(folder, "replay"), os.path.join(folder, "make_world")
        for path in (self.replay, self.make_world):
            if not os.access(path, os.X_OK):
                raise InputFault(f"{path}: there is no such program; name the folder that holds replay and make_world by --programs")
        linked = subprocess.run(["ldd", self.replay], capture_output=True, text=True, check=False).stdout.splitlines()
        libraries = [line.split()[2] for line in linked if "libardrone_vslam" in line and "=> /" in line]
        configs = sorted(glob.glob(os.path.join(config_folder, "*.yaml")))
        self.of_replay = digest(*map(contents, [self.replay, *libraries, *configs]))
        self.of_make_world = digest(contents(self.make_world))

    def parameters_page(self):
        """docs/parameters.md, as this build writes it."""
        done = subprocess.run([self.replay, "--list-parameters"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise InputFault(f"{self.replay} --list-parameters: {done.stderr.strip()}")
        return done.stdout

    def fingerprint_of_flight(self, flight, is_bag=False):
        """make_world itself, and three of its images: these tell of changes of the library that show in them, and the others
        need not render all anew."""
        whole = [word for i, word in enumerate(flight) if word != "--seconds" and (i == 0 or flight[i - 1] != "--seconds")]
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([self.make_world, *whole, "--seconds", "0.15", "--out", f"{folder}/probe{'.bag' if is_bag else ''}"],
                                  capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise InputFault(f"make_world {' '.join(flight)}: {done.stderr.strip()}")
            files = sorted(glob.glob(f"{folder}/**", recursive=True))
            return digest(self.of_make_world, *flight, *(contents(path) for path in files if os.path.isfile(path)))


def fingerprint_of_folder(folder):
    """Not of the images, of which there may be gigabytes."""
    if not os.path.isdir(folder):
        raise InputFault(f"{folder}: there is no such folder; check the path")
    files = sorted((entry for entry in os.scandir(folder) if entry.is_file()), key=lambda entry: entry.name)
    return digest(folder, *(f"{entry.name} {entry.stat().st_size} {entry.stat().st_mtime_ns}" for entry in files))


class Task:
    """One line for parallel."""

    def __init__(self, name, folder, key, command, prepare="", clear=""):
        self.name, self.folder, self.key, self.command, self.prepare, self.clear = name, folder, key, command, prepare, clear

    def log(self):
        return self.folder + ".log"

    def fault(self):
        if os.path.exists(self.log()):
            return f"{self.name}: failed, see {self.log()}"
        return f"{self.name}: left no {self.log()}: its machine did not answer (ssh's message is above) or has another work folder there"

    def is_done(self):
        try:
            with open(os.path.join(self.folder, "key"), encoding="utf-8") as file:
                return file.read().strip() == self.key
        except OSError:
            return False

    def line(self, count):
        quoted, log = shlex.quote(self.folder), shlex.quote(self.log())
        name = shlex.quote(self.name)
        return (f"mkdir -p {shlex.quote(os.path.dirname(self.folder))} && rm -f {quoted}/key && {self.prepare or 'true'} && "
                f"if {shlex.join(self.command)} > {log} 2>&1 && {self.clear or 'true'} && echo {self.key} > {quoted}/key; "
                f'then echo "$PARALLEL_SEQ/{count}" {name}; else echo "$PARALLEL_SEQ/{count}" {name}: failed, see {log} >&2; exit 1; fi')


def task_of_sequence(sequence, programs, work):
    folder = os.path.join(work, "sequences", sequence.name)
    command = [programs.make_world, *sequence.flight, "--out", sequence.output_in(folder)]
    quoted = shlex.quote(folder)
    return Task(f"rendered {sequence.name}", folder, programs.fingerprint_of_flight(sequence.flight, sequence.bag), command,
                f"rm -rf {quoted}" + (f" && mkdir {quoted}" if sequence.bag else ""))


def task_of_job(job, sequence_folder, sequence_key, programs, runs):
    folder = os.path.join(runs, *job.parts())
    options = ["--odometry-profile", job.profile, "--estimator", job.estimator, "--seeds", job.seeds, *job.sequence.replay, *job.options]
    options += [word for setting in job.settings for word in ("--set", setting)]
    command = [programs.replay, job.sequence.output_in(sequence_folder), *options, "--threads", "1", "--out", folder]
    # The many runs of a sweep would fill the disk.
    clear = f"find {shlex.quote(folder)} -mindepth 1 ! -path {shlex.quote(folder)}/summary.json -delete" if job.settings else ""
    return Task(job.name(), folder, digest(programs.of_replay, sequence_key, *options), command, clear=clear)


def check_parallel():
    try:
        version = subprocess.run(["parallel", "--version"], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL).stdout
    except OSError:
        version = ""
    if not version.startswith("GNU parallel"):
        raise MachineFault("GNU parallel was not found; run scripts/install_dependencies (Debian's package parallel, not that of moreutils)")


def run_tasks(tasks, what, work, jobs, logins):
    """Runs those that are not done. @return those that failed"""
    to_do = [task for task in tasks if not task.is_done()]
    print(f"evaluate_all: {len(to_do)} {what} to do, {len(tasks) - len(to_do)} done before", file=sys.stderr, flush=True)
    if not to_do:
        return []
    check_parallel()
    for task in to_do:
        with contextlib.suppress(FileNotFoundError):
            os.remove(task.log())
    command = ["parallel", "--will-cite", "--jobs", jobs, "--joblog", os.path.join(work, f"{what.split()[0]}.joblog")]
    command += ["--retries", str(max(1, len(logins)))]  # a machine that does not answer fails its jobs at once; the others do them
    if sys.stderr.isatty():
        command.append("--bar")
    for login in logins:
        command += ["--sshlogin", login]
    lines = "".join(task.line(len(to_do)) + "\n" for task in to_do)
    try:
        # Its output is progress, the table comes on stdout.
        done = subprocess.run(command, input=lines, text=True, stdout=sys.stderr.fileno(), check=False)
    except OSError as error:
        raise MachineFault(f"parallel: cannot be run ({reason(error)})") from None
    failed = [task for task in to_do if not task.is_done()]
    if done.returncode > 100 and len(failed) == len(to_do):
        raise MachineFault(f"parallel ended with code {done.returncode}; its message is above")
    return failed


def run_jobs(jobs, programs, work, parallel_jobs, logins, runs="runs"):
    """Renders what lacks, then runs, into a folder of that name. @return ({job: its folder}, texts about what failed)"""
    sequences = {job.sequence.name: job.sequence for job in jobs}.values()
    rendering = {s.name: task_of_sequence(s, programs, work) for s in sequences if s.flight}
    faults = run_tasks(list(rendering.values()), "sequences to render", work, parallel_jobs, logins)
    places = {s.name: (s.folder, fingerprint_of_folder(s.folder)) for s in sequences if not s.flight}
    places.update({name: (task.folder, task.key) for name, task in rendering.items() if task not in faults})
    tasks = {job: task_of_job(job, *places[job.sequence.name], programs, os.path.join(work, runs)) for job in jobs if job.sequence.name in places}
    faults = faults + run_tasks(list(tasks.values()), "runs", work, parallel_jobs, logins)
    return ({job: task.folder for job, task in tasks.items() if task not in faults},
            [task.fault() for task in faults])
