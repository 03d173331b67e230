#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""What it costs to map a recording in two sessions instead of one.

    tools/two_sessions.py SEQUENCE [--binary build/changing-slam] [--split N] [--fail-above RATIO] [-- ARGUMENTS]

Runs the whole sequence; then its first part with --save-map and, in a new process, the rest with
--map. Prints the trajectory error of each, of both sessions' trajectories taken together, and how
many maps there are at the end, as Markdown. ARGUMENTS go to every run. Exit code 3: there is more
than one map, or the joint error is above RATIO times that of the single session, and 2 mm.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

MISSED_BAR = 3
SLACK_M = 0.002


def call(*arguments):
    result = subprocess.run([str(a) for a in arguments], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, encoding="utf-8", check=False)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}\n{result.stderr}")
    return result.stdout


def poses(folder):
    lines = (folder / "trajectory.txt").read_text(encoding="utf-8").splitlines()
    return [line for line in lines if not line.startswith("#")]


class Sessions:
    def __init__(self, arguments, folder):
        self.binary = arguments.binary
        self.sequence = arguments.sequence
        self.common = ["--deterministic", "--detector", "none", *arguments.arguments]
        self.folder = folder

    def run(self, name, *arguments):
        call(self.binary, "run", self.sequence, "--out", self.folder / name, *self.common,
             *arguments)
        report = json.loads((self.folder / name / "run.json").read_text(encoding="utf-8"))
        return report["accuracy"]["trajectory"]["ate_m"]["rmse"], report["frames"]

    def joint_error_m(self, names):
        joint = self.folder / "joint.txt"
        joint.write_text("\n".join(p for n in names for p in poses(self.folder / n)) + "\n",
                         encoding="utf-8")
        out = self.folder / "joint.json"
        call(self.binary, "eval", "ate", self.sequence, joint, "--json", out)
        return json.loads(out.read_text(encoding="utf-8"))["statistics_m"]["rmse"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sequence", type=pathlib.Path)
    parser.add_argument("--binary", default="build/changing-slam", type=pathlib.Path)
    parser.add_argument("--split", type=int, help="frames of the first session; default: half")
    parser.add_argument("--fail-above", type=float, default=1.2, metavar="RATIO")
    parser.add_argument("arguments", nargs="*")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="two_sessions_") as name:
        folder = pathlib.Path(name)
        sessions = Sessions(arguments, folder)
        whole_m, frames = sessions.run("whole")
        split = arguments.split or frames["input"] // 2
        first, last = folder / "first.map", folder / "last.map"
        first_m, first_frames = sessions.run("first", "--frames", split, "--save-map", first)
        second_m, second_frames = sessions.run("second", "--from", split, "--map", first,
                                               "--save-map", last)
        joint_m = sessions.joint_error_m(["first", "second"])
        maps = json.loads(call(arguments.binary, "map", "info", last, "--json"))["maps"]
    print("| sessions | frames in the trajectory | ATE RMSE | maps |\n|---|---|---|---|")
    print(f"| one | {frames['in_trajectory']} of {frames['input']} | {1e3 * whole_m:.1f} mm | |")
    for title, error_m, count in (("first of two", first_m, first_frames),
                                  ("second of two", second_m, second_frames)):
        print(f"| {title} | {count['in_trajectory']} of {count['input']} | {1e3 * error_m:.1f} mm | |")
    print(f"| both together | {first_frames['in_trajectory'] + second_frames['in_trajectory']} | "
          f"{1e3 * joint_m:.1f} mm | {len(maps)} |")
    is_bad = len(maps) != 1 or joint_m > arguments.fail_above * whole_m + SLACK_M
    return MISSED_BAR if is_bad else 0


if __name__ == "__main__":
    sys.exit(main())
