# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Writes a small sequence in TUM layout with nothing but the standard library: a camera that
looks at a board of random squares, 1.5 m away, and moves right, then down, by one pixel a frame.

Usage: tiny_dataset.py FOLDER
"""

import pathlib
import random
import struct
import sys
import zlib

WIDTH, HEIGHT = 320, 240
FOCAL_PX = 260.0
DEPTH_M = 1.5
DEPTH_UNITS_PER_M = 5000
RATE_HZ = 30


def _chunk(name, data):
    return (struct.pack(">I", len(data)) + name + data
            + struct.pack(">I", zlib.crc32(name + data)))


def png(rows, bits, channels=1):
    """rows: byte strings, one a line, big-endian samples."""
    color_type = {1: 0, 3: 2}[channels]
    header = struct.pack(">IIBBBBB", len(rows[0]) * 8 // (bits * channels), len(rows), bits,
                         color_type, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + row for row in rows), 1)
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + _chunk(b"IDAT", pixels)
            + _chunk(b"IEND", b""))


def _board(width, height, seed=1):
    """Gray lines of a picture that is full of corners at several scales."""
    generator = random.Random(seed)
    lines = [bytearray([128]) * width for _ in range(height)]
    for _ in range(1500):
        size = generator.choice([4, 6, 9, 14, 22])
        left, top = generator.randrange(width), generator.randrange(height)
        value = generator.randrange(256)
        for y in range(top, min(top + size, height)):
            right = min(left + size, width)
            lines[y][left:right] = bytes([value]) * (right - left)
    return lines


def board(num_images):
    """All that write() ever shows with so many images, as gray lines."""
    return _board(WIDTH + num_images, HEIGHT + num_images)


def view(lines, index, num_images):
    """What image index of num_images shows of the board."""
    right, down = _offset_px(index, num_images)
    return [line[right:right + WIDTH] for line in lines[down:down + HEIGHT]]


def stamp(index):
    return f"{1000 + index / RATE_HZ:.6f}"


def _offset_px(index, num_images):
    """How far the camera has gone: right for the first half, then down."""
    right = min(index, num_images // 2)
    return right, index - right


def write(folder, num_frames=20, num_images=20, camera_file=True):
    """Writes the sequence and returns its folder. With more frames than images, the camera goes
    to and fro."""
    folder = pathlib.Path(folder)
    (folder / "rgb").mkdir(parents=True)
    (folder / "depth").mkdir()
    lines = board(num_images)
    for index in range(num_images):
        rows = [bytes(v for value in line for v in (value, value, value))
                for line in view(lines, index, num_images)]
        (folder / "rgb" / f"{index:04}.png").write_bytes(png(rows, 8, 3))
        (folder / "depth" / f"{index:04}.png").write_bytes(flat_depth(DEPTH_M))
    lists = {"rgb": "# stamp file\n", "depth": "# stamp file\n"}
    truth = "# timestamp tx ty tz qx qy qz qw\n"
    for frame in range(num_frames):
        phase = frame % max(2 * num_images - 2, 1)
        index = min(phase, 2 * num_images - 2 - phase)
        right, down = _offset_px(index, num_images)
        for kind in lists:
            lists[kind] += f"{stamp(frame)} {kind}/{index:04}.png\n"
        metres = DEPTH_M / FOCAL_PX
        truth += f"{stamp(frame)} {right * metres:.6f} {down * metres:.6f} 0 0 0 0 1\n"
    for kind, text in lists.items():
        (folder / f"{kind}.txt").write_text(text, encoding="utf-8")
    (folder / "groundtruth.txt").write_text(truth, encoding="utf-8")
    if camera_file:
        write_camera(folder / "camera.yaml")
    return folder


def flat_depth(depth_m):
    """A depth image that is depth_m everywhere."""
    row = struct.pack(">H", int(depth_m * DEPTH_UNITS_PER_M)) * WIDTH
    return png([row] * HEIGHT, 16)


def write_camera(path, fx=FOCAL_PX):
    path.write_text(
        f"width: {WIDTH}\nheight: {HEIGHT}\nfx: {fx}\nfy: {FOCAL_PX}\n"
        f"cx: {WIDTH / 2 - 0.5}\ncy: {HEIGHT / 2 - 0.5}\ndepth_scale: {DEPTH_UNITS_PER_M}\n",
        encoding="utf-8")


if __name__ == "__main__":
    write(sys.argv[1])
