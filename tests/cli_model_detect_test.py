#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Tests 'changing-slam model detect' with a network that takes what is bright for people."""

import json
import os
import subprocess

import tiny_dataset
from cli_support import CliTestCase, main, run

NUM_FRAMES = 8
RESULTS = ("trajectory.txt", "keyframes.txt", "map.ply", "objects.json")


class ModelDetectTest(CliTestCase):
    def setUp(self):
        self.folder = self.make_folder()
        self.sequence = self.folder / "board"
        tiny_dataset.write(self.sequence, NUM_FRAMES)
        subprocess.run([os.environ["CSLAM_MAKE_TEST_NETWORK"], self.folder / "bright.onnx"],
                       check=True)
        self.model = self.folder / "bright.yaml"
        self.file = self.folder / "found.json"

    def detect(self, *arguments):
        return run("model", "detect", self.sequence, "--model", self.model, "--out", self.file,
                   *arguments)

    def scores(self):
        frames = json.loads(self.file.read_text(encoding="utf-8"))["frames"]
        return [d["score"] for frame in frames for d in frame["detections"]]

    def test_a_run_on_what_was_written_down_equals_one_with_the_network(self):
        result = self.detect("--min-score", 0.1)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, rf"\d+ boxes in {NUM_FRAMES} of {NUM_FRAMES} frames")
        self.assertGreater(len(self.scores()), NUM_FRAMES)
        least = ("--set", "detector.person_threshold=0.3")
        for name, source in (("network", ("--model", self.model)),
                             ("recorded", ("--detections", self.file))):
            result = run("run", self.sequence, "--deterministic", "--out", self.folder / name,
                         *source, *least)
            self.assertEqual(result.returncode, 0, result.stderr)
        for file in RESULTS:
            self.assertEqual((self.folder / "network" / file).read_bytes(),
                             (self.folder / "recorded" / file).read_bytes(), file)

    def test_the_least_score_is_the_models_own_unless_given(self):
        self.assertEqual(self.detect().returncode, 0)
        own = self.scores()
        self.assertEqual(self.detect("--force", "--min-score", 0.05).returncode, 0)
        self.assertGreater(len(self.scores()), len(own))
        self.assertGreaterEqual(min(own), 0.4)
        self.assertGreaterEqual(min(self.scores()), 0.05)

    def test_keeps_an_existing_file(self):
        self.file.write_text("mine", encoding="utf-8")
        self.assert_one_line_error(self.detect(), 1, self.file, "--force")
        self.assertEqual(self.file.read_text(encoding="utf-8"), "mine")

    def test_names_what_is_not_there(self):
        self.assert_one_line_error(
            run("model", "detect", self.folder / "none", "--model", self.model, "--out", self.file),
            1, "none")
        self.assertFalse(self.file.exists())


if __name__ == "__main__":
    main()
