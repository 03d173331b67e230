# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""The eval command on trajectories written here."""

import json
import math

import cli_support
from cli_support import CliTestCase, run


def trajectory(num_poses=50, noise_m=0.0, shift_m=0.0):
    """A circle of 1 m radius; noise alternates between up and down."""
    lines = ["# timestamp tx ty tz qx qy qz qw"]
    for i in range(num_poses):
        angle = 2 * math.pi * i / num_poses
        z = noise_m * (-1) ** i
        lines.append(f"{100 + i / 10:.6f} {math.cos(angle) + shift_m:.6f} {math.sin(angle):.6f} "
                     f"{z:.6f} 0 0 0 1")
    return "\n".join(lines) + "\n"


class EvalTest(CliTestCase):
    def setUp(self):
        self.folder = self.make_folder()
        self.reference = self.write("reference.txt", trajectory())

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def test_a_trajectory_agrees_with_itself(self):
        for kind in ("ate", "rpe"):
            with self.subTest(kind=kind):
                result = run("eval", kind, self.reference, self.reference, "--json")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIsInstance(json.loads(result.stdout), dict)

    def test_a_shifted_trajectory_is_aligned_by_default_only(self):
        shifted = self.write("shifted.txt", trajectory(shift_m=5.0))
        bar = ("--fail-above", "0.01")
        self.assertEqual(run("eval", "ate", self.reference, shifted, *bar).returncode, 0)
        self.assertEqual(
            run("eval", "ate", self.reference, shifted, "--no-align", *bar).returncode, 3)

    def test_exit_code_tells_whether_the_bar_was_missed(self):
        noisy = self.write("noisy.txt", trajectory(noise_m=0.05))
        passed = run("eval", "ate", self.reference, noisy, "--fail-above", "0.06")
        missed = run("eval", "ate", self.reference, noisy, "--fail-above", "0.04")
        self.assertEqual((passed.returncode, missed.returncode), (0, 3), missed.stderr)
        self.assertNotEqual(missed.stdout, "", "the figures are printed all the same")

    def test_missing_file_is_named(self):
        missing = self.folder / "none.txt"
        self.assert_one_line_error(run("eval", "ate", self.reference, missing), 1, missing)

    def test_broken_line_is_named_with_file_and_line(self):
        broken = self.write("broken.txt", "1 0 0 0 0 0 0 1\n2 0 0 oops 0 0 0 1\n")
        self.assert_one_line_error(run("eval", "ate", self.reference, broken), 1, f"{broken}:2")

    def test_trajectories_of_different_times_are_an_error(self):
        late = self.write("late.txt", "9000 0 0 0 0 0 0 1\n9001 1 0 0 0 0 0 1\n")
        self.assert_one_line_error(run("eval", "ate", self.reference, late), 1)

    def test_missing_argument_is_a_usage_error(self):
        self.assert_one_line_error(run("eval", "ate", self.reference), 2)
        self.assert_one_line_error(run("eval"), 2, "ate", "rpe")

    def test_unknown_kind_names_the_nearest(self):
        self.assert_one_line_error(run("eval", "rep", "a", "b"), 2, "'rpe'")


if __name__ == "__main__":
    cli_support.main()
