# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""The run command on a small sequence written here: run folder, bad input, Ctrl-C."""

import json
import resource
import signal
import subprocess

import cli_support
import tiny_dataset
from cli_support import CliTestCase, binary, run

RUN_FILES = {"trajectory.txt", "trajectory_live.txt", "keyframes.txt", "frames.csv", "loops.json", "map.ply",
             "config.yaml", "run.json", "trajectory.svg", "grid.yaml", "grid.pgm", "objects.json",
             "changes.json"}
REPEATABLE_FILES = RUN_FILES - {"frames.csv", "run.json"}  # these two hold times


class RunTestCase(CliTestCase):
    def setUp(self):
        self.folder = self.make_folder()
        self.out = self.folder / "out"
        self.sequence = tiny_dataset.write(self.folder / "tiny")

    def run_slam(self, *arguments, **popen):
        return run("run", self.sequence, "--out", self.out, "--deterministic", *arguments, **popen)

    def poses(self, name="trajectory.txt"):
        lines = (self.out / name).read_text(encoding="utf-8").splitlines()
        return [line for line in lines if not line.startswith("#")]


class RunFolderTest(RunTestCase):
    def test_writes_the_whole_run_folder_and_a_table(self):
        result = self.run_slam()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual({path.name for path in self.out.iterdir()} & RUN_FILES, RUN_FILES)
        self.assertEqual(len(self.poses()), 20)
        self.assertIn("ATE", result.stdout)
        self.assertIn(str(self.out), result.stdout + result.stderr)

    def test_threaded_run_tracks_every_frame_too(self):
        result = run("run", self.sequence, "--out", self.out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(self.poses()), 20)

    def test_deterministic_runs_give_the_same_bytes(self):
        contents = []
        for name in ("first", "second"):
            self.out = self.folder / name
            self.assertEqual(self.run_slam().returncode, 0)
            contents.append({file: (self.out / file).read_bytes() for file in REPEATABLE_FILES})
        self.assertEqual(contents[0], contents[1])

    def test_trajectory_passes_the_bar_in_eval(self):
        self.assertEqual(self.run_slam().returncode, 0)
        result = run("eval", "ate", self.sequence, self.out, "--fail-above", "0.01")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_effective_configuration_is_written_and_accepted_again(self):
        self.assertEqual(self.run_slam("--set", "tracking.orb.num_features=700").returncode, 0)
        printed = run("config", "--yaml", "--config", self.out / "config.yaml").stdout
        self.assertIn("num_features: 700", printed)

    def test_run_json_names_arguments_version_and_camera(self):
        self.assertEqual(self.run_slam().returncode, 0)
        report = json.loads((self.out / "run.json").read_text(encoding="utf-8"))
        text = json.dumps(report)
        for part in ("--deterministic", "version", "commit", "camera.yaml"):
            self.assertIn(part, text)

    def test_from_and_frames_choose_a_part(self):
        self.assertEqual(self.run_slam("--from", "5", "--frames", "8").returncode, 0)
        poses = self.poses()
        self.assertEqual(len(poses), 8)
        self.assertTrue(poses[0].startswith(tiny_dataset.stamp(5)), poses[0])

    def test_straight_path_whose_alignment_is_open_is_no_error(self):
        result = self.run_slam("--frames", "8")  # moves along one line only
        self.assertEqual(result.returncode, 0, result.stderr)


class BadInputTest(RunTestCase):
    def test_missing_folder_is_named(self):
        self.sequence = self.folder / "none"
        self.assert_last_line_is_error(self.run_slam(), 1, self.sequence)

    def test_folder_without_a_dataset_says_what_was_looked_for(self):
        self.sequence = self.sequence / "rgb"
        self.assert_last_line_is_error(self.run_slam(), 1, "rgb.txt")

    def test_broken_list_line_is_named_with_file_and_line(self):
        list_file = self.sequence / "rgb.txt"
        list_file.write_text(list_file.read_text(encoding="utf-8") + "oops\n", encoding="utf-8")
        self.assert_last_line_is_error(self.run_slam(), 1, f"{list_file}:22")

    def test_unknown_camera_lists_the_presets(self):
        (self.sequence / "camera.yaml").unlink()
        self.assert_last_line_is_error(self.run_slam(), 1, "tum_fr1", "bonn")
        self.assert_last_line_is_error(self.run_slam("--camera", "tum_fr9"), 1, "tum_fr9")

    def test_camera_that_is_not_a_number_is_refused(self):
        tiny_dataset.write_camera(self.sequence / "camera.yaml", fx="nan")
        self.assert_last_line_is_error(self.run_slam(), 1, "camera.yaml:3", "fx")

    def test_camera_of_another_size_is_refused(self):
        self.assert_last_line_is_error(self.run_slam("--camera", "tum_fr1"), 1, "640")

    def test_truncated_image_is_skipped_and_counted(self):
        image = self.sequence / "rgb" / "0010.png"
        image.write_bytes(image.read_bytes()[:500])
        result = self.run_slam()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(self.poses()), 19)
        self.assertIn("0010.png", result.stderr)

    def test_truncated_image_stops_a_strict_run(self):
        image = self.sequence / "rgb" / "0010.png"
        image.write_bytes(image.read_bytes()[:500])
        self.assert_last_line_is_error(self.run_slam("--strict"), 1, "0010.png")

    def test_missing_image_in_the_list_is_skipped_and_counted(self):
        (self.sequence / "depth" / "0007.png").unlink()
        result = self.run_slam()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(self.poses()), 19)

    def test_frames_without_depth_track_nothing_but_end_well(self):
        for image in (self.sequence / "depth").iterdir():
            image.write_bytes(tiny_dataset.flat_depth(0.0))
        result = self.run_slam()
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertNotIn("internal error", result.stderr)

    def test_bad_options_are_usage_errors(self):
        for arguments in (("--rate", "fast"), ("--frames", "-1"), ("--from", "x"),
                          ("--set", "tracking.min_inliers=many"), ("--determinstic",)):
            with self.subTest(arguments=arguments):
                self.assert_last_line_is_error(self.run_slam(*arguments), 2)
                self.assertFalse(self.out.exists())

    def test_start_behind_the_end_is_an_error(self):
        self.assert_last_line_is_error(self.run_slam("--from", "1000"), 1)

    def test_output_folder_that_cannot_be_made_is_an_error(self):
        (self.folder / "file").write_text("", encoding="utf-8")
        self.out = self.folder / "file" / "out"
        self.assert_last_line_is_error(self.run_slam(), 1, self.out)

    def test_full_disk_is_an_error_and_leaves_no_half_written_file(self):
        def limit_file_size():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (600, 600))

        result = self.run_slam(preexec_fn=limit_file_size)
        self.assert_last_line_is_error(result, 1)
        for path in self.out.iterdir() if self.out.exists() else ():
            if path.name in RUN_FILES:
                self.assertLess(path.stat().st_size, 600, f"{path} was cut off")


class InterruptTest(RunTestCase):
    def test_interrupted_run_finishes_its_folder_and_tells_by_its_exit_code(self):
        sequence = tiny_dataset.write(self.folder / "long", num_frames=1800)  # a minute
        with subprocess.Popen([binary(), "run", sequence, "--out", self.out, "--rate", "sensor"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              encoding="utf-8") as process:
            first = process.stderr.readline()  # the program is under way
            process.send_signal(signal.SIGINT)
            _, rest = process.communicate(timeout=cli_support.TIMEOUT_S)
        self.assertNotEqual(process.returncode, 0, first + rest)
        self.assertGreater(process.returncode, 0, "killed instead of finished: " + first + rest)
        self.assertIn("trajectory.txt", {path.name for path in self.out.iterdir()})
        self.assertLess(len(self.poses()), 1700)


if __name__ == "__main__":
    cli_support.main()
