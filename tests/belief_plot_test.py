# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""tools/belief_plot.py on a run folder of two objects."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

TOOL = pathlib.Path(__file__).resolve().parents[1] / "tools" / "belief_plot.py"
SVG = "{http://www.w3.org/2000/svg}"
LEFT, WIDTH_PX = 132.0, 708.0  # of the strips


def an_object(number, class_id, state, history):
    return {"id": number, "class_id": class_id, "state": state,
            "history": [{"stamp": t, "belief": b, "cause": c} for t, b, c in history]}


class BeliefPlotTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="cslam_beliefs_")
        self.addCleanup(folder.cleanup)
        self.run_folder = pathlib.Path(folder.name)
        chair = an_object(0, 56, "absent", [("10.0", 0.5, "created"), ("11.0", 0.9, "seen"),
                                            ("15.0", 0.1, "looked_through")])
        cup = an_object(3, 41, "present", [("12.0", 0.5, "created")])
        change = {"kind": "replaced", "object": 0, "new_object": 3, "class_id": 56,
                  "new_class_id": 41, "reported": "15.0"}
        self.write("objects.json", json.dumps({"sequence": "tiny", "objects": [chair, cup]}))
        self.write("changes.json", json.dumps({"changes": [change]}))
        self.write("trajectory.txt", "# poses\n10.0 0 0 0 0 0 0 1\n20.0 0 0 0 0 0 0 1\n")

    def write(self, name, text):
        (self.run_folder / name).write_text(text, encoding="utf-8")

    def draw(self, *arguments):
        out = self.run_folder / "beliefs.svg"
        result = subprocess.run([sys.executable, "-B", TOOL, self.run_folder, "--out", out,
                                 *arguments], stderr=subprocess.PIPE, encoding="utf-8", check=False)
        self.stderr = result.stderr
        return xml.etree.ElementTree.parse(out) if result.returncode == 0 else None

    def words(self, picture):
        return [text.text for text in picture.iter(SVG + "text")]

    def test_draws_each_belief_as_steps(self):
        lines = list(self.draw().iter(SVG + "polyline"))
        self.assertEqual(len(lines), 2)
        points = [tuple(map(float, p.split(","))) for p in lines[0].get("points").split()]
        self.assertAlmostEqual(points[0][0], LEFT, places=1)
        self.assertAlmostEqual(points[-1][0], LEFT + WIDTH_PX, places=1)
        self.assertAlmostEqual(points[3][0], LEFT + 0.5 * WIDTH_PX, places=1)
        self.assertEqual(points[2][1], points[3][1])  # until the next evidence it stays

    def test_names_objects_states_and_changes(self):
        words = self.words(self.draw())
        for expected in ("0 chair", "3 cup", "absent", "replaced by cup", "replaces chair"):
            self.assertIn(expected, words)

    def test_draws_only_the_ids_asked_for(self):
        words = self.words(self.draw("--ids", "3"))
        self.assertIn("3 cup", words)
        self.assertNotIn("0 chair", words)

    def test_marks_true_changes_of_the_class(self):
        (self.run_folder / "truth").mkdir()
        true = {"changes": [{"time_s": 2.5, "kind": "removed", "class_id": 56}]}
        self.write("truth/changes.json", json.dumps(true))
        self.write("truth/rgb.txt", "# color images\n10.0 rgb/10.png\n")
        lines = self.draw("--truth", str(self.run_folder / "truth")).iter(SVG + "line")
        marks = [line for line in lines if line.get("stroke-dasharray") == "4 3"]
        self.assertEqual(len(marks), 1)
        self.assertAlmostEqual(float(marks[0].get("x1")), LEFT + 0.25 * WIDTH_PX, places=1)

    def test_takes_thresholds_of_the_run(self):
        self.write("config.yaml", "    belief:\n      absent_at: 0.5  # Belief. (0.01 to 0.5)\n")
        lines = [line for line in self.draw("--ids", "0").iter(SVG + "line")
                 if line.get("stroke-dasharray") == "2 3"]
        activate_at = 0.94  # the default: the run does not say
        self.assertEqual([float(line.get("y1")) for line in lines],
                         [round(46 + 46 * (1 - activate_at), 1), 46 + 46 * 0.5])

    def test_says_what_is_missing(self):
        (self.run_folder / "objects.json").unlink()
        self.assertIsNone(self.draw())
        self.assertIn("objects.json", self.stderr)


if __name__ == "__main__":
    unittest.main()
