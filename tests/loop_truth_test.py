# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""tools/loop_truth.py on run folders made by hand."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[1] / "tools" / "loop_truth.py"
MISSED_BAR = 3
NUM_FRAMES = 30


def identity_at(x):
    return {"tx_m": x, "ty_m": 0.0, "tz_m": 0.0, "qx": 0.0, "qy": 0.0, "qz": 0.0, "qw": 1.0}


class LoopTruthTest(unittest.TestCase):
    """A camera that goes 0.1 m along x a frame."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="cslam_loops_")
        self.addCleanup(folder.cleanup)
        self.run_folder = pathlib.Path(folder.name) / "run"
        self.run_folder.mkdir()
        self.sequence = pathlib.Path(folder.name)

    def judge(self, rate_hz, loop_x):
        """Of a loop closed between the first and the last frame."""
        stamps = [f"{1.0 + i / rate_hz:.6f}" for i in range(NUM_FRAMES)]
        poses = "".join(f"{t} {0.1 * i} 0 0 0 0 0 1\n" for i, t in enumerate(stamps))
        (self.sequence / "groundtruth.txt").write_text(poses)
        (self.run_folder / "trajectory.txt").write_text(poses)
        (self.run_folder / "frames.csv").write_text("timestamp_s,state,reason\n")
        (self.run_folder / "run.json").write_text(json.dumps({
            "sequence": str(self.sequence),
            "frames": {"tracked_percent": 100.0, "in_trajectory": NUM_FRAMES,
                       "processed": NUM_FRAMES}}))
        loop = {"query_stamp": stamps[-1], "match_stamp": stamps[0], "verdict": "closed",
                "T_match_query": identity_at(loop_x)}
        (self.run_folder / "loops.json").write_text(json.dumps({"candidates": [loop]}))
        return subprocess.run([sys.executable, "-B", TOOL, self.run_folder, "--json"],
                              capture_output=True, encoding="utf-8", timeout=60, check=False)

    def test_a_false_loop_is_found_however_far_apart_the_true_poses_are(self):
        for rate_hz in (30.0, 15.0, 5.0):
            result = self.judge(rate_hz, loop_x=0.1 * (NUM_FRAMES - 1) + 0.92)
            self.assertEqual(result.returncode, MISSED_BAR, result.stderr)
            self.assertEqual(json.loads(result.stdout)[0]["loops"], {"closed false": 1})

    def test_a_true_loop_is_none_of_the_false_ones(self):
        result = self.judge(15.0, loop_x=0.1 * (NUM_FRAMES - 1) + 0.05)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(result.stdout)[0]["loops"], {"closed true": 1})


if __name__ == "__main__":
    unittest.main()
