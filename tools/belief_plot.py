#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Draws how the beliefs in the objects of a run went, as SVG: docs/objects.md explains them.

    tools/belief_plot.py RUN --out beliefs.svg [--truth SEQUENCE] [--ids 0,3]

One strip for each object of objects.json, over the time since the sequence began: the belief, what
changed it, the thresholds of the run's config.yaml, and what changes.json says of the object. With
--truth, dashed lines say when a thing of its class was truly changed (at times the camera did not
look). Updates in a row that change nothing are one entry of the file, with the last one's time.
"""

import argparse
import html
import json
import pathlib
import re
import sys

WIDTH, LEFT, RIGHT, TOP = 860, 132, 20, 46
STRIP, GAP, BOTTOM = 46, 14, 44
CAUSES = {"created": "#8a8f98", "seen": "#1a7f37", "merged": "#0969da", "missed": "#bf8700",
          "looked_through": "#cf222e", "displaced": "#8250df"}
THRESHOLDS = {"activate_at": 0.94, "absent_at": 0.3}
STATES = {"candidate": "#bf8700", "present": "#1a7f37", "absent": "#8a8f98"}


def class_names():
    """COCO's, from the program's own list."""
    source = pathlib.Path(__file__).resolve().parents[1] / "src/cslam/semantics/coco.cpp"
    found = re.search(r"kNames\{(.*?)\}", source.read_text(encoding="utf-8"), re.S)
    return re.findall(r'"([^"]+)"', found[1])


def read(file):
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as problem:
        sys.exit(f"{file}: {problem}")


def first_stamp(file):
    for line in file.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            return float(line.split()[0])
    sys.exit(f"{file}: no line")


def thresholds(run):
    config = run / "config.yaml"
    text = config.read_text(encoding="utf-8") if config.is_file() else ""
    values = dict(re.findall(r"^\s*(\w+): ([\d.]+)(?:\s+#.*)?$", text, re.M))
    return {name: float(values.get(name, value)) for name, value in THRESHOLDS.items()}


class Drawing:
    def __init__(self, seconds, height):
        self.seconds = seconds
        self.height = height
        self.parts = []

    def x(self, seconds):
        return LEFT + (WIDTH - LEFT - RIGHT) * seconds / self.seconds

    def line(self, x1, y1, x2, y2, style):
        self.parts.append(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" {style}/>')

    def text(self, x, y, words, style=""):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" {style}>{html.escape(words)}</text>')

    def dot(self, x, y, colour):
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.6" fill="{colour}"/>')

    def path(self, points, colour):
        joined = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.parts.append(f'<polyline points="{joined}" fill="none" stroke="{colour}" '
                          'stroke-width="1.6"/>')

    def svg(self):
        body = "\n".join(self.parts)
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.height}" '
                f'width="{WIDTH}" height="{self.height}" font-family="sans-serif" font-size="11" '
                f'fill="#24292f">\n<rect width="100%" height="100%" fill="#ffffff"/>\n{body}\n</svg>\n')


def draw_frame(drawing, top, limits):
    right = WIDTH - RIGHT
    drawing.parts.append(f'<rect x="{LEFT}" y="{top}" width="{right - LEFT}" height="{STRIP}" '
                         'fill="#f6f8fa" stroke="#d0d7de"/>')
    for value in limits.values():
        y = top + STRIP * (1.0 - value)
        drawing.line(LEFT, y, right, y, 'stroke="#afb8c1" stroke-dasharray="2 3"')
    drawing.text(LEFT - 4, top + 7, "1", 'text-anchor="end" fill="#57606a" font-size="9"')
    drawing.text(LEFT - 4, top + STRIP, "0", 'text-anchor="end" fill="#57606a" font-size="9"')


def draw_belief(drawing, top, steps):
    points = []
    for seconds, belief, _ in steps:
        x, y = drawing.x(seconds), top + STRIP * (1.0 - belief)
        if points:
            points.append((x, points[-1][1]))
        points.append((x, y))
    points.append((drawing.x(drawing.seconds), points[-1][1]))
    drawing.path(points, "#24292f")
    for seconds, belief, cause in steps:
        drawing.dot(drawing.x(seconds), top + STRIP * (1.0 - belief), CAUSES.get(cause, "#000000"))


def draw_changes(drawing, top, changes):
    for seconds, words in changes:
        x = drawing.x(seconds)
        drawing.line(x, top, x, top + STRIP, 'stroke="#cf222e" stroke-width="0.8"')
        if x > WIDTH - 120:
            drawing.text(x - 4, top + STRIP - 5, words, 'fill="#cf222e" text-anchor="end"')
        else:
            drawing.text(x + 4, top + 13, words, 'fill="#cf222e"')


def draw_legend(drawing, used):
    x = LEFT
    for cause, colour in CAUSES.items():
        if cause not in used:
            continue
        drawing.dot(x + 3, TOP - 17, colour)
        words = cause.replace("_", " ")
        drawing.text(x + 10, TOP - 13, words)
        x += 28 + 6 * len(words)


def draw_axis(drawing):
    y = drawing.height - BOTTOM + GAP
    step = next(s for s in (1, 2, 5, 10, 20, 60, 120, 600, 3600) if drawing.seconds / s <= 14)
    for i in range(int(drawing.seconds / step) + 1):
        drawing.text(drawing.x(i * step), y, str(i * step), 'text-anchor="middle" fill="#57606a"')
    drawing.text((LEFT + WIDTH - RIGHT) / 2, y + 16, "seconds since the sequence began",
                 'text-anchor="middle" fill="#57606a"')


class Run:
    def __init__(self, folder, truth):
        self.report = read(folder / "objects.json")
        self.told = read(folder / "changes.json")["changes"]
        self.true = read(truth / "changes.json")["changes"] if truth else []
        self.start = first_stamp(truth / "rgb.txt" if truth else folder / "trajectory.txt")
        self.limits = thresholds(folder)
        self.names = class_names()
        last = (folder / "trajectory.txt").read_text(encoding="utf-8").split("\n")[-2]
        self.seconds = max(1e-3, float(last.split()[0]) - self.start)

    def name(self, class_id):
        return self.names[class_id] if 0 <= class_id < len(self.names) else f"class {class_id}"

    def words(self, change, object_id):
        if change["kind"] == "replaced" and change["new_object"] == object_id:
            return f"replaces {self.name(change['class_id'])}"
        if change["kind"] == "replaced":
            return f"replaced by {self.name(change['new_class_id'])}"
        return change["kind"]

    def told_of(self, object_id):
        return [(float(c["reported"]) - self.start, self.words(c, object_id)) for c in self.told
                if object_id in (c["object"], c["new_object"])]

    def true_times(self, class_id):
        return sorted({c["time_s"] for c in self.true
                       if class_id in (c["class_id"], c.get("new_class_id", -1))})


def draw(run, title, ids):
    objects = [o for o in run.report["objects"] if o["history"] and (not ids or o["id"] in ids)]
    if not objects:
        sys.exit("no such object in objects.json")
    drawing = Drawing(run.seconds, TOP + len(objects) * (STRIP + GAP) - GAP + BOTTOM)
    drawing.text(LEFT, 16, title, 'font-size="13" font-weight="bold"')
    used = set()
    for i, one in enumerate(objects):
        top = TOP + i * (STRIP + GAP)
        steps = [(float(h["stamp"]) - run.start, h["belief"], h["cause"]) for h in one["history"]]
        used |= {cause for _, _, cause in steps}
        draw_frame(drawing, top, run.limits)
        for seconds in run.true_times(one["class_id"]):
            drawing.line(drawing.x(seconds), top, drawing.x(seconds), top + STRIP,
                         'stroke="#0969da" stroke-dasharray="4 3"')
        draw_belief(drawing, top, steps)
        draw_changes(drawing, top, run.told_of(one["id"]))
        drawing.text(10, top + 20, f"{one['id']} {run.name(one['class_id'])}", 'font-size="12"')
        drawing.text(10, top + 36, one["state"], f'fill="{STATES.get(one["state"], "#24292f")}"')
    draw_legend(drawing, used)
    draw_axis(drawing)
    return drawing.svg()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=pathlib.Path, help="folder of changing-slam run")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="SVG to write")
    parser.add_argument("--truth", type=pathlib.Path, help="folder of the rendered sequence")
    parser.add_argument("--ids", default="", help="of the objects to draw; all by default")
    arguments = parser.parse_args()
    run = Run(arguments.run, arguments.truth)
    ids = {int(i) for i in arguments.ids.split(",") if i}
    title = f"{run.report['sequence']}: belief in each object of the map"
    arguments.out.write_text(draw(run, title, ids), encoding="utf-8")


if __name__ == "__main__":
    main()
