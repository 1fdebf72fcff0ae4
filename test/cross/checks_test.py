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
BOARD = load("board_report")


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
            command = [HERE / "compare_poses", f"{folder}/a", f"{folder}/b"]
            return subprocess.run(command, capture_output=True, check=False).returncode

    def test_the_same_bytes(self):
        self.assertEqual(self.compare("1000 1 2 3 0 0 0 1 localised 10 20"), 0)
        self.assertEqual(self.compare("1000 1.0000000000000002 2 3 0 0 0 1 localised 10 20"), 1)
        self.assertEqual(self.compare("1000 1 2 3 1e-17 0 0 1 localised 10 20"), 1)
        self.assertEqual(self.compare("1000 nan 2 3 0 0 0 1 localised 10 20"), 1)
        self.assertEqual(self.compare("1000 1 2 3 0 0 0 1 tracking 10 20"), 1)  # another state, both corrected by the images
        self.assertEqual(self.compare("1000 1 2 3 0 0 0 1 localised 11 20"), 1)  # another count of features
        self.assertEqual(self.compare("1000 1 2 3 0 0 0 1 localised 10 21"), 1)  # of landmarks
        self.assertEqual(self.compare("1001 1 2 3 0 0 0 1 localised 10 20"), 1)
        self.assertEqual(self.compare("1000 1 2 3 0 0 0 1 building_map 10 20", state="building_map"), 1)  # the observer's


class EmulatedBoard(unittest.TestCase):
    FACTS = "== part 0xc08\r\n== features half thumb neon vfpv3\r\n== memory 128080 kB\r\n"
    RUNS = (("self_test", 0, "self-test passed"), ("no_camera", 1, "FAULT  camera     /dev/video2: see above"),
            ("self_test_memory", 1, "FAULT  memory     19 MB cannot be had"), ("flight", 0, "vslam_onboard: 9 images answered"),
            ("stopped", 0, "vslam_onboard: 4 images answered"), ("cut_off", 1, "vslam_onboard: -: the images end within one"),
            ("memory_2", 1, "vslam_onboard: out of memory: set it lower"),
            ("memory_4", 0, "vslam_onboard: 9 images answered"))

    @staticmethod
    def run_lines(name, exit_code, said, signal=0):
        return (f"== run {name}\r\n{said}\r\n== end {name} exit {exit_code} signal {signal} maxrss_kb 2048 user_us 5000 "
                "system_us 100\r\n")

    def faults(self, facts=FACTS, done="== done\r\n", **other):
        runs = "".join(other.get(run[0], self.run_lines(*run)) for run in self.RUNS)
        board = BOARD.Board("U-Boot\r\n" + facts + runs + done)
        return BOARD.faults_of_board(board) + BOARD.faults_of_runs(board.runs)

    def test_a_good_board_has_no_fault(self):
        self.assertEqual(self.faults(), [])

    def test_each_fault_is_found(self):
        for changed in (
                {"done": ""}, {"facts": self.FACTS.replace("0xc08", "0xc0f")}, {"facts": self.FACTS.replace("neon ", "")},
                {"facts": self.FACTS.replace("128080", "512000")}, {"facts": self.FACTS + "== fault /card.ko: no such file\r\n"},
                {"flight": ""}, {"flight": "== run flight\r\n"}, {"flight": self.run_lines("flight", 0, "")},
                {"self_test": self.run_lines("self_test", 1, "self-test failed")},
                {"no_camera": self.run_lines("no_camera", 0, "self-test passed")},
                {"stopped": self.run_lines("stopped", -1, "", signal=15)},
                {"memory_2": self.run_lines("memory_2", -1, "", signal=11)},  # crashed
                {"memory_2": self.run_lines("memory_2", 1, "vslam_onboard: std::exception")},
                {"memory_2": self.run_lines("memory_2", 0, "2 images answered")},  # nothing was refused
                {"memory_4": self.run_lines("memory_4", 1, "vslam_onboard: out of memory")}):  # nothing was enough
            with self.subTest(changed=changed):
                self.assertNotEqual(self.faults(**changed), [])

    def test_files_come_whole_or_are_refused(self):
        good = "== file /poses.bin 5 907060870\r\n68656c\r\n6c6f\r\n== file_end\r\n"
        self.assertEqual(BOARD.Board(good).files, {"/poses.bin": b"hello"})
        for bad in (good.replace("6c6f", "6c6e"), good.replace("6c6f", "6c"), good.replace("6c6f", "6c6"), good.replace("6c6f", "[ 5.6]")):
            board = BOARD.Board(bad)
            self.assertEqual((board.files, len(board.faults)), ({}, 1))


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
            self.assertEqual(frame["instructions"], 7 * (100000 + 900) / 10)  # seven stages, ten frames
            self.assertEqual(self.report(folder, 104000, "--baseline", folder / "base.json").returncode, 0)
            worse = self.report(folder, 106000, "--baseline", folder / "base.json")
            self.assertEqual(worse.returncode, 1)
            self.assertIn("FAULT: laps_thesis_neon: instructions rose", worse.stdout)


if __name__ == "__main__":
    sys.exit(unittest.main())
