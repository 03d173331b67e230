#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the loops, revisits and losses of run folders against ground truth.

    tools/loop_truth.py RUN... [--verbose] [--json]

For each run of a sequence that has a groundtruth.txt:
- loops: a candidate that was verified is true if the relative pose of its frames differs from the
  truth by at most 20 cm and 10 degrees. A false loop that was closed or merged: exit code 3.
- revisits: pairs of frames of the final trajectory, at least 5 s apart, that truly look at the same
  place (within 50 cm and 20 degrees). The map has closed such a pair if it has them where they are
  to within 5 cm and 3 degrees of the truth, relative to each other.
- losses: each stretch of frames without a pose, and how it ended.
"""

import argparse
import bisect
import csv
import json
import math
import pathlib
import sys

TRUE_M, TRUE_DEG = 0.20, 10.0
REVISIT_S, REVISIT_M, REVISIT_DEG = 5.0, 0.5, 20.0
CLOSED_M, CLOSED_DEG = 0.05, 3.0
REVISIT_STEP_S = 0.3
SAME_TIME_S = 1e-4
MISSED_BAR = 3


def multiply(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def conjugate(q):
    return (-q[0], -q[1], -q[2], q[3])


def rotate(q, p):
    x, y, z, _ = multiply(multiply(q, (*p, 0.0)), conjugate(q))
    return (x, y, z)


def relative(a, b):
    """T_a_b of two poses (position, quaternion)."""
    offset = tuple(y - x for x, y in zip(a[0], b[0]))
    return rotate(conjugate(a[1]), offset), multiply(conjugate(a[1]), b[1])


def difference(a, b):
    """Metres and degrees between two poses."""
    (x, y, z), q = relative(a, b)
    sine = math.sqrt(q[0] ** 2 + q[1] ** 2 + q[2] ** 2)
    return math.sqrt(x * x + y * y + z * z), math.degrees(2.0 * math.atan2(sine, abs(q[3])))


def read_trajectory(path):
    """Times and poses."""
    times, poses = [], []
    for line in path.read_text().splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        t, x, y, z, *q = (float(word) for word in line.split())
        norm = math.sqrt(sum(c * c for c in q))
        times.append(t)
        poses.append(((x, y, z), tuple(c / norm for c in q)))
    return times, poses


class Truth:
    """The true pose at any time, interpolated; None where there is none then, nor one within 50 ms
    on both sides."""

    def __init__(self, path):
        self.times, self.poses = read_trajectory(path)

    def at(self, t):
        i = bisect.bisect_left(self.times, t)
        before, after = max(i - 1, 0), min(i, len(self.times) - 1)
        for i in (before, after):
            if abs(self.times[i] - t) < SAME_TIME_S:
                return self.poses[i]
        if max(t - self.times[before], self.times[after] - t) > 0.05:
            return None
        span = self.times[after] - self.times[before]
        share = (t - self.times[before]) / span if span > 0 else 0.0
        (p, a), (r, b) = self.poses[before], self.poses[after]
        if sum(x * y for x, y in zip(a, b)) < 0:
            b = tuple(-c for c in b)
        q = tuple(x + share * (y - x) for x, y in zip(a, b))
        norm = math.sqrt(sum(c * c for c in q))
        return (tuple(x + share * (y - x) for x, y in zip(p, r)), tuple(c / norm for c in q))


def loop_error(candidate, truth):
    """Metres and degrees off; None where nothing was verified or the truth is not known."""
    if candidate["T_match_query"] is None:
        return None
    match = truth.at(float(candidate["match_stamp"]))
    query = truth.at(float(candidate["query_stamp"]))
    if match is None or query is None:
        return None
    pose = candidate["T_match_query"]
    found = (tuple(pose[k] for k in ("tx_m", "ty_m", "tz_m")),
             tuple(pose[k] for k in ("qx", "qy", "qz", "qw")))
    return difference(relative(match, query), found)


def judge_loops(run, truth, verbose):
    counts = {}
    for c in json.loads((run / "loops.json").read_text())["candidates"]:
        error = loop_error(c, truth)
        if error is None:
            continue
        is_true = error[0] <= TRUE_M and error[1] <= TRUE_DEG
        verdict = f"{c['verdict']} {'true' if is_true else 'false'}"
        counts[verdict] = counts.get(verdict, 0) + 1
        if not verbose:
            continue
        e = c["evidence"]
        print(f"  {c['query_stamp']} -> {c['match_stamp']} maps {c['query_map']}-{c['match_map']} "
              f"{verdict} by {error[0]:.3f} m {error[1]:.2f} deg; {e['matches']}/"
              f"{e['ransac_inliers']}/{e['inliers']} {e['median_error_px']:.1f} px x{e['confirmations']}, drift {e['drift_m']:.3f}"
              f" m of {e['path_m']:.1f} m, depth {100 * e['depth_contradicted']:.1f} % of "
              f"{e['depth_compared']}, expected {e.get('expected')}: {c['reason']}")
    return counts


def judge_revisits(run, truth):
    times, poses = read_trajectory(run / "trajectory.txt")
    kept = []  # time, truth, estimate
    for t, pose in zip(times, poses):
        if kept and t - kept[-1][0] < REVISIT_STEP_S:
            continue
        true_pose = truth.at(t)
        if true_pose is not None:
            kept.append((t, true_pose, pose))
    errors = []
    for i, (t, true_a, a) in enumerate(kept):
        for s, true_b, b in kept[:i]:
            if t - s < REVISIT_S or math.dist(true_a[0], true_b[0]) > REVISIT_M:
                continue
            true_relative = relative(true_b, true_a)
            if difference(true_a, true_b)[1] > REVISIT_DEG:
                continue
            errors.append((*difference(true_relative, relative(b, a)), s, t))
    return errors


def find_losses(run):
    """(first lost stamp, stamp of the first pose after or None, its reason)."""
    losses, start, has_map = [], None, False
    with open(run / "frames.csv", newline="") as file:
        for row in csv.DictReader(file):
            if row["state"] == "tracking":
                if start is not None:
                    losses.append((start, float(row["timestamp_s"]), row["reason"]))
                start, has_map = None, True
            elif start is None and has_map:
                start = float(row["timestamp_s"])
    if start is not None:
        losses.append((start, None, "never again"))
    return losses


def report(run, verbose):
    record = json.loads((run / "run.json").read_text())
    truth = Truth(pathlib.Path(record["sequence"]) / "groundtruth.txt")
    if verbose:
        print(f"{run}:")
    loops = judge_loops(run, truth, verbose)
    revisits = judge_revisits(run, truth)
    closed = sum(1 for m, deg, *_ in revisits if m <= CLOSED_M and deg <= CLOSED_DEG)
    losses = find_losses(run)
    accuracy = record.get("accuracy", {}).get("trajectory", {}).get("ate_m", {})
    return {
        "run": str(run), "ate_rmse_m": accuracy.get("rmse"), "ate_max_m": accuracy.get("max"),
        "tracked_percent": record["frames"]["tracked_percent"],
        "in_trajectory": record["frames"]["in_trajectory"],
        "processed": record["frames"]["processed"],
        "loops": loops, "revisits": len(revisits), "revisits_closed": closed,
        "worst_revisit_m": max((m for m, *_ in revisits), default=0.0),
        "losses": [{"from_s": a, "to_s": b, "ended": reason} for a, b, reason in losses],
    }


def count(result, *verdicts):
    return sum(result["loops"].get(v, 0) for v in verdicts)


def print_table(results):
    print("| run | ATE mm | in trajectory | closed true | merged true | closed or merged false | "
          "refused or pending true | false | revisits closed | worst revisit | losses |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for r in results:
        ate = "-" if r["ate_rmse_m"] is None else f"{1e3 * r['ate_rmse_m']:.1f}"
        print(f"| {pathlib.Path(r['run']).name} | {ate} | {r['in_trajectory']} of {r['processed']} "
              f"| {count(r, 'closed true')} | {count(r, 'merged true')} "
              f"| {count(r, 'closed false', 'merged false')} "
              f"| {count(r, 'refused true', 'pending true')} "
              f"| {count(r, 'refused false', 'pending false')} "
              f"| {r['revisits_closed']} of {r['revisits']} | {1e3 * r['worst_revisit_m']:.0f} mm "
              f"| {len(r['losses'])} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", type=pathlib.Path, metavar="RUN", help="run folders")
    parser.add_argument("--verbose", action="store_true", help="every verified candidate and loss")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    results = []
    for run in arguments.runs:
        results.append(report(run, arguments.verbose))
        if arguments.verbose:
            for loss in results[-1]["losses"]:
                print(f"  lost at {loss['from_s']:.3f} until {loss['to_s']}: {loss['ended']}")
    if arguments.json:
        print(json.dumps(results, indent=2))
    else:
        print_table(results)
    has_false = any(count(r, "closed false", "merged false") for r in results)
    return MISSED_BAR if has_false else 0


if __name__ == "__main__":
    sys.exit(main())
