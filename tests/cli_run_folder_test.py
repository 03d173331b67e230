# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""What run leaves in its folder and says about it, read back by other programs' rules."""

import csv
import json
import os
import re
import signal
import struct
import subprocess
import tempfile
import xml.etree.ElementTree

import cli_support
import tiny_dataset
from cli_support import CliTestCase, binary, run

NUM_FRAMES = 20


class FolderTestCase(CliTestCase):
    def setUp(self):
        self.folder = self.make_folder()
        self.out = self.folder / "out"
        self.sequence = tiny_dataset.write(self.folder / "tiny", num_frames=NUM_FRAMES)

    def run_slam(self, *arguments, **popen):
        return run("run", self.sequence, "--out", self.out, *arguments, **popen)

    def run_well(self, *arguments):
        result = self.run_slam("--deterministic", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def report(self):
        return json.loads((self.out / "run.json").read_text(encoding="utf-8"))

    def num_poses(self):
        lines = (self.out / "trajectory.txt").read_text(encoding="utf-8").splitlines()
        return sum(not line.startswith("#") for line in lines)


class FormatsTest(FolderTestCase):
    def test_frames_csv_has_a_row_for_each_frame_and_a_column_for_each_stage(self):
        self.run_well()
        with (self.out / "frames.csv").open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["frame"] for row in rows], [str(i) for i in range(NUM_FRAMES)])
        self.assertEqual({row["state"] for row in rows}, {"tracking"})
        self.assertEqual(rows[3]["timestamp_s"], tiny_dataset.stamp(3))
        self.assertEqual(rows[0]["keyframe"], "starts_map")
        for row in rows:
            stages = [float(ms or 0) for name, ms in row.items()
                      if name.endswith("_ms") and name != "total_ms"]
            self.assertAlmostEqual(float(row["total_ms"]), sum(stages), delta=0.01)

    def test_map_has_as_many_points_as_run_json_says_and_they_lie_on_the_board(self):
        self.run_well()
        header, _, body = (self.out / "map.ply").read_bytes().partition(b"end_header\n")
        count = int(re.search(rb"element vertex (\d+)", header).group(1))
        self.assertEqual(count, self.report()["map"]["points"])
        points = list(struct.iter_unpack("<3f3B", body))
        self.assertEqual(len(points), count)
        near = [p for p in points if abs(p[2] - tiny_dataset.DEPTH_M) < 0.05]
        self.assertGreater(len(near), 0.95 * count)
        self.assertGreater(len({p[3:] for p in points}), 20, "all points have the same colour")

    def test_plot_is_well_formed(self):
        self.run_well()
        root = xml.etree.ElementTree.parse(self.out / "trajectory.svg").getroot()
        self.assertTrue(root.tag.endswith("svg"))

    def test_run_json_adds_up(self):
        self.run_well()
        report = self.report()
        frames = report["frames"]
        self.assertEqual(frames["input"], NUM_FRAMES)
        self.assertEqual(frames["in_trajectory"], self.num_poses())
        self.assertEqual(frames["tracked_percent"], 100)
        self.assertEqual(frames["processed"], sum(
            frames[state] for state in ("initialising", "tracking", "recently_lost", "lost")))
        cost = report["cost"]
        self.assertGreater(cost["peak_memory_bytes"], 1e6)
        self.assertGreater(cost["cpu_s"], 0)
        self.assertGreater(cost["first_pose_ms"], 0)
        self.assertEqual(report["stages"]["tracking"]["count"], NUM_FRAMES)
        for name in ("trajectory", "trajectory_live"):
            self.assertLess(report["accuracy"][name]["ate_m"]["rmse"], 0.01)

    def test_arguments_are_kept_as_given(self):
        self.run_well("--set", "tracking.orb.num_features=700")
        self.assertEqual(self.report()["arguments"],
                         ["run", str(self.sequence), "--out", str(self.out), "--deterministic",
                          "--set", "tracking.orb.num_features=700"])


class AnnouncementTest(FolderTestCase):
    def test_camera_is_announced_and_depth_scale_overrides_it(self):
        result = self.run_well("--depth-scale", "2500")
        self.assertRegex(result.stderr, r"camera: .*camera\.yaml.*2500")
        self.assertEqual(self.report()["camera"]["depth_units_per_m"], 2500)
        self.assertIn("camera.yaml", self.report()["camera"]["chosen_by"])

    def test_results_go_to_a_folder_named_after_sequence_and_time_by_default(self):
        result = run("run", self.sequence, "--deterministic", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        (folder,) = (self.folder / "runs").iterdir()
        self.assertRegex(folder.name, r"\Atiny-\d{8}-\d{6}\Z")
        self.assertIn(f"runs/{folder.name}", result.stderr)
        self.assertIn(f"runs/{folder.name}", result.stdout)

    def test_path_length_stands_in_for_accuracy_without_ground_truth(self):
        (self.sequence / "groundtruth.txt").unlink()
        result = self.run_well()
        self.assertNotIn("ATE", result.stdout)
        self.assertRegex(result.stdout, r"path length +0\.\d+ m")
        self.assertIsNone(self.report()["accuracy"])

    def test_nothing_is_said_on_stderr_when_the_log_is_off(self):
        result = run("--log-level", "off", "run", self.sequence, "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))


class TroubleTest(FolderTestCase):
    def test_broken_ground_truth_loses_nothing_but_the_accuracy(self):
        (self.sequence / "groundtruth.txt").write_text("1 2 3\n", encoding="utf-8")
        result = self.run_well()
        self.assertIn("groundtruth.txt:1", result.stderr)
        self.assertEqual(self.num_poses(), NUM_FRAMES)
        self.assertIn("groundtruth.txt:1", self.report()["accuracy"]["problems"][0])

    def test_frames_without_depth_are_an_error_that_says_so_and_the_folder_is_complete(self):
        for image in (self.sequence / "depth").iterdir():
            image.write_bytes(tiny_dataset.flat_depth(0.0))
        result = self.run_slam()
        self.assert_last_line_is_error(result, 1, "no frame", "depth")
        self.assertEqual(self.report()["frames"]["in_trajectory"], 0)
        self.assertEqual(self.num_poses(), 0)

    def test_unreadable_image_is_counted_in_run_json_and_against_tracked_percent(self):
        image = self.sequence / "rgb" / "0010.png"
        image.write_bytes(image.read_bytes()[:500])
        self.run_well()
        frames = self.report()["frames"]
        self.assertEqual((frames["input"], frames["unreadable"]), (NUM_FRAMES, 1))
        self.assertEqual(frames["tracked_percent"], 95)
        self.assertIn("0010.png", self.report()["frame_problems"][0])

    def test_deterministic_runs_refuse_what_depends_on_the_clock_or_on_threads(self):
        for arguments in (("--rate", "sensor"), ("--set", "pipeline.library_threads=2")):
            with self.subTest(arguments=arguments):
                self.assert_one_line_error(self.run_slam("--deterministic", *arguments), 2)
                self.assertFalse(self.out.exists())

    def test_more_frames_than_there_are_is_all_of_them(self):
        self.run_well("--from", "15", "--frames", "100")
        self.assertEqual(self.num_poses(), 5)

    def test_failed_run_takes_the_mark_of_an_earlier_one(self):
        self.run_well()
        image = self.sequence / "rgb" / "0010.png"
        image.write_bytes(b"")
        self.assertEqual(self.run_slam("--strict").returncode, 1)
        self.assertFalse((self.out / "run.json").exists())

    def test_full_disk_is_named_and_the_table_is_shown_all_the_same(self):
        if os.geteuid() != 0:
            self.skipTest("needs root to mount a small disk")
        disk = tempfile.mkdtemp(prefix="cslam_disk_")
        self.addCleanup(os.rmdir, disk)
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=20k", "tmpfs", disk],
                               stderr=subprocess.PIPE, check=False)
        if mount.returncode != 0:
            self.skipTest("cannot mount a small disk here")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        self.out = self.out.__class__(disk) / "out"
        result = self.run_slam("--deterministic")
        self.assert_last_line_is_error(result, 1, "No space left", disk)
        self.assertIn("tracked", result.stdout)
        names = {path.name for path in self.out.iterdir()}
        self.assertNotIn("run.json", names)
        self.assertFalse([name for name in names if ".tmp-" in name])
        self.assertEqual(self.num_poses(), NUM_FRAMES)


class RateTest(FolderTestCase):
    def test_frames_that_come_too_fast_are_dropped_and_counted_at_sensor_rate(self):
        rate_hz, tiny_dataset.RATE_HZ = tiny_dataset.RATE_HZ, 10000
        self.addCleanup(setattr, tiny_dataset, "RATE_HZ", rate_hz)
        self.sequence = tiny_dataset.write(self.folder / "fast", num_frames=200)
        result = self.run_slam("--rate", "sensor")
        self.assertEqual(result.returncode, 0, result.stderr)
        frames = self.report()["frames"]
        self.assertGreater(frames["dropped"], 0)
        self.assertEqual(frames["processed"] + frames["dropped"], 200)
        self.assertLess(frames["tracked_percent"], 100)

    def test_interruption_is_told_by_exit_code_and_run_json(self):
        self.sequence = tiny_dataset.write(self.folder / "long", num_frames=1800)  # a minute
        with subprocess.Popen([binary(), "run", self.sequence, "--out", self.out, "--rate",
                               "sensor"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              encoding="utf-8") as process:
            for line in process.stderr:  # until progress is reported
                if line.startswith("frame "):
                    break
            process.send_signal(signal.SIGTERM)
            stdout, stderr = process.communicate(timeout=cli_support.TIMEOUT_S)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertIn("interrupted", stderr)
        self.assertIn("tracked", stdout)
        report = self.report()
        self.assertTrue(report["was_interrupted"])
        self.assertEqual(report["frames"]["in_trajectory"], self.num_poses())
        self.assertGreater(self.num_poses(), 10)
        self.assertLess(report["frames"]["input"], 1700)


if __name__ == "__main__":
    cli_support.main()
