# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""The dataset command on a small sequence written here."""

import json
import re

import cli_support
import tiny_dataset
from cli_support import CliTestCase, run


class DatasetTest(CliTestCase):
    def setUp(self):
        self.folder = tiny_dataset.write(self.make_folder() / "tiny", num_frames=6, num_images=6)

    def test_info_describes_a_sound_sequence_on_stdout(self):
        result = run("dataset", "info", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        for part in ("6", "320x240", "camera.yaml", "groundtruth.txt"):
            self.assertIn(part, result.stdout)

    def test_check_passes_a_sound_sequence(self):
        self.assertEqual(run("dataset", "check", self.folder).returncode, 0)

    def test_check_fails_for_a_truncated_image_and_names_it(self):
        image = self.folder / "rgb" / "0003.png"
        image.write_bytes(image.read_bytes()[:500])
        result = run("dataset", "check", self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("0003.png", result.stdout + result.stderr)

    def test_check_tells_what_it_skipped_and_holds_depth_against_poses(self):
        result = run("dataset", "check", self.folder)
        self.assertIn("skipped  no instances/", result.stdout)
        self.assertIn("skipped  no objects.json: story not checked", result.stdout)
        self.assertRegex(result.stdout, r"depth against poses +median 0\.0\d mm")

    def test_check_prints_json(self):
        result = run("dataset", "check", self.folder, "--json")
        figures = json.loads(result.stdout)
        self.assertTrue(figures["ok"])
        self.assertLess(figures["reprojection"]["p95_m"], 0.001)
        self.assertIsNone(figures["story"])

    def test_check_fails_for_truth_that_contradicts_itself(self):
        rendered = self.make_folder() / "demo"
        render = run("dataset", "render", "demo", "--out", rendered, "--size", "160x120",
                     "--frames", "4", "--noise", "off")
        self.assertEqual(render.returncode, 0, render.stderr)
        self.assertEqual(run("dataset", "check", rendered).returncode, 0)
        text = (rendered / "detections.json").read_text(encoding="utf-8")
        spoilt = re.sub(r'"visible_px": \d+', '"visible_px": 1', text, count=1)
        self.assertNotEqual(text, spoilt)
        (rendered / "detections.json").write_text(spoilt, encoding="utf-8")
        result = run("dataset", "check", rendered)
        self.assertEqual(result.returncode, 1)
        self.assertIn("detections.json says 1", result.stdout)

    def test_missing_folder_is_named(self):
        missing = self.folder / "none"
        self.assert_one_line_error(run("dataset", "info", missing), 1, missing)

    def test_folder_without_a_dataset_says_what_was_looked_for(self):
        self.assert_one_line_error(run("dataset", "info", self.folder / "rgb"), 1, "rgb.txt")


if __name__ == "__main__":
    cli_support.main()
