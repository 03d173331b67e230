# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""dataset render and dataset list, on tiny sequences."""

import signal
import subprocess

import cli_support
from cli_support import CliTestCase, binary, run

SMALL = ("--size", "64x48", "--frames", "3")
ENTRIES = {"rgb", "depth", "rgb.txt", "depth.txt", "associations.txt", "groundtruth.txt",
           "camera.yaml"}


def contents(folder):
    return {path.relative_to(folder): path.read_bytes()
            for path in sorted(folder.rglob("*")) if path.is_file()}


class RenderTestCase(CliTestCase):
    def setUp(self):
        self.folder = self.make_folder()
        self.out = self.folder / "out"

    def render(self, *arguments, name="demo", size=SMALL):
        return run("dataset", "render", name, "--out", self.out, *size, *arguments)


class RenderTest(RenderTestCase):
    def test_writes_a_sound_sequence_and_says_its_size_first(self):
        result = self.render()
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
        self.assertRegex(result.stderr.splitlines()[0], r"3 frames of 64x48 at 30 Hz, about \d+ kB")
        self.assertIn("3 of 3", result.stderr)
        self.assertEqual({path.name for path in self.out.iterdir()}, ENTRIES)
        check = run("dataset", "check", self.out)
        self.assertEqual(check.returncode, 0, check.stdout)
        self.assertIn("\nsound\n", check.stdout)

    def test_number_of_jobs_does_not_change_a_byte(self):
        results = []
        for jobs in (1, 2):
            self.out = self.folder / str(jobs)
            self.assertEqual(self.render("--jobs", jobs).returncode, 0)
            results.append(contents(self.out))
        self.assertEqual(len(results[0]), 11)
        self.assertEqual(results[0], results[1])

    def test_seed_and_noise_change_the_images(self):
        depths = []
        for arguments in ((), ("--seed", "2"), ("--noise", "off")):
            self.out = self.folder / f"out{len(depths)}"
            self.assertEqual(self.render(*arguments).returncode, 0)
            depths.append((self.out / "depth" / "1.000000.png").read_bytes())
        self.assertEqual(len(set(depths)), 3)

    def test_rate_sets_the_timestamps(self):
        self.assertEqual(self.render("--fps", "10").returncode, 0)
        self.assertTrue((self.out / "rgb" / "1.200000.png").exists())

    def test_more_frames_than_the_path_has_are_announced(self):
        self.assertIn("warning: ", self.render("--fps", "0.1").stderr)

    def test_list_names_what_can_be_rendered_on_stdout(self):
        result = run("dataset", "list")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, r"(?m)^demo +20 s ")


class OutputFolderTest(RenderTestCase):
    def test_folder_that_is_not_empty_is_left_alone_and_the_remedy_named(self):
        self.out.mkdir()
        (self.out / "rgb.txt").write_text("mine", encoding="utf-8")
        self.assert_one_line_error(self.render(), 1, self.out, "--force")
        self.assertEqual(contents(self.out).popitem()[1], b"mine")

    def test_force_replaces_a_sequence_without_a_rest(self):
        self.assertEqual(self.render("--fps", "5").returncode, 0)
        self.assertEqual(self.render("--force").returncode, 0)
        self.assertEqual(len(list((self.out / "rgb").iterdir())), 3)

    def test_force_does_not_touch_what_is_no_sequence(self):
        self.out.mkdir()
        (self.out / "thesis.tex").write_text("years", encoding="utf-8")
        self.assert_one_line_error(self.render("--force"), 1, "thesis.tex")
        self.assertTrue((self.out / "thesis.tex").exists())

    def test_folder_that_cannot_be_made_is_named(self):
        self.folder.joinpath("file").write_text("", encoding="utf-8")
        self.out = self.folder / "file" / "out"
        self.assert_last_line_is_error(self.render(), 1, self.out)

    def test_file_in_place_of_the_folder_is_named(self):
        self.out.write_text("", encoding="utf-8")
        self.assert_one_line_error(self.render(), 1, self.out)


class UsageTest(RenderTestCase):
    def test_unknown_sequence_names_the_nearest(self):
        self.assert_one_line_error(self.render(name="dmo"), 2, "'dmo'", "'demo'", "dataset list")

    def test_silly_values_are_usage_errors_that_name_the_option(self):
        cases = [("--size", size) for size in ("0x0", "64", "64x", "x48", "64x48x1", "-64x48",
                                               "31x48", "64x4097", "99999999999x48", "big")]
        cases += [("--fps", fps) for fps in ("0", "-30", "nan", "inf", "1001", "fast")]
        cases += [("--frames", "0"), ("--frames", "-1"), ("--jobs", "0"), ("--seed", "-1"),
                  ("--seed", "1.5"), ("--noise", "loud")]
        for option, value in cases:
            with self.subTest(option=option, value=value):
                result = self.render(f"{option}={value}", size=())
                self.assert_one_line_error(result, 2, option)
                self.assertFalse(self.out.exists())

    def test_missing_name_or_folder_is_a_usage_error(self):
        self.assert_one_line_error(run("dataset", "render", "--out", self.out), 2, "name")
        self.assert_one_line_error(run("dataset", "render", "demo"), 2, "--out")


class InterruptTest(RenderTestCase):
    def test_interrupted_render_leaves_nothing_that_looks_complete(self):
        command = [binary(), "dataset", "render", "demo", "--out", self.out, "--size", "64x48",
                   "--fps", "200"]
        with subprocess.Popen(command, stderr=subprocess.PIPE, encoding="utf-8") as process:
            process.stderr.readline()  # what it is going to do
            first = process.stderr.readline()  # a tenth is done
            process.send_signal(signal.SIGINT)
            _, rest = process.communicate(timeout=cli_support.TIMEOUT_S)
        self.assertEqual(process.returncode, 130, first + rest)
        self.assertIn("interrupted", rest)
        self.assertEqual(list(self.out.iterdir()), [])


if __name__ == "__main__":
    cli_support.main()
