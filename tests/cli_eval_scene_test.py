# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""eval objects and eval changes on a sequence and runs written here: a chair before a wall is moved
from left to right while the camera looks straight on."""

import json
import math
import pathlib
import struct

import cli_support
from cli_support import CliTestCase, run
import tiny_dataset

WIDTH, HEIGHT = 64, 48
FOCAL_PX = 50.0
UNITS_PER_M = 1000
CHAIR, TV = 56, 62
SIZE_M = 0.4
LEFT, RIGHT, MIDDLE = [-0.8, 0.0, 3.0], [0.8, 0.0, 3.0], [0.0, 0.6, 3.0]
NUM_FRAMES, MOVED_AT = 30, 15


def stamp(frame, decimals=6):
    return f"{1 + frame / 10:.{decimals}f}"


def camera_at(frame):
    return 0.05 * math.sin(frame), 0.05 * math.cos(1.7 * frame), 0.01 * frame


def things_at(frame):
    return {1: RIGHT if frame >= MOVED_AT else LEFT, 2: MIDDLE}


def depth_and_pixels(frame):
    """Rows of depth, and how many pixels each thing fills: each seen as its front side."""
    x, y, z = camera_at(frame)
    rows, pixels = [], {1: 0, 2: 0}
    for v in range(HEIGHT):
        depths = []
        for u in range(WIDTH):
            depth = 5.0 - z
            for instance, place in things_at(frame).items():
                front = place[2] - SIZE_M / 2 - z
                seen = (x + (u - 31.5) / FOCAL_PX * front, y + (v - 23.5) / FOCAL_PX * front)
                if all(abs(s - p) < SIZE_M / 2 for s, p in zip(seen, place)):
                    depth = front
                    pixels[instance] += 1
            depths.append(int(depth * UNITS_PER_M))
        rows.append(struct.pack(f">{WIDTH}H", *depths))
    return rows, pixels


def write_json(path, format_name, **values):
    path.write_text(json.dumps({"format": format_name, "version": 1, "sequence": "demo"} | values),
                    encoding="utf-8")


def pose(place):
    return place + [0, 0, 0, 1]


def write_truth(folder):
    for name in ("rgb", "depth"):
        (folder / name).mkdir(parents=True)
    frames, pairs, truth = [], "", ""
    for frame in range(NUM_FRAMES):
        rows, pixels = depth_and_pixels(frame)
        name = f"{stamp(frame)}.png"
        (folder / "depth" / name).write_bytes(tiny_dataset.png(rows, 16))
        pairs += f"{stamp(frame)} rgb/{name} {stamp(frame)} depth/{name}\n"
        truth += stamp(frame) + " {:.6f} {:.6f} {:.6f} 0 0 0 1\n".format(*camera_at(frame))
        frames.append({"stamp": stamp(frame), "detections": [
            {"instance": i, "class_id": {1: CHAIR, 2: TV}[i], "score": 1,
             "box_px": [0, 0, 9, 9], "visible_px": count} for i, count in pixels.items() if count]})
    (folder / "associations.txt").write_text(pairs, encoding="utf-8")
    (folder / "groundtruth.txt").write_text(truth, encoding="utf-8")
    (folder / "camera.yaml").write_text(
        f"width: {WIDTH}\nheight: {HEIGHT}\nfx: {FOCAL_PX}\nfy: {FOCAL_PX}\ncx: 31.5\ncy: 23.5\n"
        f"depth_scale: {UNITS_PER_M}\n", encoding="utf-8")
    write_json(folder / "detections.json", "detections", width_px=WIDTH, height_px=HEIGHT,
               frames=frames)
    box = {"center_m": [0, 0, 0], "size_m": [SIZE_M] * 3}
    rest = lambda start, end, place: {"from_s": start, "to_s": end, "is_moving": False,
                                      "poses": [[start] + pose(place)]}
    write_json(folder / "objects.json", "objects", start=stamp(0), duration_s=3, objects=[
        {"instance": 1, "name": "chair", "class_id": CHAIR, "is_deformable": False, "box": box,
         "intervals": [rest(0, 1.5, LEFT), rest(1.5, 3, RIGHT)]},
        {"instance": 2, "name": "screen", "class_id": TV, "is_deformable": False, "box": box,
         "intervals": [rest(0, 3, MIDDLE)]}])
    write_json(folder / "changes.json", "changes", changes=[
        {"time_s": 1.5, "kind": "moved", "instance": 1, "class_id": CHAIR, "new_instance": 0,
         "new_class_id": -1, "is_carried_in_view": False, "from": pose(LEFT), "to": pose(RIGHT)}])
    return folder


def told_object(number, class_id, place):
    return {"id": number, "map": 0, "class_id": class_id, "state": "present", "belief": 0.9,
            "centroid_m": place,
            "box": {"center_m": place, "size_m": [SIZE_M] * 3, "rotation_xyzw": [0, 0, 0, 1]},
            "extent": {"min_m": [p - 0.2 for p in place], "max_m": [p + 0.2 for p in place]},
            "num_points": 10, "num_active_points": 9, "first_seen": stamp(0, 9),
            "last_seen": stamp(29, 9), "absent_since": None, "history": []}


def told_change(kind, start, end, frame=20):
    return {"kind": kind, "object": 1, "new_object": -1, "class_id": CHAIR, "new_class_id": -1,
            "from_m": start, "to_m": end, "last_seen_there": stamp(14, 9),
            "first_seen_absent": stamp(16, 9), "reported": stamp(frame, 9), "confidence": 0.9,
            "num_absent_views": 5, "num_seen_views": 5, "is_between_sessions": False}


def write_cloud(path, points):
    header = ("ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
              "property float x\nproperty float y\nproperty float z\nproperty uchar red\n"
              "property uchar green\nproperty uchar blue\nend_header\n").format(len(points))
    path.write_bytes(header.encode() + b"".join(struct.pack("<fffBBB", *p, 1, 2, 3)
                                                for p in points))


def write_run(folder, truth, objects, changes, points=()):
    folder.mkdir()
    (folder / "trajectory.txt").write_bytes((truth / "groundtruth.txt").read_bytes())
    write_json(folder / "objects.json", "map_objects", objects=objects)
    write_json(folder / "changes.json", "map_changes", changes=changes)
    write_cloud(folder / "map.ply", points)
    return folder


class EvalSceneTest(CliTestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.make_folder())
        self.truth = write_truth(self.folder / "truth")

    def run_folder(self, objects=(), changes=(), points=(), name="run"):
        return write_run(self.folder / name, self.truth, list(objects), list(changes), points)

    def values_of(self, kind, folder, *more):
        result = run("eval", kind, self.truth, folder, "--json", *more)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_a_perfect_run_has_full_marks(self):
        folder = self.run_folder([told_object(3, CHAIR, RIGHT), told_object(4, TV, MIDDLE)],
                                 [told_change("moved", LEFT, RIGHT)], [[0.0, 0.0, 5.0]])
        objects = self.values_of("objects", folder)
        self.assertEqual((objects["all"]["num_true"], objects["all"]["f1"]), (2, 1.0))
        self.assertEqual(objects["ghosts"]["num_ghosts"], 0)
        self.assertAlmostEqual(objects["per_class"]["tv"]["centroid_error_m"], 0.0, places=4)
        changes = self.values_of("changes", folder)
        self.assertEqual((changes["all"]["num_true"], changes["all"]["f1"]), (1, 1.0))
        self.assertAlmostEqual(changes["median_delay_s"], 0.5, places=2)

    def test_a_map_that_did_not_notice_has_ghosts_and_a_false_object(self):
        ghost = [LEFT[0], LEFT[1], LEFT[2] - SIZE_M / 2]
        folder = self.run_folder([told_object(3, CHAIR, LEFT), told_object(4, TV, MIDDLE)],
                                 points=[ghost, [0.0, 0.0, 5.0]])
        objects = self.values_of("objects", folder)
        self.assertEqual(objects["all"]["f1"], 0.5)
        self.assertEqual(objects["ghosts"]["share"], 0.5)
        table = run("eval", "objects", self.truth, folder)
        self.assertIn("missed: chair 'chair'", table.stdout)
        self.assertIn("false: chair 3", table.stdout)
        self.assertEqual(self.values_of("changes", folder)["all"]["recall"], 0.0)

    def test_a_move_told_in_pieces_is_a_partial_miss(self):
        folder = self.run_folder(changes=[told_change("removed", LEFT, None),
                                          told_change("added", None, RIGHT)])
        values = self.values_of("changes", folder)
        self.assertEqual((values["all"]["num_matched"], values["num_partial"]), (0, 1))
        self.assertIn("missed: partial", run("eval", "changes", self.truth, folder).stdout)

    def test_classes_and_distance_are_as_asked(self):
        shifted = [RIGHT[0], RIGHT[1] - 0.3, RIGHT[2]]
        folder = self.run_folder([told_object(3, CHAIR, shifted)])
        self.assertEqual(self.values_of("objects", folder, "--classes", "chair")["all"]["f1"], 1.0)
        near = self.values_of("objects", folder, "--classes", "chair,tv", "--distance", "0.2")
        self.assertEqual(near["all"]["num_matched"], 0)

    def test_the_bar_is_judged_by_exit_code_and_json_goes_to_a_file(self):
        folder = self.run_folder([told_object(3, CHAIR, RIGHT)])
        out = self.folder / "out.json"
        result = run("eval", "objects", self.truth, folder, "--fail-below", "0.9", "--json", out)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("recall", result.stdout)
        self.assertAlmostEqual(json.loads(out.read_text())["all"]["f1"], 2 / 3)

    def test_what_is_missing_or_broken_is_named_in_one_line(self):
        folder = self.run_folder()
        nowhere = self.folder / "nowhere"
        self.assert_one_line_error(run("eval", "objects", nowhere, folder), 1, nowhere)
        self.assert_one_line_error(run("eval", "objects", self.truth, nowhere), 1, nowhere)
        self.assert_one_line_error(run("eval", "objects", folder, folder), 1, folder,
                                   "dataset render")
        self.assert_one_line_error(
            run("eval", "objects", self.truth, folder, "--classes", "chiar"), 1, "'chiar'")
        self.assert_one_line_error(
            run("eval", "objects", self.truth, folder, "--distance", "-1"), 2, "'-1'")
        broken = told_object(3, CHAIR, RIGHT) | {"belief": 2}
        other = self.run_folder([broken], name="broken")
        self.assert_one_line_error(run("eval", "objects", self.truth, other), 1,
                                   "objects.json: $.objects[0].belief")
        (folder / "changes.json").unlink()
        self.assert_one_line_error(run("eval", "changes", self.truth, folder), 1, "changes.json")


if __name__ == "__main__":
    cli_support.main()
