#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Maps that outlive a run: run --save-map, --map and --localise-only, and relocalise."""

import json
import os
import signal
import subprocess
import time

import tiny_dataset
from cli_support import CliTestCase, binary, main, run

FAST = ["--deterministic", "--detector", "none"]


def move_elsewhere(sequence, num_images):
    """The same camera path in front of another board."""
    board = tiny_dataset._board(tiny_dataset.WIDTH + num_images,
                                tiny_dataset.HEIGHT + num_images, seed=2)
    for index in range(num_images):
        rows = [bytes(v for value in line for v in (value, value, value))
                for line in tiny_dataset.view(board, index, num_images)]
        (sequence / "rgb" / f"{index:04}.png").write_bytes(tiny_dataset.png(rows, 8, 3))


class MapCase(CliTestCase):
    NUM_IMAGES = 40

    def setUp(self):
        self.folder = self.make_folder()
        self.map = self.folder / "room.map"
        self.sequence = tiny_dataset.write(self.folder / "tiny", self.NUM_IMAGES, self.NUM_IMAGES)

    def run_slam(self, name, *arguments, sequence=None):
        return run("run", sequence or self.sequence, "--out", self.folder / name, *FAST,
                   *arguments)

    def save_first_half(self):
        result = self.run_slam("first", "--frames", self.NUM_IMAGES // 2, "--save-map", self.map)
        self.assertEqual(result.returncode, 0, result.stderr)

    def info(self):
        result = run("map", "info", self.map, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def poses(self, name, file="trajectory.txt"):
        lines = (self.folder / name / file).read_text(encoding="utf-8").splitlines()
        return [[float(v) for v in line.split()] for line in lines if not line.startswith("#")]


class ContinueTest(MapCase):
    def test_second_run_goes_on_in_the_world_of_the_first(self):
        self.save_first_half()
        before = self.info()
        half = self.NUM_IMAGES // 2
        result = self.run_slam("second", "--from", half, "--map", self.map, "--save-map", self.map)
        self.assertEqual(result.returncode, 0, result.stderr)
        poses = self.poses("second")
        self.assertGreaterEqual(len(poses), half - 2)
        # Down the board by one pixel, 1.5 m / 260 px, a frame; the first frame of all is the origin.
        for pose in poses:
            index = round((pose[0] - 1000) * tiny_dataset.RATE_HZ)
            metres = tiny_dataset.DEPTH_M / tiny_dataset.FOCAL_PX
            self.assertAlmostEqual(pose[1], half * metres, delta=0.01)
            self.assertAlmostEqual(pose[2], (index - half) * metres, delta=0.01)
        after = self.info()
        self.assertEqual(len(after["maps"]), 1)
        self.assertGreater(after["maps"][0]["keyframes"], before["maps"][0]["keyframes"])
        self.assertEqual([s["name"] for s in after["sessions"]], ["tiny", "tiny"])
        stamps = [pose[0] for pose in self.poses("second", "keyframes.txt")]
        self.assertTrue(stamps and min(stamps) >= 1000 + half / tiny_dataset.RATE_HZ - 1e-6)
        report = json.loads((self.folder / "second" / "run.json").read_text(encoding="utf-8"))
        self.assertEqual(report["map_file"], str(self.map))
        self.assertGreater(report["map"]["earlier_keyframes"], 0)

    def test_deterministic_runs_give_the_same_bytes(self):
        self.save_first_half()
        contents = []
        for name in ("one", "two"):
            saved = self.folder / f"{name}.map"
            result = self.run_slam(name, "--from", self.NUM_IMAGES // 2, "--map", self.map,
                                   "--save-map", saved)
            self.assertEqual(result.returncode, 0, result.stderr)
            files = [saved] + [self.folder / name / file for file in (
                "trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ply", "loops.json")]
            contents.append([file.read_bytes() for file in files])
        self.assertEqual(contents[0], contents[1])

    def test_unknown_place_starts_a_map_of_its_own_and_says_so(self):
        self.save_first_half()
        move_elsewhere(self.sequence, self.NUM_IMAGES)
        result = self.run_slam("second", "--map", self.map, "--save-map", self.map, "--set",
                               "tracking.recently_lost_time=0.2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("no place of the map", result.stderr)
        self.assertEqual(len(self.info()["maps"]), 2)


class LocaliseOnlyTest(MapCase):
    def test_gives_poses_in_the_map_and_leaves_it_alone(self):
        self.save_first_half()
        before = self.map.read_bytes()
        result = self.run_slam("second", "--frames", 20, "--map", self.map, "--localise-only")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreaterEqual(len(self.poses("second")), 18)
        self.assertEqual(self.poses("second", "keyframes.txt"), [])
        self.assertEqual(self.map.read_bytes(), before)

    def test_says_when_nothing_was_found(self):
        self.save_first_half()
        move_elsewhere(self.sequence, self.NUM_IMAGES)
        result = self.run_slam("second", "--map", self.map, "--localise-only")
        self.assert_last_line_is_error(result, 1, "no frame of", self.sequence, self.map)

    def test_needs_a_map_and_saves_none(self):
        self.assert_one_line_error(self.run_slam("x", "--localise-only"), 2, "--map")
        self.assert_one_line_error(
            self.run_slam("x", "--localise-only", "--map", "a.map", "--save-map", "b.map"), 2,
            "--save-map")


class BadMapTest(MapCase):
    def assert_refused(self, *parts):
        for result in (self.run_slam("bad", "--map", self.map),
                       run("relocalise", self.map, self.sequence, "--detector", "none")):
            self.assert_last_line_is_error(result, 1, *parts)

    def test_missing_file(self):
        self.assert_refused("there is no map file", self.map)

    def test_empty_map(self):
        subprocess.run([os.environ["CSLAM_MAKE_TEST_MAP"], self.map, "empty"], check=True)
        self.assert_refused("is empty", self.map)

    def test_map_of_another_camera_names_what_differs(self):
        self.save_first_half()
        tiny_dataset.write_camera(self.sequence / "camera.yaml", fx=250.0)
        self.assert_refused("another camera", "fx 250 instead of 260")

    def test_map_of_a_newer_version_and_of_an_older_one(self):
        self.save_first_half()
        data = bytearray(self.map.read_bytes())
        for version, part in ((99, "use a newer one"), (1, "make it anew")):
            data[63] = version
            self.map.write_bytes(data)
            self.assert_refused(f"map format {version}", part)

    def test_truncated_and_damaged_maps(self):
        self.save_first_half()
        whole = self.map.read_bytes()
        self.map.write_bytes(whole[:len(whole) // 2])
        self.assert_refused("damaged", self.map)
        damaged = bytearray(whole)
        damaged[len(whole) // 2] ^= 0x10
        self.map.write_bytes(damaged)
        self.assert_refused("damaged", self.map)

    def test_map_of_another_pyramid(self):
        self.save_first_half()
        result = self.run_slam("bad", "--map", self.map, "--set", "tracking.orb.num_levels=5")
        self.assert_last_line_is_error(result, 1, "another image pyramid")

    def test_place_to_save_in_is_missing(self):
        result = self.run_slam("bad", "--save-map", self.folder / "none" / "a.map")
        self.assert_last_line_is_error(result, 1, "none")


class InterruptedTest(MapCase):
    """Of a sequence so long that it cannot end before it is interrupted."""

    def start(self):
        long = tiny_dataset.write(self.folder / "long", 6000, 30)
        return subprocess.Popen(
            [binary(), "run", str(long), "--out", str(self.folder / "long_run"), "--detector",
             "none", "--save-map", str(self.map), "--save-every", "1"],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, encoding="utf-8")

    def wait_for_map(self, process):
        deadline = time.monotonic() + 60
        while not self.map.exists():
            self.assertIsNone(process.poll(), "ended by itself")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)

    def test_kill_leaves_a_map_to_go_on_in(self):
        process = self.start()
        self.wait_for_map(process)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        self.assertGreater(self.info()["maps"][0]["keyframes"], 0)
        result = self.run_slam("second", "--frames", 10, "--map", self.map, "--localise-only")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_ctrl_c_saves_the_map_of_the_end(self):
        process = self.start()
        self.wait_for_map(process)
        process.send_signal(signal.SIGINT)
        error = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130, error)
        last_pose = self.poses("long_run", "keyframes.txt")[-1][0]
        self.assertAlmostEqual(float(self.info()["maps"][0]["last_stamp"]), last_pose, places=5)


class RelocaliseTest(MapCase):
    def relocalise(self, *arguments):
        return run("relocalise", self.map, self.sequence, "--detector", "none", *arguments)

    def test_finds_frames_and_tells_their_errors(self):
        self.assertEqual(self.run_slam("all", "--save-map", self.map).returncode, 0)
        result = self.relocalise("--from", 5, "--frames", 10)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("10 of 10 frames", result.stdout)
        self.assertIn("error, median", result.stdout)
        report = json.loads(self.relocalise("--frames", 4, "--json").stdout)
        self.assertEqual((report["format"], report["found"]), ("relocalisation", 4))
        self.assertLess(report["errors"]["max_m"], 0.02)
        self.assertEqual([r["frame"] for r in report["results"]], [0, 1, 2, 3])
        self.assertTrue(all(r["is_found"] for r in report["results"]))

    def test_says_when_nothing_was_found(self):
        self.save_first_half()
        move_elsewhere(self.sequence, self.NUM_IMAGES)
        self.assert_last_line_is_error_after_output(self.relocalise("--frames", 3))

    def assert_last_line_is_error_after_output(self, result):
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("0 of 3 frames", result.stdout)
        self.assertIn("none of 3 frames", result.stderr.splitlines()[-1])

    def test_truth_of_another_recording_is_not_believed(self):
        self.assertEqual(self.run_slam("all", "--save-map", self.map).returncode, 0)
        truth = self.sequence / "groundtruth.txt"
        lines = truth.read_text(encoding="utf-8").splitlines()
        scaled = [lines[0]] + [
            " ".join([f[0], str(50 * float(f[2])), str(-30 * float(f[1]))] + f[3:])
            for f in (line.split() for line in lines[1:])]
        truth.write_text("\n".join(scaled) + "\n", encoding="utf-8")
        result = self.relocalise("--frames", 3)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("does not fit the ground truth", result.stderr)
        self.assertNotIn("error, median", result.stdout)


if __name__ == "__main__":
    main()
