#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Tests 'changing-slam map' on a map of 5 + 3 keyframes that make_test_map writes."""

import contextlib
import json
import os
import sqlite3
import struct
import subprocess
import zlib

from cli_support import CliTestCase, main, run


def checked_bytes(value):
    """What a checksum is made of."""
    if value is None:
        return b"n\0"
    if isinstance(value, int):
        return struct.pack("<cq", b"i", value)
    if isinstance(value, float):
        return struct.pack("<cd", b"d", value)
    data = value.encode() if isinstance(value, str) else value
    return struct.pack("<cQ", b"b", len(data)) + (b"." + data if data else b"")


class MapTest(CliTestCase):
    def setUp(self):
        self.folder = self.make_folder()
        self.map = self.folder / "a.map"
        subprocess.run([os.environ["CSLAM_MAKE_TEST_MAP"], self.map], check=True, timeout=60)

    def export(self, name, *arguments):
        out = self.folder / name
        result = run("map", "export", self.map, "--out", out, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, "")
        return out.read_bytes()

    def test_info_tells_maps_and_camera(self):
        result = run("map", "info", self.map)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("changing-slam test", result.stdout)
        self.assertIn("fx 517.3", result.stdout)
        rows = [line.split()[:2] for line in result.stdout.splitlines()]
        for row in (["0", "5"], ["3", "3"], ["morning", "8"], ["noon", "0"]):
            self.assertIn(row, rows)

    def test_info_as_json(self):
        info = json.loads(run("map", "info", self.map, "--json").stdout)
        self.assertEqual(info["format"], "map")
        self.assertEqual(info["created"], "2026-11-22T04:00:00Z")
        self.assertEqual(info["size_bytes"], self.map.stat().st_size)
        self.assertEqual([m["keyframes"] for m in info["maps"]], [5, 3])
        self.assertEqual([s["keyframes"] for s in info["sessions"]], [8, 0])
        self.assertEqual((info["loops"], info["objects"], info["changes"]), (1, 1, 1))

    def test_is_readable_as_formats_md_says(self):
        with contextlib.closing(sqlite3.connect(self.map)) as file:
            self.assertEqual(file.execute("PRAGMA integrity_check").fetchall(), [("ok",)])
            checksums = file.execute("SELECT name, num_rows, crc32 FROM checksums").fetchall()
            self.assertEqual([c[0] for c in checksums], ["info", "levels", "keyframes", "points", "objects", "changes",
                              "loops", "sessions"])
            for name, num_rows, crc in checksums:
                rows = file.execute(f"SELECT * FROM {name} ORDER BY id").fetchall()
                self.assertEqual(len(rows), num_rows)
                data = b"".join(checked_bytes(value) for row in rows for value in row)
                self.assertEqual(zlib.crc32(data), crc, name)

    def test_exports_clouds(self):
        points = json.loads(run("map", "info", self.map, "--json").stdout)["maps"][0]["points"]
        ply = self.export("a.ply")
        self.assertIn(f"element vertex {points}\n".encode(), ply)
        pcd = self.export("a.pcd", "--map-id", "0")
        self.assertIn(f"POINTS {points}\n".encode(), pcd)
        self.assertEqual(len(pcd.split(b"DATA binary\n")[1]), 16 * points)
        fine = self.export("fine.ply", "--dense", "--voxel", "0.02")
        coarse = self.export("coarse.ply", "--dense", "--voxel", "0.5")
        self.assertGreater(len(fine), 2 * len(coarse))

    def test_exports_keyframes(self):
        lines = self.export("a.txt").decode().splitlines()
        poses = [line for line in lines if not line.startswith("#")]
        self.assertEqual(len(poses), 5)
        self.assertTrue(all(len(pose.split()) == 8 for pose in poses))

    def test_exports_a_grid_for_navigation(self):
        result = run("map", "export", self.map, "--grid", self.folder / "a.yaml", "--map-id", "0",
                     "--set", "grid.resolution=0.2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("resolution: 0.2\n", (self.folder / "a.yaml").read_text(encoding="utf-8"))
        magic, size, top, pixels = (self.folder / "a.pgm").read_bytes().split(b"\n", 3)
        width, height = map(int, size.split())
        self.assertEqual((magic, top, len(pixels)), (b"P5", b"255", width * height))
        self.assertLessEqual(set(pixels), {0, 205, 254})
        export = ["map", "export", self.map]
        self.assert_one_line_error(run(*export, "--grid", self.folder / "a.pgm"), 2, ".yaml")
        self.assert_one_line_error(run(*export), 2, "--out", "--grid")

    def test_exports_json(self):
        data = json.loads(self.export("a.json"))
        self.assertEqual(len(data["keyframes"]), 8)
        self.assertEqual(len(data["keyframes"][0]["pose"]), 7)
        self.assertEqual(len(data["points"][0]["position_m"]), 3)

    def test_names_what_is_wrong_with_the_command(self):
        export = ["map", "export", self.map, "--out"]
        self.assert_one_line_error(run(*export, self.folder / "a.obj"), 2, ".ply, .pcd")
        self.assert_one_line_error(run(*export, self.folder / "a.txt", "--dense"), 2, "--dense")
        self.assert_one_line_error(run(*export, self.folder / "a.ply", "--map-id", 1), 2, "0, 3")
        self.assert_one_line_error(run(*export, self.folder / "none" / "a.ply", "--map-id", 0), 1,
                                   "none")

    def test_names_what_is_wrong_with_the_file(self):
        self.assert_one_line_error(run("map", "info", self.folder / "x.map"), 1, "x.map")
        whole = self.map.read_bytes()
        self.map.write_bytes(whole[:-1])
        self.assert_one_line_error(run("map", "info", self.map), 1, "a.map", "damaged")
        self.map.write_bytes(b"something else")
        self.assert_one_line_error(run("map", "info", self.map), 1, "a.map", "not a map")


if __name__ == "__main__":
    main()
