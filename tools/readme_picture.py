#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the picture of the README: frames of a sequence beside the map and the camera's path that
a run made of them, seen from above. Needs ground truth (it tells where "above" is) and
rsvg-convert (Debian: librsvg2-bin).

Usage: readme_picture.py SEQUENCE RUN OUT.png      after ./demo.sh:
       tools/readme_picture.py data/demo runs/demo docs/images/demo.png
"""

import base64
import pathlib
import struct
import subprocess
import sys

FRAME_WIDTH, FRAME_HEIGHT, GAP = 208, 156, 6
HEIGHT = 3 * FRAME_HEIGHT + 2 * GAP
MARGIN = 14
FRAME_SHARES = (0.06, 0.46, 0.70)  # of the sequence
POINT = struct.Struct("<fffBBB")
FRUSTUM_M = 0.11


def rotate(quaternion, v):
    x, y, z, w = quaternion
    tx, ty, tz = (2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0]))
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz,
            v[2] + w * tz + x * ty - y * tx)


def transform(pose, v):
    position, quaternion = pose
    return tuple(a + b for a, b in zip(position, rotate(quaternion, v)))


def read_poses(path):
    """(position, quaternion) per line of a trajectory in TUM format."""
    rows = [list(map(float, line.split())) for line in path.read_text(encoding="utf-8").splitlines()
            if line and not line.startswith("#")]
    return [(tuple(row[1:4]), tuple(row[4:8])) for row in rows]


def read_points(path):
    """(position, colour) per vertex of a map.ply as 'run' writes it."""
    header, _, body = path.read_bytes().partition(b"end_header\n")
    count = next(int(line.split()[2]) for line in header.split(b"\n")
                 if line.startswith(b"element vertex"))
    rows = (POINT.unpack_from(body, i * POINT.size) for i in range(count))
    return [(row[:3], row[3:]) for row in rows]


def frames_svg(sequence):
    images = sorted((sequence / "rgb").iterdir())
    parts = []
    for i, share in enumerate(FRAME_SHARES):
        data = base64.b64encode(images[int(share * len(images))].read_bytes()).decode()
        parts.append(f'<image y="{i * (FRAME_HEIGHT + GAP)}" width="{FRAME_WIDTH}" '
                     f'height="{FRAME_HEIGHT}" href="data:image/png;base64,{data}"/>')
    return "\n".join(parts)


def limits(values):
    """The range of values without the outermost hundredths."""
    values = sorted(values)
    cut = len(values) // 100
    return values[cut], values[-1 - cut]


def map_svg(sequence, run):
    """The map from above, HEIGHT pixels high, and its width."""
    start = read_poses(sequence / "groundtruth.txt")[0]  # the world of the estimate, in the room
    points = [(transform(start, p), rgb) for p, rgb in read_points(run / "map.ply")]
    low_x, high_x = limits(p[0] for p, _ in points)
    low_y, high_y = limits(p[1] for p, _ in points)
    scale = (HEIGHT - 2 * MARGIN) / (high_y - low_y)
    width = round(scale * (high_x - low_x) + 2 * MARGIN)

    def pixel(p):
        return f"{MARGIN + scale * (p[0] - low_x):.1f},{HEIGHT - MARGIN - scale * (p[1] - low_y):.1f}"

    parts = [f'<rect width="{width}" height="{HEIGHT}" fill="#15181d"/>']
    for p, (r, g, b) in sorted(points, key=lambda point: point[0][2]):  # high ones cover low ones
        x, y = pixel(p).split(",")
        parts.append(f'<circle cx="{x}" cy="{y}" r="1.3" fill="rgb({r},{g},{b})"/>')
    path = " ".join(pixel(transform(start, t)) for t, _ in read_poses(run / "trajectory.txt"))
    parts.append(f'<polyline points="{path}" fill="none" stroke="#ffb000" stroke-width="2"/>')
    for pose in read_poses(run / "keyframes.txt"):
        corners = [(0, 0, 0), (-0.6 * FRUSTUM_M, 0, FRUSTUM_M), (0.6 * FRUSTUM_M, 0, FRUSTUM_M)]
        outline = " ".join(pixel(transform(start, transform(pose, c))) for c in corners)
        parts.append(f'<polygon points="{outline}" fill="none" stroke="#4cc9f0" '
                     'stroke-width="1.2"/>')
    return "\n".join(parts), width


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    sequence, run, out = map(pathlib.Path, sys.argv[1:])
    drawing, map_width = map_svg(sequence, run)
    left = FRAME_WIDTH + GAP
    svg = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + map_width}" height="{HEIGHT}">\n'
           f'<rect width="100%" height="100%" fill="white"/>\n{frames_svg(sequence)}\n'
           f'<svg x="{left}" width="{map_width}" height="{HEIGHT}">\n{drawing}\n</svg>\n</svg>\n')
    subprocess.run(["rsvg-convert", "--unlimited", "--output", str(out)], input=svg.encode(),
                   check=True)


if __name__ == "__main__":
    main()
