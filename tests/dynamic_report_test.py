# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""tools/dynamic_report.py with a program that only pretends to run."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[1] / "tools" / "dynamic_report.py"

# Appends to calls.txt; ATE 100 mm with the dynamic part off, 10 mm with it.
PROGRAM = """#!/usr/bin/env python3
import json, pathlib, sys
here = pathlib.Path(__file__).parent
arguments = sys.argv[1:]
if arguments == ["--version"]:
    print("changing-slam 0.1.0 (commit " + (here / "commit.txt").read_text() + ")")
    sys.exit(0)
with open(here / "calls.txt", "a") as calls:
    calls.write(" ".join(arguments) + "\\n")
out = pathlib.Path(arguments[arguments.index("--out") + 1])
out.mkdir(parents=True)
ate = 0.1 if "tracking.objects.enabled=false" in arguments else 0.01
times = {"median_ms": 10.0, "p99_ms": 20.0}
accuracy = {"trajectory": {"ate_m": {"rmse": ate}}}
(out / "run.json").write_text(json.dumps({
    "commit": (here / "commit.txt").read_text(), "arguments": arguments,
    "was_interrupted": False, "accuracy": accuracy,
    "stages": {"tracking": {"wall": times, "cpu": times}},
    "frames": {"processed": 50, "tracked_percent": 100.0, "dropped": 0},
    "cost": {"wall_s": 1.0, "cpu_ms_per_frame": 30.0, "first_pose_ms": 5.0,
             "peak_memory_bytes": 1e6},
    "map": {"keyframes": 3}}))
"""


class DynamicReportTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="cslam_report_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.program = self.folder / "program"
        self.program.write_text(PROGRAM, encoding="utf-8")
        self.program.chmod(0o755)
        self.set_commit("abc")
        (self.folder / "walking_xyz").mkdir()

    def set_commit(self, commit):
        (self.folder / "commit.txt").write_text(commit, encoding="utf-8")

    def report(self, *arguments):
        return subprocess.run(
            [sys.executable, "-B", TOOL, "--binary", self.program, "--work", self.folder / "work",
             *arguments, self.folder / "walking_xyz"],
            capture_output=True, encoding="utf-8", timeout=60, check=False)

    def num_calls(self):
        calls = self.folder / "calls.txt"
        return len(calls.read_text(encoding="utf-8").splitlines()) if calls.exists() else 0

    def test_prints_a_row_for_each_cell_and_leaves_out_what_cannot_be_run(self):
        result = self.report()
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = [line for line in result.stdout.splitlines() if line.startswith("| walking_xyz")]
        self.assertEqual(len(rows), 8, "there is no detections.json for perfect boxes")
        self.assertIn("| nothing | 100.0 |", rows[0])
        self.assertEqual(self.num_calls(), 8)

    def test_goes_on_where_it_was_and_starts_anew_with_another_program(self):
        arguments = ("--row", "nothing", "--mode", "live", "--runs", "3")
        self.report(*arguments)
        self.assertEqual(self.num_calls(), 3)
        self.report(*arguments)
        self.assertEqual(self.num_calls(), 3)
        self.set_commit("def")
        self.report(*arguments)
        self.assertEqual(self.num_calls(), 6)
        self.report(*arguments, "--set", "tracking.repopulate_below=500")
        self.assertEqual(self.num_calls(), 9)

    def test_says_which_bars_are_met_and_fails_if_asked_to(self):
        all_on = ("--row", "+ unknown", "--mode", "live", "--runs", "1")
        result = self.report(*all_on, "--fail-on-missed-bar")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("- met: walking_xyz", result.stdout)
        result = self.report(*all_on, "--set", "tracking.objects.enabled=false",
                             "--fail-on-missed-bar")
        self.assertEqual(result.returncode, 3, result.stdout + result.stderr)
        self.assertIn("- MISSED: walking_xyz", result.stdout)

    def test_unknown_row_names_those_there_are(self):
        result = self.report("--row", "everything")
        self.assertEqual(result.returncode, 1)
        self.assertIn("boxes only", result.stderr)


if __name__ == "__main__":
    unittest.main()
