#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Measures what each part of handling moving things is worth: the ablation of docs/dynamic.md.

Runs `changing-slam run` on sequences x rows x repeats, prints one Markdown table and then each bar
with the figure held against it. Every run keeps its folder under --work and is not repeated while
program and arguments are the same, so an interrupted report goes on where it was. Times are of
this machine: let nothing else run.
"""

import argparse
import json
import pathlib
import shutil
import subprocess
import sys

import benchmark

PERFECT = "perfect"  # a row's detector: the sequence's own detections.json
MODEL = "model"      # --model, or the best installed
NONE = "none"
RECORDED = "recorded"  # --model: detections.json for these rows too, to be degraded with --set

NO_BRIDGE = ["tracking.objects.bridge=0"]
NO_FILTER = ["tracking.objects.filter_motion=false"]
NO_UNKNOWN = ["tracking.objects.unknown.enabled=false"]


def rule(name):
    return [f"tracking.objects.labels.rule={name}"]


# Row -> detector and settings. Each of the first ones adds one thing to the one before.
ROWS = {
    "nothing": (NONE, ["tracking.objects.enabled=false"]),
    "boxes only": (MODEL, rule("boxes") + NO_FILTER + NO_BRIDGE + NO_UNKNOWN),
    "+ repopulation (bands)": (MODEL, rule("bands") + NO_FILTER + NO_BRIDGE + NO_UNKNOWN),
    "+ repopulation (surfaces)": (MODEL, NO_FILTER + NO_BRIDGE + NO_UNKNOWN),
    "+ tracking": (MODEL, NO_BRIDGE + NO_UNKNOWN),
    "+ miss bridging": (MODEL, NO_UNKNOWN),
    "+ unknown movers (all)": (MODEL, []),
    "all, perfect boxes": (PERFECT, []),
    "all, no detector": (NONE, []),
}
ALL = "+ unknown movers (all)"

MODES = {  # as in the bars: inline isolates accuracy, the others are what a user gets
    "inline": ["--deterministic", "--schedule", "every-frame"],
    "live": ["--rate", "sensor", "--schedule", "live"],
    "max": ["--rate", "max", "--schedule", "live"],
}

COLUMNS = {
    "ate_mm": "ATE mm",
    "tracked": "tracked %",
    "process_ms": "CPU ms/frame",
    "tracking_ms": "tracking median ms",
    "tracking_p99_ms": "p99 ms",
    "fps": "fps",
    "dropped": "dropped",
}

SLACK_MM = 2.0  # that the issue allows its ratios
# (sequence, row, mode): column -> the most it may be (tracked and fps: the least).
BARS = {
    ("bonn_crowd_part", ALL, "live"): {"ate_mm": 17.0, "tracked": 100.0, "dropped": 0.0,
                                       "tracking_ms": 12.0, "tracking_p99_ms": 50.0,
                                       "process_ms": 45.0},
    ("bonn_crowd_part", ALL, "max"): {"fps": 45.0},
    ("walking_xyz", ALL, "live"): {"ate_mm": 15.0},
    ("walking_static", ALL, "live"): {"ate_mm": 7.0},
    ("walking_rpy", ALL, "live"): {"ate_mm": 30.0},
    ("walking_halfsphere", ALL, "live"): {"ate_mm": 20.0},
}
AT_LEAST = {"tracked", "fps"}
# A cell's ATE may be so many times another's.
RATIOS = [
    (("bonn_crowd_part", ALL, "live"), 1.15, ("bonn_empty", ALL, "live")),
    (("walking_xyz", "all, perfect boxes", "inline"), 1.3, ("empty_walking_xyz", ALL, "inline")),
    (("walking_halfsphere", "all, perfect boxes", "inline"), 1.3,
     ("empty_walking_halfsphere", ALL, "inline")),
    (("sitting_xyz", ALL, "inline"), 1.05, ("sitting_xyz", "nothing", "inline")),
    (("static", ALL, "inline"), 1.05, ("static", "nothing", "inline")),
]


def figures_of(report):
    """The columns' values of one run.json."""
    wall = report["stages"]["tracking"]["wall"]
    return {
        **benchmark.figures_of(report),
        "tracking_ms": wall["median_ms"],
        "tracking_p99_ms": wall["p99_ms"],
        "fps": report["frames"]["processed"] / report["cost"]["wall_s"],
    }


def run_arguments(options, sequence, row, mode):
    detector, settings = ROWS[row]
    arguments = list(MODES[mode])
    if detector == PERFECT or (detector == MODEL and options.model == RECORDED):
        arguments += ["--detections", str(sequence["path"] / "detections.json")]
    elif detector == NONE:
        arguments += ["--detector", "none"]
    elif options.model:
        arguments += ["--model", options.model]
    for setting in settings + options.set:
        arguments += ["--set", setting]
    return arguments


def earlier_run(folder, commit, sequence, arguments):
    """run.json of a run that need not be repeated, or None."""
    wanted = ["run", str(sequence["path"]), "--out", str(folder), *arguments]
    if sequence["frames"]:
        wanted += ["--frames", str(sequence["frames"])]
    try:
        report = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    is_same = report["commit"] == commit and report["arguments"][-len(wanted):] == wanted
    return report if is_same and not report["was_interrupted"] else None


def measure(options, commit, sequence, row, mode):
    """Medians of one cell of the table."""
    arguments = run_arguments(options, sequence, row, mode)
    place = options.work / sequence["name"] / row.replace(" ", "_").replace(",", "") / mode
    if options.model:
        place = place / pathlib.Path(options.model).stem
    runs = []
    for i in range(1 if mode == "inline" else options.runs):
        folder = place / str(i)
        report = earlier_run(folder, commit, sequence, arguments)
        if report is None:
            print(f"{sequence['name']}: {row}, {mode}, run {i + 1}", file=sys.stderr, flush=True)
            shutil.rmtree(folder, ignore_errors=True)
            folder.parent.mkdir(parents=True, exist_ok=True)
            report = benchmark.run_once(options.binary, sequence, arguments, folder)
        runs.append(figures_of(report))
    summary = benchmark.summarise(runs)
    for column in COLUMNS:
        values = sorted(run[column] for run in runs if run[column] is not None)
        summary[column] = values[len(values) // 2] if values else None
    return summary


def is_possible(sequence, row):
    return ROWS[row][0] != PERFECT or (sequence["path"] / "detections.json").exists()


def verdict(name, value, bar, is_met):
    return f"{'met' if is_met else 'MISSED'}: {name}: {value:.1f}, bar {bar:.1f}"


def check_bars(cells):
    """One line for each bar whose cells were measured."""
    for key, bars in BARS.items():
        for column, bar in bars.items() if key in cells else ():
            value = cells[key][column]
            if value is None:
                continue
            is_met = value >= bar if column in AT_LEAST else value <= bar
            yield verdict(f"{', '.join(key)}: {COLUMNS[column]}", value, bar, is_met)
    for key, factor, reference in RATIOS:
        if key not in cells or reference not in cells:
            continue
        value, other = cells[key]["ate_mm"], cells[reference]["ate_mm"]
        if value is None or other is None:
            continue
        bar = factor * other + SLACK_MM
        yield verdict(f"{', '.join(key)}: ATE mm against {factor} x {', '.join(reference)}",
                      value, bar, value <= bar)


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="Examples:\n"
               "  tools/dynamic_report.py --mode inline data/walking_xyz data/empty_walking_xyz\n"
               "  tools/dynamic_report.py --mode live --mode max --row 'all' --model nanodet-g \\\n"
               "      bonn_crowd_part=../shared/data/bonn_crowd_part \\\n"
               "      bonn_empty=../shared/data/bonn_crowd_part:200\n"
               "  tools/dynamic_report.py --model recorded --set detector.degrade.drop=0.3 data/x")
    parser.add_argument("sequences", nargs="+", type=benchmark.parse_sequence,
                        metavar="[NAME=]PATH[:FRAMES]", help="folders in TUM layout")
    parser.add_argument("--row", action="append", dest="rows", default=[], metavar="TEXT",
                        help="only rows whose name has this in it; can be repeated")
    parser.add_argument("--mode", action="append", choices=MODES, dest="modes",
                        help="can be repeated (default: inline)")
    parser.add_argument("--runs", type=int, default=5, help="threaded runs of each (default 5)")
    parser.add_argument("--model", help="of the rows with a network (default: the best installed); 'recorded' "
                             "takes the sequence's detections.json in its place")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="for every run, after the row's own; can be repeated")
    parser.add_argument("--binary", default=str(benchmark.ROOT / "build/release/changing-slam"))
    parser.add_argument("--work", type=pathlib.Path,
                        default=benchmark.ROOT / "build/dynamic_report",
                        help="where the runs are kept (default build/dynamic_report)")
    parser.add_argument("--fail-on-missed-bar", action="store_true", help="exit with code 3 then")
    return parser.parse_args()


def commit_of(binary):
    if not pathlib.Path(binary).exists():
        sys.exit(f"dynamic_report: no program '{binary}'; build it or name it with --binary")
    text = subprocess.run([binary, "--version"], capture_output=True, encoding="utf-8",
                          check=True).stdout
    return text.split()[-1].rstrip(")")


def main():
    options = parse_arguments()
    commit = commit_of(options.binary)
    rows = [row for row in ROWS if not options.rows or any(text in row for text in options.rows)]
    if not rows:
        sys.exit(f"dynamic_report: no such row; there are: {'; '.join(ROWS)}")
    plan = [(sequence, row, mode) for sequence in options.sequences
            for mode in options.modes or ["inline"] for row in rows if is_possible(sequence, row)]
    num_runs = sum(1 if mode == "inline" else options.runs for _, _, mode in plan)
    print(f"{len(plan)} cells, {num_runs} runs of {options.binary} ({commit}), "
          f"kept in '{options.work}'", file=sys.stderr)
    print("| sequence | mode | what is on | " + " | ".join(COLUMNS.values()) + " |")
    print("|---|---|---|" + "---|" * len(COLUMNS))
    cells = {}
    for sequence, row, mode in plan:
        summary = measure(options, commit, sequence, row, mode)
        cells[(sequence["name"], row, mode)] = summary
        texts = [benchmark.format_cell(column, summary) for column in COLUMNS]
        print(f"| {sequence['name']} | {mode} | {row} | " + " | ".join(texts) + " |", flush=True)
    verdicts = list(check_bars(cells))
    if verdicts:
        print()
    for line in verdicts:
        print(f"- {line}")
    is_missed = any(line.startswith("MISSED") for line in verdicts)
    return 3 if is_missed and options.fail_on_missed_bar else 0


if __name__ == "__main__":
    sys.exit(main())
