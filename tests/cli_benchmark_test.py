# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""The benchmark command on a tiny rendering: plan, runs, report, going on after an interruption."""

import json
import pathlib
import shutil
import signal
import subprocess
import tempfile

import cli_support
from cli_support import CliTestCase, binary, run

cli_support.TIMEOUT_S = 200  # of a renderer and two runs on a busy machine
TINY = ("--sequences", "sitting_xyz", "--look", "procedural", "--size", "320x240", "--fps", "10",
        "--frames", "20", "--detector", "none", "--set", "tracking.orb.num_features=700")
RUNS = ("sitting_xyz-short-1-objects_on-1", "sitting_xyz-short-1-objects_off-1")


def benchmark(folder, *arguments):
    return run("benchmark", "--out", folder, *TINY, *arguments)


class FinishedTest(CliTestCase):
    """What one benchmark leaves, and what a second call makes of it."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="cslam_cli_")
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = pathlib.Path(cls.temporary.name) / "bench"
        cls.result = benchmark(cls.folder, "--yes")

    def test_says_first_what_it_will_take(self):
        self.assertEqual(self.result.returncode, 0, self.result.stderr)
        self.assertRegex(self.result.stderr, r"1 of 1 renderings to do \(about \d+ min\) and "
                         r"2 of 2 runs \(about \d+ min\), about \d+ MB")

    def test_reports_both_layers_in_three_forms(self):
        report = json.loads((self.folder / "report.json").read_text(encoding="utf-8"))
        self.assertEqual([r["objects"] for r in report["runs"]], ["on", "off"])
        for one in report["runs"]:
            self.assertEqual(one["problem"], "")
            self.assertGreater(one["figures"]["tracked_share"], 0.9)
            self.assertGreater(one["figures"]["tracking_ms"], 0.0)
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertEqual(page.count("<svg"), 4)
        self.assertEqual(page.count("<svg"), page.count("</svg>"))
        self.assertNotIn("http://", page.replace("http://www.w3.org/2000/svg", ""))
        text = (self.folder / "report.md").read_text(encoding="utf-8")
        self.assertIn("| sitting_xyz |", text)
        self.assertIn("Trajectories", self.result.stdout)

    def test_off_means_that_things_count_as_the_room_and_people_do_not(self):
        off = {"mapping.objects.enabled=false", "tracking.objects.label_movable=false"}
        for run_name, expected in zip(RUNS, (set(), off)):
            report = json.loads((self.folder / "runs" / run_name / "run.json").read_text())
            chosen = {word for word in report["arguments"] if ".objects." in word}
            self.assertEqual(chosen, expected, run_name)

    def test_uses_complete_runs_again_and_shows_others_beside(self):
        others = self.make_folder()
        shutil.copy(self.folder / "runs" / RUNS[0] / "trajectory.txt", others / "sitting_xyz.txt")
        before = [(self.folder / "runs" / name / "run.json").stat().st_mtime_ns for name in RUNS]
        result = benchmark(self.folder, "--trajectories", f"copy={others}")
        self.assertEqual(result.returncode, 0, result.stderr)
        after = [(self.folder / "runs" / name / "run.json").stat().st_mtime_ns for name in RUNS]
        self.assertEqual(before, after)
        self.assertIn("0 of 2 runs", result.stderr)
        report = json.loads((self.folder / "report.json").read_text(encoding="utf-8"))
        own = report["sequences"][0]["objects_on"]["ate_m"]["median"]
        self.assertAlmostEqual(report["sequences"][0]["other_ate_m"]["copy"]["median"], own, 4)

    def test_runs_again_what_was_run_otherwise(self):
        result = run("benchmark", "--out", self.folder, *TINY, "--rate", "sensor")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("2 of 2 runs", result.stderr)
        self.assertIn("--yes", result.stderr)


    def test_does_not_pass_another_rendering_off_as_what_was_asked_for(self):
        result = run("benchmark", "--out", self.folder, *TINY[:-6], "--frames", "10")
        self.assert_one_line_error(result, 1, "the number of frames is 20 there, 10 was asked for")


class BenchmarkTest(CliTestCase):
    def setUp(self):
        self.folder = self.make_folder() / "bench"

    def test_only_says_what_there_is_to_do_without_yes(self):
        result = benchmark(self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("--yes", result.stderr)
        self.assertFalse((self.folder / "runs").exists())
        self.assertFalse((self.folder / "report.md").exists())

    def begin_by_another_version(self):
        """Returns the record of the rendering begun, and a frame of it."""
        benchmark(self.folder)
        rendering = self.folder / "data" / "sitting_xyz-short-1"
        record = rendering / "render.json"
        begun = json.loads(record.read_text(encoding="utf-8"))
        record.write_text(json.dumps(begun | {"program": "an older one"}), encoding="utf-8")
        return record, next((rendering / "rgb").iterdir())

    def test_renders_anew_what_another_version_began_but_not_before_it_may(self):
        record, frame = self.begin_by_another_version()
        result = benchmark(self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("1 of the renderings replace what another version", result.stderr)
        self.assertIn("an older one", record.read_text(encoding="utf-8"))
        self.assertTrue(frame.exists())
        self.assertEqual([p.name for p in record.parents[1].iterdir()], ["sitting_xyz-short-1"])
        result = benchmark(self.folder, "--yes")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("an older one", record.read_text(encoding="utf-8"))

    def test_leaves_alone_what_a_link_leads_to(self):
        record, frame = self.begin_by_another_version()
        elsewhere = self.folder.parent / "elsewhere"
        record.parent.rename(elsewhere)
        record.parent.symlink_to(elsewhere)
        self.assert_one_line_error(benchmark(self.folder, "--yes"), 1, "remove the link")
        self.assertTrue((elsewhere / "rgb" / frame.name).exists())

    def test_goes_on_after_an_interruption(self):
        command = [binary(), "benchmark", "--out", self.folder, *TINY, "--yes"]
        with subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL,
                              encoding="utf-8") as process:
            for line in process.stderr:
                if line.startswith("run 2 of 2"):
                    process.send_signal(signal.SIGINT)
                    break
            rest = process.stderr.read()
            process.wait(timeout=cli_support.TIMEOUT_S)
        self.assertEqual(process.returncode, 130, rest)
        self.assertIn("the same command goes on", rest)
        result = benchmark(self.folder, "--yes")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("0 of 1 renderings", result.stderr)
        self.assertRegex(result.stderr, "[01] of 2 runs")

    def test_refuses_what_cannot_be(self):
        command = ["benchmark", "--out", self.folder]
        for arguments, part in ((["--sequences", "onechiar"], "onechair"),
                                (["--form", "long", "--repeats", "2"], "--repeats"),
                                (["--trajectories", "orb"], "--trajectories"),
                                (["--classes", "unicorn"], "unicorn"),
                                (["--set", "no.such=1"], "no.such")):
            with self.subTest(arguments=arguments):
                self.assert_one_line_error(run(*command, *arguments), 2, part)
        result = run(*command, "--trajectories", f"x={self.folder}/none")
        self.assert_one_line_error(result, 1, "none")


if __name__ == "__main__":
    cli_support.main()
