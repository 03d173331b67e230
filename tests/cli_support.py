# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of the real program share.

Usage of each test: cli_..._test.py --binary path/to/changing-slam [unittest arguments]
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import unittest

TIMEOUT_S = 60
_binary = None


def binary():
    return _binary


def run(*arguments, stdout=subprocess.PIPE, **popen):
    return subprocess.run([_binary, *map(str, arguments)], stdout=stdout, stderr=subprocess.PIPE,
                          encoding="utf-8", timeout=TIMEOUT_S, check=False, **popen)


class CliTestCase(unittest.TestCase):
    maxDiff = None

    def assert_one_line_error(self, result, exit_code, *parts):
        self.assertEqual(result.returncode, exit_code, result.stderr)
        self.assertEqual(result.stdout or "", "")
        self.assertRegex(result.stderr, r"\Achanging-slam: error: [^\n]+\n\Z")
        for part in parts:
            self.assertIn(str(part), result.stderr)

    def assert_last_line_is_error(self, result, exit_code, *parts):
        """For commands that may say something before they fail."""
        self.assertEqual(result.returncode, exit_code, result.stderr)
        last = result.stderr.splitlines()[-1] if result.stderr else ""
        self.assertTrue(last.startswith("changing-slam: error: "), result.stderr)
        for part in parts:
            self.assertIn(str(part), last)

    def make_folder(self):
        """A folder that is gone after the test."""
        folder = tempfile.TemporaryDirectory(prefix="cslam_cli_")
        self.addCleanup(folder.cleanup)
        return pathlib.Path(folder.name)


def main():
    global _binary
    parser = argparse.ArgumentParser()
    parser.add_argument("--binary", required=True)
    arguments, rest = parser.parse_known_args()
    _binary = str(pathlib.Path(arguments.binary).resolve())
    unittest.main(module="__main__", argv=[sys.argv[0], *rest], verbosity=1)
