# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""dataset render and dataset list, on tiny sequences."""

import json
import os
import shutil
import signal
import subprocess
import tempfile

import cli_support
from cli_support import CliTestCase, binary, run

SMALL = ("--size", "64x48", "--frames", "3")
FILES = {"rgb.txt", "depth.txt", "instances.txt", "associations.txt", "groundtruth.txt",
         "camera.yaml", "detections.json", "objects.json", "changes.json", "contact_sheet.png",
         "README.txt", "render.json"}
ENTRIES = FILES | {"rgb", "depth", "instances"}


def contents(folder):
    return {path.relative_to(folder): path.read_bytes()
            for path in sorted(folder.rglob("*")) if path.is_file()}


class RenderTestCase(CliTestCase):
    def setUp(self):
        self.folder = self.make_folder()
        self.out = self.folder / "out"

    def render(self, *arguments, name="demo", size=SMALL, **popen):
        return run("dataset", "render", name, "--out", self.out, *size, *arguments, **popen)

    def render_well(self, *arguments, **more):
        result = self.render(*arguments, **more)
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
        return result

    def read(self, name):
        return json.loads((self.out / name).read_text(encoding="utf-8"))


class RenderTest(RenderTestCase):
    def test_writes_a_sound_sequence_and_says_its_size_first(self):
        result = self.render_well()
        self.assertRegex(result.stderr.splitlines()[0], r"3 frames of 64x48 at 30 Hz, about \d+ kB")
        self.assertIn("3 of 3", result.stderr)
        self.assertEqual({path.name for path in self.out.iterdir()}, ENTRIES)
        check = run("dataset", "check", self.out)
        self.assertEqual(check.returncode, 0, check.stdout)

    def test_number_of_jobs_does_not_change_a_byte(self):
        results = []
        for jobs in (1, 2):
            self.out = self.folder / str(jobs)
            self.render_well("--jobs", jobs)
            results.append(contents(self.out))
        self.assertEqual(len(results[0]), 3 * 3 + len(FILES))
        self.assertEqual(results[0], results[1])

    def test_seed_and_noise_change_the_images(self):
        depths = []
        for arguments in ((), ("--seed", "2"), ("--noise", "off"), ("--noise", "d435i")):
            self.out = self.folder / f"out{len(depths)}"
            self.render_well(*arguments)
            depths.append((self.out / "depth" / "1.000000.png").read_bytes())
        self.assertEqual(len(set(depths)), 4)

    def test_rate_sets_the_timestamps(self):
        self.render_well("--fps", "10")
        self.assertTrue((self.out / "rgb" / "1.200000.png").exists())

    def test_more_frames_than_the_story_has_are_not_made(self):
        result = self.render_well("--fps", "0.1")
        self.assertIn("warning: the story ends after 2 frames at 0.1 Hz; 3 were asked for",
                      result.stderr)
        self.assertEqual(self.read("render.json")["num_frames"], 2)
        self.assertEqual(len(list((self.out / "rgb").iterdir())), 2)

    def test_readme_and_record_tell_how_to_render_it_again(self):
        self.render_well("--seed", "7", "--noise", "off")
        command = self.read("render.json")["command"]
        self.assertIn(command, (self.out / "README.txt").read_text(encoding="utf-8"))
        again = self.folder / "again"
        words = command.replace("DIR", str(again)).split()
        self.assertEqual(words[0], "changing-slam")
        self.assertEqual(run(*words[1:]).returncode, 0)
        self.assertEqual(contents(again), contents(self.out))


class StoryTest(RenderTestCase):
    """A story from the registry, in the look that needs no packages."""

    OPTIONS = ("--look", "procedural", "--short", "--size", "80x60")

    def test_story_has_its_truth_with_it(self):
        result = self.render_well(*self.OPTIONS, "--fps", "0.5", name="replacing", size=())
        self.assertIn("(short form)", result.stderr)
        record = self.read("render.json")
        self.assertEqual((record["sequence"], record["look"], record["is_short"], record["noise"]),
                         ("replacing", "procedural", True, "d435i"))
        changes = self.read("changes.json")["changes"]
        self.assertIn("replaced", [change["kind"] for change in changes])
        names = {thing["instance"]: thing["name"] for thing in self.read("objects.json")["objects"]}
        readme = (self.out / "README.txt").read_text(encoding="utf-8")
        for change in changes:
            self.assertIn(names[change["instance"]], readme)
        frames = self.read("detections.json")["frames"]
        self.assertEqual(len(frames), record["num_frames"])
        self.assertEqual(frames[1]["stamp"], "3.000000")

    def test_people_can_be_left_out(self):
        options = (*self.OPTIONS, "--frames", "2")
        depths = []
        for more in ((), ("--without-people",)):
            self.out = self.folder / f"out{len(depths)}"
            self.render_well(*options, *more, name="walking_xyz", size=())
            depths.append((self.out / "depth" / "1.000000.png").read_bytes())
            record = self.read("render.json")
            self.assertEqual(record["without_people"], bool(more))
            self.assertEqual("--without-people" in record["command"], bool(more))
            classes = {thing["class_id"] for thing in self.read("objects.json")["objects"]}
            self.assertEqual(0 in classes, not more)
        self.assertNotEqual(depths[0], depths[1])
        check = run("dataset", "check", self.out)
        self.assertEqual(check.returncode, 0, check.stdout)

    def test_objects_can_be_left_out_by_name(self):
        options = (*self.OPTIONS, "--frames", "2")
        self.render_well(*options, "--without", "cart", name="box_carried", size=())
        record = self.read("render.json")
        self.assertEqual(record["without"], ["cart"])
        self.assertIn("--without 'cart'", record["command"])
        names = {thing["name"] for thing in self.read("objects.json")["objects"]}
        self.assertNotIn("cart", names)
        check = run("dataset", "check", self.out)
        self.assertEqual(check.returncode, 0, check.stdout)

        self.out = self.folder / "none"
        for name, text in (("box_carried", "has no object 'sofas' to leave out; there are: "),
                           ("demo", "nothing can be left out of 'demo'")):
            result = self.render(*options, "--without", "sofas", name=name, size=())
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn(text, result.stderr)

    def test_several_sequences_go_to_a_folder_each(self):
        result = run("dataset", "render", "static", "demo", "--out", self.out, *self.OPTIONS,
                     "--frames", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual({path.name for path in self.out.iterdir()}, {"static", "demo"})
        for name in ("static", "demo"):
            self.assertEqual({path.name for path in (self.out / name).iterdir()}, ENTRIES)

    def test_missing_packages_are_named_with_a_remedy_or_replaced_with_a_warning(self):
        if os.path.exists("/usr/share/sweethome3d"):
            self.skipTest("the packages are installed here")
        bare = {"XDG_DATA_HOME": str(self.folder / "data"), "PATH": "/nowhere"}
        options = ("--size", "64x48", "--frames", "1")
        result = self.render("--look", "packages", name="static", size=options, env=bare)
        self.assert_last_line_is_error(result, 1, "Debian package", "apt", "--look procedural")
        self.assertFalse(self.out.exists())
        result = self.render_well("--look", "auto", name="static", size=options, env=bare)
        warnings = [line for line in result.stderr.splitlines() if line.startswith("warning: ")]
        self.assertEqual(len(warnings), 1, result.stderr)
        self.assertEqual(self.read("render.json")["look"], "procedural")


class ListTest(CliTestCase):
    def test_names_what_can_be_rendered_on_stdout(self):
        result = run("dataset", "list")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, r"(?m)^demo +20 s +20 s +kinect ")
        self.assertRegex(result.stdout, r"(?m)^changing +195 s +\d+ s +d435i ")

    def test_gives_the_same_as_json(self):
        result = run("dataset", "list", "--json")
        entries = {entry["name"]: entry for entry in json.loads(result.stdout)}
        self.assertEqual(entries["walking_xyz"]["sensor"], "kinect")
        self.assertEqual(entries["changing"]["duration_s"], 195)
        for name, entry in entries.items():
            self.assertLessEqual(entry["short_duration_s"], 40, name)
        self.assertGreaterEqual(len(entries), 18)


class OutputFolderTest(RenderTestCase):
    def test_folder_that_is_not_empty_is_left_alone(self):
        self.out.mkdir()
        (self.out / "rgb.txt").write_text("mine", encoding="utf-8")
        for arguments in ((), ("--force",), ("--resume",)):
            self.assert_one_line_error(self.render(*arguments), 1, self.out, "another folder")
            self.assertEqual(list(contents(self.out).values()), [b"mine"])

    def test_rendered_sequence_is_left_alone_and_the_remedies_named(self):
        self.render_well()
        before = contents(self.out)
        self.assert_one_line_error(self.render("--fps", "5"), 1, self.out, "--force", "--resume")
        self.assertEqual(contents(self.out), before)

    def test_force_replaces_a_sequence_without_a_rest_and_spares_other_files(self):
        self.render_well("--fps", "5")
        (self.out / "thesis.tex").write_text("years", encoding="utf-8")
        self.render_well("--force")
        self.assertEqual(len(list((self.out / "rgb").iterdir())), 3)
        self.assertTrue((self.out / "rgb" / "1.033333.png").exists())
        self.assertTrue((self.out / "thesis.tex").exists())

    def test_folder_that_cannot_be_made_is_named(self):
        self.folder.joinpath("file").write_text("", encoding="utf-8")
        self.out = self.folder / "file" / "out"
        self.assert_last_line_is_error(self.render(), 1, self.out)

    def test_file_in_place_of_the_folder_is_named(self):
        self.out.write_text("", encoding="utf-8")
        self.assert_one_line_error(self.render(), 1, self.out)

    def test_more_than_the_disk_holds_is_refused_at_once(self):
        result = self.render(name="shift", size=("--size", "4096x4096", "--fps", "1000"))
        self.assert_one_line_error(result, 1, self.out, "free", "needed")
        self.assertFalse(self.out.exists())


class UsageTest(RenderTestCase):
    def test_unknown_sequence_names_the_nearest(self):
        self.assert_one_line_error(self.render(name="dmo"), 2, "'dmo'", "'demo'", "dataset list")

    def test_names_given_twice_and_all_among_others_are_usage_errors(self):
        for names, complaint in ((("demo", "static", "demo"), "'demo' is named twice"),
                                 (("demo", "all"), "'all' stands alone")):
            result = run("dataset", "render", *names, "--out", self.out)
            self.assert_one_line_error(result, 2, complaint)
            self.assertFalse(self.out.exists())

    def test_empty_name_of_the_folder_is_a_usage_error(self):
        self.assert_one_line_error(run("dataset", "render", "demo", "--out", ""), 2, "--out")

    def test_silly_values_are_usage_errors_that_name_the_option(self):
        cases = [("--size", size) for size in ("0x0", "64", "64x", "x48", "64x48x1", "-64x48",
                                               "31x48", "64x4097", "99999999999x48", "big")]
        cases += [("--fps", fps) for fps in ("0", "-30", "nan", "inf", "1001", "fast")]
        cases += [("--frames", "0"), ("--frames", "-1"), ("--jobs", "0"), ("--seed", "-1"),
                  ("--seed", "1.5"), ("--seed", "18446744073709551616"), ("--noise", "loud"),
                  ("--look", "pretty"), ("--jobs", "257"), ("--jobs", "many")]
        for option, value in cases:
            with self.subTest(option=option, value=value):
                result = self.render(f"{option}={value}", size=())
                self.assert_one_line_error(result, 2, option)
                self.assertFalse(self.out.exists())

    def test_resume_and_force_exclude_each_other(self):
        self.assert_one_line_error(self.render("--resume", "--force"), 2, "--resume", "--force")

    def test_missing_name_or_folder_is_a_usage_error(self):
        self.assert_one_line_error(run("dataset", "render", "--out", self.out), 2, "name")
        self.assert_one_line_error(run("dataset", "render", "demo"), 2, "--out")


class InterruptTest(RenderTestCase):
    COMMON = ("--size", "64x48", "--fps", "4")  # 80 frames

    def interrupt(self, number):
        """Sends the signal when a tenth is done; returns exit code and stderr."""
        command = [binary(), "dataset", "render", "demo", "--out", self.out, *self.COMMON]
        with subprocess.Popen(command, stderr=subprocess.PIPE, encoding="utf-8") as process:
            process.stderr.readline()  # what it is going to do
            first = process.stderr.readline()  # a tenth is done
            process.send_signal(number)
            _, rest = process.communicate(timeout=cli_support.TIMEOUT_S)
        self.assertFalse((self.out / "camera.yaml").exists(), first + rest)
        return process.returncode, rest

    def assert_resumes_to_the_same_bytes(self):
        result = self.render_well("--resume", size=self.COMMON)
        self.assertRegex(result.stderr, r"\d+ of 80 frames are there already")
        resumed = contents(self.out)
        self.out = self.folder / "whole"
        self.render_well(size=self.COMMON)
        self.assertEqual(resumed, contents(self.out))

    def test_interrupted_render_goes_on_to_the_same_bytes(self):
        exit_code, stderr = self.interrupt(signal.SIGINT)
        self.assertEqual(exit_code, 130, stderr)
        self.assertIn("--resume", stderr.splitlines()[-1])
        self.assert_resumes_to_the_same_bytes()

    def test_killed_render_goes_on_to_the_same_bytes(self):
        self.interrupt(signal.SIGKILL)
        self.assert_resumes_to_the_same_bytes()

    def test_resume_with_other_parameters_names_them_and_changes_nothing(self):
        self.interrupt(signal.SIGINT)
        before = contents(self.out)
        result = self.render("--resume", "--seed", "2", "--noise", "off", size=self.COMMON)
        self.assert_last_line_is_error(result, 1, "seed is 1", "noise is kinect", "--force")
        self.assertEqual(contents(self.out), before)

    def test_resume_of_nothing_begins(self):
        self.render_well("--resume")
        self.assertEqual({path.name for path in self.out.iterdir()}, ENTRIES)


class FullDiskTest(RenderTestCase):
    def test_full_disk_is_named_and_what_is_done_can_be_gone_on_with(self):
        if os.geteuid() != 0:
            self.skipTest("needs root to mount a small disk")
        disk = tempfile.mkdtemp(prefix="cslam_disk_")
        self.addCleanup(os.rmdir, disk)
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k", "tmpfs", disk],
                               stderr=subprocess.PIPE, check=False)
        if mount.returncode != 0:
            self.skipTest("cannot mount a small disk here")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        self.out = self.out.__class__(disk) / "out"
        size = ("--size", "64x48", "--frames", "8")  # 100 kB, and files take whole pages
        filler = self.out.parent / "filler"
        filler.write_bytes(bytes(60000))
        result = self.render(size=size)
        self.assert_last_line_is_error(result, 1, "No space left", "--resume")
        self.assertFalse((self.out / "camera.yaml").exists())
        subprocess.run(["mount", "-o", "remount,size=4m", disk], check=True)
        self.render_well("--resume", size=size)
        whole = self.folder / "whole"
        shutil.copytree(self.out, whole)
        self.out = self.folder / "other"
        self.render_well(size=size)
        self.assertEqual(contents(whole), contents(self.out))


if __name__ == "__main__":
    cli_support.main()
