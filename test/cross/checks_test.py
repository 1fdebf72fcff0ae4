# SPDX-License-Identifier: BSD-3-Clause
"""That the checks of the cross build find what they are there for."""

import importlib.machinery
import importlib.util
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
REPORT = HERE.parent.parent / "benchmark" / "drone" / "report.py"


def load(name):
    loader = importlib.machinery.SourceFileLoader(name, str(HERE / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


CHECK = load("check_executable")


def function(*texts):
    return [CHECK.Instruction(4 * i, 0, text) for i, text in enumerate(texts)]


class SystemCalls(unittest.TestCase):
    def numbers(self, *texts):
        calls, unknown = CHECK.system_calls([("f", function(*texts))])
        return sorted(calls), len(unknown)

    def test_numbers_are_found_on_every_way(self):
        self.assertEqual(self.numbers("mov\tr7, #5", "mov\tr0, r1", "svc\t#0"), ([5], 0))
        self.assertEqual(self.numbers("movw\tr7, #5", "movt\tr7, #15", "svc\t#0"), ([0xF0005], 0))
        self.assertEqual(self.numbers("moveq\tr7, #3", "movne\tr7, #145", "svc\t#0"), ([3, 145], 0))
        self.assertEqual(self.numbers("mov\tr7, #3", "b\t0x10 <f>", "mov\tr7, #4", "bx\tlr", "svc\t#0"), ([3], 0))
        self.assertEqual(self.numbers("movw\tr0, #403", "bl\t0x100 <__syscall_cp>"), ([403], 0))

    def test_what_cannot_be_told_is_said(self):
        self.assertEqual(self.numbers("ldr\tr7, [r1]", "svc\t#0"), ([], 1))
        self.assertEqual(self.numbers("svc\t#0"), ([], 1))
        self.assertEqual(self.numbers("moveq\tr7, #3", "svc\t#0"), ([3], 1))
        self.assertEqual(self.numbers("mov\tr0, #3", "bl\t0x100 <g>", "bl\t0x200 <__syscall_cp>"), ([], 1))


class Poses(unittest.TestCase):
    def compare(self, *lines, state="localised"):
        with tempfile.TemporaryDirectory() as folder:
            pose = "1000 1 2 3 0 0 0 1 " + state + " 10 20"
            for name, line in zip("ab", (pose, *lines)):
                (Path(folder) / name).write_text(line + "\n")
            command = [HERE / "compare_poses", f"{folder}/a", f"{folder}/b", "1e-6", "1e-5"]
            return subprocess.run(command, capture_output=True, check=False).returncode

    def test_bounds(self):
        self.assertEqual(self.compare("1000 1.0000009 2 3 0 0 0 1 localised 10 20"), 0)
        self.assertEqual(self.compare("1000 1 2 3 0 0 0 -1 localised 10 20"), 0)  # the same rotation
        self.assertEqual(self.compare("1000 1.0000011 2 3 0 0 0 1 localised 10 20"), 1)
        self.assertEqual(self.compare("1000 1 2 3 1e-7 0 0 1 localised 10 20"), 1)  # 1.1e-5 degrees
        self.assertEqual(self.compare("1000 nan 2 3 0 0 0 1 localised 10 20"), 1)
        self.assertEqual(self.compare("1001 1 2 3 0 0 0 1 localised 10 20"), 1)
        self.assertEqual(self.compare("1000 1 2 3 0 0 0 1 building_map 10 20", state="building_map"), 1)  # the observer's


class Cost(unittest.TestCase):
    KINDS = ["integer", "branch", "memory", "neon", "neon_memory", "scalar", "divide", "scalar_memory", "move", "other"]

    def report(self, folder, integers, *arguments):
        counts = "".join(
            f"stage {stage} " + " ".join(f"{kind} {integers if kind == 'integer' else 100}" for kind in self.KINDS) + "\n"
            for stage in range(16))
        (folder / "laps_thesis_neon.counts").write_text(counts)
        (folder / "laps_thesis_neon.poses").write_text("pose\n" * 10)
        return subprocess.run([REPORT, folder, *arguments], capture_output=True, text=True, check=False)

    def test_a_rise_of_5_per_cent_fails(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.assertEqual(self.report(folder, 100000, "--json", folder / "base.json").returncode, 0)
            frame = json.loads((folder / "base.json").read_text())["laps_thesis_neon"]["frame"]
            self.assertEqual(frame["instructions"], 6 * (100000 + 900) / 10)  # six stages, ten frames
            self.assertEqual(self.report(folder, 104000, "--baseline", folder / "base.json").returncode, 0)
            worse = self.report(folder, 106000, "--baseline", folder / "base.json")
            self.assertEqual(worse.returncode, 1)
            self.assertIn("FAULT: laps_thesis_neon: instructions rose", worse.stdout)


if __name__ == "__main__":
    sys.exit(unittest.main())
