# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""The program as a whole: help, usage errors, version and the config command."""

import os
import re
import shlex

import cli_support
from cli_support import CliTestCase, run


def subcommands(*path):
    """The names below "Subcommands:" in the help of a command."""
    text = run(*path, "--help").stdout
    match = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.MULTILINE)
    if not match:
        return []
    return re.findall(r"^  (\S+)", match.group(1), re.MULTILINE)


def all_commands(path=()):
    """Every command path: (), ("config",), ("eval",), ("eval", "ate"), ..."""
    yield path
    for name in subcommands(*path):
        yield from all_commands((*path, name))


def examples(*path):
    """The command lines at the end of a command's help."""
    text = run(*path, "--help").stdout
    tail = text.rpartition("\nExamples:\n")[2]
    return [line.strip() for line in tail.splitlines() if line.strip()] if tail != text else []


class HelpTest(CliTestCase):
    def test_every_command_prints_help_on_stdout_that_ends_with_examples(self):
        for path in all_commands():
            with self.subTest(command=" ".join(path)):
                result = run(*path, "--help")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(result.stderr, "")
                self.assertIn("Usage: changing-slam", result.stdout)
                self.assertGreaterEqual(len(examples(*path)), 2, result.stdout)

    def test_every_example_is_a_command_line_the_program_accepts(self):
        for path in all_commands():
            for example in examples(*path):
                with self.subTest(example=example):
                    words = shlex.split(example)
                    if ">" in words:
                        words = words[:words.index(">")]
                    self.assertEqual(words[0], "changing-slam")
                    result = run("--check-arguments", *words[1:])
                    self.assertEqual(result.returncode, 0, result.stderr)

    def test_check_arguments_refuses_what_parsing_refuses(self):
        self.assertEqual(run("--check-arguments", "config", "--nonsense").returncode, 2)

    def test_version_names_version_and_commit(self):
        result = run("--version")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stdout, r"\Achanging-slam \d+\.\d+\.\d+ \(commit \S+\)\n\Z")

    def test_the_commands_of_the_readme_are_there(self):
        self.assertEqual(set(subcommands()), {"run", "relocalise", "eval", "benchmark", "dataset",
                                              "map", "model", "config"})


class UsageErrorTest(CliTestCase):
    def test_no_argument_prints_help_on_stderr(self):
        result = run()
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stdout, "")
        self.assertIn("Usage: changing-slam", result.stderr)

    def test_unknown_command_names_the_nearest_one(self):
        self.assert_one_line_error(run("confg"), 2, "unknown command 'confg'", "'config'")

    def test_unknown_option_names_the_nearest_one(self):
        self.assert_one_line_error(run("config", "--confg", "x"), 2, "unknown option '--confg'",
                                   "'--config'")
        self.assert_one_line_error(run("config", "--yamk=3"), 2, "'--yamk'", "'--yaml'")

    def test_unknown_option_before_the_command_names_the_nearest_one(self):
        self.assert_one_line_error(run("--log-levl=debug", "config"), 2, "'--log-level'")

    def test_superfluous_argument_is_named(self):
        self.assert_one_line_error(run("config", "extra"), 2, "unexpected argument 'extra'")

    def test_missing_value_is_an_error(self):
        self.assert_one_line_error(run("config", "--set"), 2, "--set")

    def test_unknown_log_level_lists_the_levels(self):
        self.assert_one_line_error(run("config", "--log-level", "loud"), 2, "loud", "debug")

    def test_every_command_points_at_its_own_help(self):
        for path in all_commands():
            with self.subTest(command=" ".join(path)):
                result = run(*path, "--no-such-option")
                self.assert_one_line_error(result, 2, "unknown option '--no-such-option'",
                                           " ".join(("changing-slam", *path, "--help")))

    def test_bad_override_is_a_usage_error_that_names_the_nearest_key(self):
        key = first_key()
        self.assert_one_line_error(run("config", "--set", key + "x=1"), 2,
                                   f"unknown option '{key}x'; did you mean '{key}'?")
        self.assert_one_line_error(run("config", "--set", key), 2, "expected key=value")


def first_key():
    """The first option that is a number, of whatever the program has."""
    for line in run("config").stdout.splitlines()[2:]:
        if re.search(r" -?[\d.e+-]+ to -?[\d.e+-]+ ", line):
            return line.split()[0]
    raise AssertionError("config lists no numeric option")


class ConfigTest(CliTestCase):
    def setUp(self):
        self.folder = self.make_folder()

    def write(self, text):
        path = self.folder / "options.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    def test_table_has_a_title_line_and_one_line_for_each_option(self):
        result = run("config")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(result.stdout.split()[:5], ["option", "value", "unit", "range", "meaning"])

    def test_yaml_output_is_accepted_and_printed_again_unchanged(self):
        text = run("config", "--yaml").stdout
        result = run("config", "--yaml", "--config", self.write(text))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, text)

    def test_overrides_win_over_the_file(self):
        table = run("config").stdout.splitlines()
        row = next(line for line in table if line.startswith(first_key() + " "))
        low, high = re.search(r"(\S+) to (\S+)", row).groups()
        file = self.write(f"{first_key()}: {low}\n")
        result = run("config", "--config", file, "--set", f"{first_key()}={high}")
        self.assertEqual(result.returncode, 0, result.stderr)
        changed = next(x for x in result.stdout.splitlines() if x.startswith(first_key() + " "))
        self.assertEqual(float(changed.split()[1]), float(high))

    def test_value_outside_its_range_names_file_line_and_range(self):
        file = self.write(f"# a comment\n{first_key()}: -1e300\n")
        result = run("config", "--config", file)
        if "whole number" in result.stderr:  # of an integer
            file.write_text(f"# a comment\n{first_key()}: -2147483648\n", encoding="utf-8")
            result = run("config", "--config", file)
        self.assert_one_line_error(result, 1, f"{file}:2: {first_key()} = ", "is outside")

    def test_unknown_key_in_the_file_names_file_line_and_nearest_key(self):
        file = self.write(f"\n\n{first_key()}x: 1\n")
        self.assert_one_line_error(run("config", "--config", file), 1, f"{file}:3:",
                                   f"did you mean '{first_key()}'?")

    def test_broken_yaml_is_one_line_with_file_and_line(self):
        file = self.write("a: [1, 2\nb: }\n")
        self.assert_one_line_error(run("config", "--config", file), 1, f"{file}:", "broken YAML")

    def test_missing_file_is_named(self):
        missing = self.folder / "none.yaml"
        self.assert_one_line_error(run("config", "--config", missing), 1, str(missing))

    def test_full_disk_under_stdout_is_an_error(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = run("config", stdout=full)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"\Achanging-slam: error: [^\n]+\n\Z")


if __name__ == "__main__":
    cli_support.main()
