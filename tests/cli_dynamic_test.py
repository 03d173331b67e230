# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""The run command where people move: what it reads, bad detections and models, crowded pictures."""

import csv
import json
import random
import shutil
import struct
import tempfile
import pathlib

import cli_support
import tiny_dataset
from cli_support import CliTestCase, run

REPEATABLE_FILES = ("trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ply")
TRUTH = ("instances", "instances.txt", "detections.json", "objects.json", "changes.json",
         "groundtruth.txt", "render.json", "README.txt", "contact_sheet.png")
FEATURES = ("--set", "tracking.orb.num_features=700")
PERSON = 0


class RenderedTest(CliTestCase):
    """On two people who walk, rendered small in the look that needs no packages."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="cslam_cli_")
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.sequence = pathlib.Path(cls.temporary.name) / "walkers"
        result = run("dataset", "render", "walking_xyz", "--short", "--look", "procedural",
                     "--size", "320x240", "--fps", "15", "--frames", "16", "--out", cls.sequence)
        assert result.returncode == 0, result.stderr

    def setUp(self):
        self.folder = self.make_folder()

    def track(self, sequence, *arguments, name="out"):
        return run("run", sequence, "--out", self.folder / name, "--deterministic", *FEATURES,
                   *arguments)

    def results(self, name="out"):
        return {file: (self.folder / name / file).read_bytes() for file in REPEATABLE_FILES}

    def poses(self):
        lines = (self.folder / "out" / "trajectory.txt").read_text(encoding="utf-8").splitlines()
        return [line for line in lines if not line.startswith("#")]

    def spoil(self, change):
        """A copy of detections.json in which change(frames) was at work."""
        truth = json.loads((self.sequence / "detections.json").read_text(encoding="utf-8"))
        change(truth["frames"])
        path = self.folder / "spoilt.json"
        path.write_text(json.dumps(truth), encoding="utf-8")
        return path

    def test_truth_in_the_folder_is_never_read_unless_named(self):
        detections = shutil.copy(self.sequence / "detections.json", self.folder)
        bare = self.folder / "bare"
        shutil.copytree(self.sequence, bare)
        for name in TRUTH:
            path = bare / name
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        for name, detector in (("none", ("--detector", "none")),
                               ("recorded", ("--detections", detections))):
            with self.subTest(detector=name):
                outcomes = []
                for sequence in (self.sequence, bare):
                    out = f"{name}_{sequence.name}"
                    result = self.track(sequence, *detector, name=out)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    outcomes.append(self.results(out))
                self.assertEqual(outcomes[0], outcomes[1])

    def test_live_inline_gives_the_same_bytes_and_not_those_of_every_frame(self):
        outcomes = []
        for name, schedule in (("a", "live"), ("b", "live"), ("c", "every-frame")):
            result = self.track(self.sequence, "--schedule", schedule, "--detections",
                                self.sequence / "detections.json", name=name)
            self.assertEqual(result.returncode, 0, result.stderr)
            outcomes.append(self.results(name))
        self.assertEqual(outcomes[0], outcomes[1])
        self.assertNotEqual(outcomes[0], outcomes[2])

    def test_no_detection_in_the_whole_run_is_no_error(self):
        empty = self.spoil(lambda frames: [frame.update(detections=[]) for frame in frames])
        result = self.track(self.sequence, "--detections", empty)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(self.poses()), 16)

    def test_boxes_outside_the_picture_do_no_harm(self):
        def change(frames):
            for frame in frames:
                for box in ([-900, -900, -10, -10], [400, 10, 900, 90], [-50, -50, 2000, 2000]):
                    frame["detections"].append({"instance": 0, "class_id": PERSON, "score": 0.9,
                                                "box_px": box, "visible_px": 0})
        result = self.track(self.sequence, "--detections", self.spoil(change))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreaterEqual(len(self.poses()), 1)

    def test_values_that_are_no_numbers_are_named_with_their_place(self):
        for key, value in (("score", float("nan")), ("score", float("inf")), ("score", -1.0),
                           ("box_px", [float("nan"), 0, 10, 10]), ("box_px", [10, 10, 0, 0])):
            with self.subTest(key=key, value=value):
                spoilt = self.spoil(lambda frames: frames[3]["detections"][0].update({key: value}))
                result = self.track(self.sequence, "--detections", spoilt)
                self.assert_last_line_is_error(result, 1, "spoilt.json")

    def test_detections_of_another_sequence_are_refused(self):
        def shift(frames):
            for frame in frames:
                frame["stamp"] = f"{float(frame['stamp']) + 1000:.6f}"
        result = self.track(self.sequence, "--detections", self.spoil(shift))
        self.assert_last_line_is_error(result, 1, "spoilt.json", "of this sequence")

    def test_detections_for_pictures_of_another_size_are_refused(self):
        other = json.loads((self.sequence / "detections.json").read_text(encoding="utf-8"))
        other["width_px"] = 640
        path = self.folder / "other.json"
        path.write_text(json.dumps(other), encoding="utf-8")
        self.assert_last_line_is_error(self.track(self.sequence, "--detections", path), 1,
                                       "other.json", "640")

    def test_broken_model_file_is_named_in_one_line(self):
        (self.folder / "broken.yaml").write_text(
            "decoder: nanodet-plus\nwidth: 416\nheight: 320\n", encoding="utf-8")
        (self.folder / "broken.onnx").write_bytes(b"no network")
        for name in ("broken.yaml", "missing.yaml"):
            with self.subTest(name=name):
                result = self.track(self.sequence, "--model", self.folder / name)
                self.assert_last_line_is_error(result, 1, name.split(".")[0])
                self.assertFalse((self.folder / "out" / "run.json").exists())


class CrowdedPictureTest(CliTestCase):
    """A board that the camera moves along, before which somebody comes to fill the picture."""

    NUM_FRAMES = 30  # a third of a second after the person has gone
    PERSON_M = 0.8
    FIRST = 10  # frame with the person
    # What is left of the room at the picture's left side, frame by frame; 16 px are 5 %.
    LEFT_PX = (260, 200, 140, 80, 16, 16, 16, 16, 16, 16)
    STEP_PX = 4  # that the person's clothes move a frame, against the room's one

    def setUp(self):
        self.folder = self.make_folder()
        self.sequence = tiny_dataset.write(self.folder / "crowded", self.NUM_FRAMES,
                                           self.NUM_FRAMES)
        clothes = self.make_clothes()
        board = tiny_dataset.board(self.NUM_FRAMES)
        units = [struct.pack(">H", int(metres * tiny_dataset.DEPTH_UNITS_PER_M))
                 for metres in (tiny_dataset.DEPTH_M, self.PERSON_M)]
        for step, left in enumerate(self.LEFT_PX):
            name = f"{self.FIRST + step:04}.png"
            room = tiny_dataset.view(board, self.FIRST + step, self.NUM_FRAMES)
            shift = step * self.STEP_PX
            rows = [bytes(v for value in there[:left] + line[shift + left:shift + len(there)]
                          for v in (value, value, value)) for there, line in zip(room, clothes)]
            (self.sequence / "rgb" / name).write_bytes(tiny_dataset.png(rows, 8, 3))
            row = units[0] * left + units[1] * (tiny_dataset.WIDTH - left)
            (self.sequence / "depth" / name).write_bytes(
                tiny_dataset.png([row] * tiny_dataset.HEIGHT, 16))

    def make_clothes(self):
        generator = random.Random(7)
        width = tiny_dataset.WIDTH + self.STEP_PX * len(self.LEFT_PX)
        lines = [bytearray([90]) * width for _ in range(tiny_dataset.HEIGHT)]
        for _ in range(1500):
            size = generator.choice([4, 6, 9, 14])
            left, top = generator.randrange(width - size), generator.randrange(tiny_dataset.HEIGHT)
            value = bytes([generator.randrange(256)]) * size
            for line in lines[top:top + size]:
                line[left:left + size] = value
        return lines

    def write_detections(self):
        frames = [{"stamp": tiny_dataset.stamp(i), "detections": []}
                  for i in range(self.NUM_FRAMES)]
        for step, left in enumerate(self.LEFT_PX):
            frames[self.FIRST + step]["detections"].append(
                {"instance": 0, "class_id": PERSON, "score": 0.9, "visible_px": 0,
                 "box_px": [left, 0, tiny_dataset.WIDTH, tiny_dataset.HEIGHT]})
        path = self.folder / "people.json"
        path.write_text(json.dumps({
            "format": "detections", "version": 1, "sequence": "crowded",
            "width_px": tiny_dataset.WIDTH, "height_px": tiny_dataset.HEIGHT, "frames": frames}),
            encoding="utf-8")
        return path

    def worst_error_m(self):
        """Of all poses given; the camera starts at the origin of truth and map alike."""
        truth = {}
        for line in (self.sequence / "groundtruth.txt").read_text(encoding="utf-8").splitlines():
            if not line.startswith("#"):
                stamp, *values = map(float, line.split())
                truth[round(stamp, 4)] = values[:3]
        worst = 0.0
        lines = (self.folder / "out" / "trajectory.txt").read_text(encoding="utf-8").splitlines()
        for line in lines:
            if line.startswith("#"):
                continue
            stamp, *values = map(float, line.split())
            there = truth[round(stamp, 4)]
            worst = max(worst, *(abs(a - b) for a, b in zip(values[:3], there)))
        return worst

    def test_nobody_is_followed_who_fills_the_picture_and_the_room_is_found_again(self):
        result = run("run", self.sequence, "--out", self.folder / "out", "--deterministic",
                     "--detections", self.write_detections())
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.folder / "out" / "frames.csv", encoding="utf-8", newline="") as file:
            frames = list(csv.DictReader(file))
        states = [frame["state"] for frame in frames]
        self.assertEqual(len(states), self.NUM_FRAMES)
        self.assertEqual(set(states[1:self.FIRST]), {"tracking"})
        self.assertEqual(states[-1], "tracking", states)
        self.assertEqual({frame["map"] for frame in frames if frame["state"] == "tracking"},
                         {frames[1]["map"]}, "another map was begun")
        self.assertLess(self.worst_error_m(), 0.03, "0.10 m if the person is followed")


if __name__ == "__main__":
    cli_support.main()
