#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Measures the whole program: every figure of docs/results.md, as one Markdown table.

Runs `changing-slam run` on each sequence, threaded at sensor rate and at full speed several times
and once inline, and prints the medians. Times are of this machine: let nothing else run.

`changing-slam benchmark` is for other questions: it compares the object layer on and off, on sequences
that it renders, with truth about objects and changes (docs/benchmark.md).
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
MODES = {
    "sensor": ["--rate", "sensor"],
    "max": ["--rate", "max"],
    "inline": ["--deterministic"],
}
TRACKING_STEPS = ["extract", "measure", "predict", "local_map"]

# Sequence -> column -> the most it may be (tracked %: the least).
BARS = {
    "tum_fr1_desk": {"ate_mm": 18.0, "tracked": 100.0, "memory_mb": 250.0},
    "bonn_crowd_part": {"ate_mm": 17.0, "tracked": 100.0, "rpe_max_mm": 30.0},
    "room": {"ate_mm": 10.0, "tracked": 100.0},
    "room_exact": {"ate_mm": 3.0, "tracked": 100.0},
}
COMMON_BARS = {"cpu_ms": 8.0, "first_pose_ms": 300.0}
COLUMNS = {
    "ate_mm": "ATE mm",
    "live_mm": "live ATE mm",
    "rpe_max_mm": "RPE max mm",
    "tracked": "tracked %",
    "dropped": "dropped",
    "cpu_ms": "tracking CPU ms",
    **{step: step for step in TRACKING_STEPS},
    "mapping_ms": "mapping CPU ms",
    "process_ms": "process CPU ms/frame",
    "first_pose_ms": "first pose ms",
    "memory_mb": "memory MB",
    "keyframes": "keyframes",
}


def median_cpu_ms(report, stage):
    entry = report["stages"].get(stage)
    return entry["cpu"]["median_ms"] if entry else None


def figures_of(report):
    """The columns' values of one run.json; None where it does not say."""
    accuracy = report["accuracy"] or {}
    final = accuracy.get("trajectory", {})
    live = accuracy.get("trajectory_live", {})

    def millimetres(trajectory, error, figure):
        return 1e3 * trajectory[error][figure] if error in trajectory else None

    figures = {
        "ate_mm": millimetres(final, "ate_m", "rmse"),
        "live_mm": millimetres(live, "ate_m", "rmse"),
        "rpe_max_mm": millimetres(final, "rpe_m", "max"),
        "tracked": report["frames"]["tracked_percent"],
        "dropped": report["frames"]["dropped"],
        "cpu_ms": median_cpu_ms(report, "tracking"),
        "mapping_ms": median_cpu_ms(report, "mapping"),
        "process_ms": report["cost"]["cpu_ms_per_frame"],
        "first_pose_ms": report["cost"]["first_pose_ms"],
        "memory_mb": report["cost"]["peak_memory_bytes"] / 1e6,
        "keyframes": report["map"]["keyframes"],
    }
    for step in TRACKING_STEPS:
        figures[step] = median_cpu_ms(report, f"tracking.{step}")
    return figures


def run_once(binary, sequence, arguments, folder):
    """run.json of one run."""
    command = [binary, "run", str(sequence["path"]), "--out", str(folder), *arguments]
    if sequence["frames"]:
        command += ["--frames", str(sequence["frames"])]
    result = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    if result.returncode != 0:
        sys.exit(f"benchmark: '{' '.join(command)}' ended with {result.returncode}:\n"
                 f"{result.stderr.strip()}")
    return json.loads((folder / "run.json").read_text(encoding="utf-8"))


def summarise(runs):
    """Median of each column, and the range of the ATE."""
    summary = {}
    for column in COLUMNS:
        values = [run[column] for run in runs if run[column] is not None]
        summary[column] = statistics.median(values) if values else None
    ates = [run["ate_mm"] for run in runs if run["ate_mm"] is not None]
    summary["ate_range"] = (min(ates), max(ates)) if ates else None
    summary["ate_all"] = ates
    return summary


def format_cell(column, summary):
    value = summary[column]
    if value is None:
        return "-"
    if column == "ate_mm" and len(summary["ate_all"]) > 1:
        low, high = summary["ate_range"]
        return f"{value:.1f} ({low:.1f} to {high:.1f})"
    if column in {"dropped", "keyframes", "first_pose_ms", "memory_mb"}:
        return f"{value:.0f}"
    return f"{value:.1f}" if column not in TRACKING_STEPS + ["cpu_ms"] else f"{value:.2f}"


def missed_bars(name, mode, summary):
    """One line for each bar the medians do not reach."""
    for column, bar in {**BARS.get(name, {}), **COMMON_BARS}.items():
        value = summary[column]
        if mode != "sensor" and column in {"cpu_ms", "first_pose_ms", "memory_mb"}:
            continue  # stated for a threaded run at sensor rate
        if value is None or (value < bar if column == "tracked" else value > bar):
            yield f"{name}, {mode}: {COLUMNS[column]} is {value}, the bar {bar:g}"


def parse_sequence(text):
    """NAME=PATH[:FRAMES] or PATH[:FRAMES]."""
    name, _, rest = text.rpartition("=")
    path, _, frames = rest.partition(":")
    path = pathlib.Path(path)
    return {"name": name or path.name, "path": path, "frames": int(frames) if frames else None}


def shared_sequences():
    """The recordings the bars speak of, as far as this machine has them."""
    data = pathlib.Path(os.environ.get("CSLAM_SHARED", ROOT.parent / "shared")) / "data"
    wanted = [parse_sequence(f"tum_fr1_desk={data / 'tum_fr1_desk'}"),
              parse_sequence(f"bonn_crowd_part={data / 'bonn_crowd_part'}:200")]
    return [sequence for sequence in wanted if (sequence["path"] / "rgb.txt").exists()]


def render_rooms(binary, cache):
    """The simulated room with and without sensor noise: 600 frames, 8 m, more than a full turn."""
    sequences = []
    for name, noise in (("room", "kinect"), ("room_exact", "off")):
        folder = cache / name
        if not (folder / "rgb.txt").exists():
            print(f"rendering {name} into {folder}", file=sys.stderr)
            subprocess.run([binary, "dataset", "render", "demo", "--noise", noise, "--force",
                            "--out", str(folder)], check=True, stdout=subprocess.DEVNULL)
        sequences.append({"name": name, "path": folder, "frames": None})
    return sequences


def measure(arguments, sequence):
    """Summaries by mode."""
    summaries = {}
    with tempfile.TemporaryDirectory(prefix="cslam-benchmark-") as scratch:
        for mode in arguments.modes or MODES:
            runs = []
            for i in range(1 if mode == "inline" else arguments.runs):
                folder = pathlib.Path(scratch) / f"{mode}{i}"
                print(f"{sequence['name']}: {mode}, run {i + 1}", file=sys.stderr)
                runs.append(figures_of(run_once(arguments.binary, sequence, MODES[mode], folder)))
            summaries[mode] = summarise(runs)
    return summaries


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="Examples:\n  tools/benchmark.py\n"
               "  tools/benchmark.py --runs 3 desk=~/data/fr1_desk office=~/data/office:500")
    parser.add_argument("sequences", nargs="*", type=parse_sequence, metavar="[NAME=]PATH[:FRAMES]",
                        help="folders in TUM layout (default: ../shared/data and rendered rooms)")
    parser.add_argument("--binary", default=str(ROOT / "build/release/changing-slam"))
    parser.add_argument("--runs", type=int, default=5, help="threaded runs of each (default 5)")
    parser.add_argument("--mode", action="append", choices=MODES, dest="modes",
                        help="only this one; can be repeated (default: all)")
    parser.add_argument("--cache", type=pathlib.Path, default=ROOT / "build/benchmark",
                        help="where rendered rooms are kept (default build/benchmark)")
    parser.add_argument("--fail-on-missed-bar", action="store_true", help="exit with code 3 then")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    if not pathlib.Path(arguments.binary).exists():
        sys.exit(f"benchmark: no program '{arguments.binary}'; build it or name it with --binary")
    sequences = arguments.sequences
    if not sequences:
        sequences = shared_sequences() + render_rooms(arguments.binary, arguments.cache)
    print("| sequence | mode | " + " | ".join(COLUMNS.values()) + " |")
    print("|---|---|" + "---|" * len(COLUMNS))
    missed = []
    for sequence in sequences:
        for mode, summary in measure(arguments, sequence).items():
            cells = [format_cell(column, summary) for column in COLUMNS]
            print(f"| {sequence['name']} | {mode} | " + " | ".join(cells) + " |", flush=True)
            missed += missed_bars(sequence["name"], mode, summary)
    for line in missed:
        print(f"missed: {line}", file=sys.stderr)
    return 3 if missed and arguments.fail_on_missed_bar else 0


if __name__ == "__main__":
    sys.exit(main())
