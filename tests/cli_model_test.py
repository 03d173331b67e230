#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Tests 'changing-slam model' as far as it goes without a network."""

import os

from cli_support import CliTestCase, main, run

YAML = "decoder: nanodet-plus\nwidth: 416\nheight: 320\n"


class ModelTest(CliTestCase):
    def setUp(self):
        self.data = self.make_folder()
        self.models = self.data / "changing-slam" / "models"
        self.environment = {**os.environ, "XDG_DATA_HOME": str(self.data),
                            "XDG_DATA_DIRS": str(self.data / "none")}

    def model(self, *arguments):
        return run("model", *arguments, env=self.environment)

    def add_model(self, name, yaml=YAML, onnx=b"no network"):
        self.models.mkdir(parents=True, exist_ok=True)
        (self.models / f"{name}.yaml").write_text(yaml, encoding="utf-8")
        (self.models / f"{name}.onnx").write_bytes(onnx)

    def test_says_how_to_get_a_model_where_there_is_none(self):
        result = self.model("list")
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stdout, "")
        self.assertIn("changing-slam model install", result.stderr)
        self.assert_one_line_error(self.model("info"), 1, "changing-slam model install")
        self.assert_one_line_error(self.model("info", "nanodet-g"), 1, "'nanodet-g'",
                                   "changing-slam model install")

    def test_lists_models_and_marks_the_default(self):
        self.add_model("another")
        self.add_model("nanodet-g")
        self.add_model("bad", yaml="decoder: none\n")
        result = self.model("list")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = {line[3:].split()[0]: line for line in result.stdout.splitlines()[2:-1]}
        self.assertEqual(sorted(rows), ["another", "bad", "nanodet-g"])
        self.assertTrue(rows["nanodet-g"].startswith("*"))
        self.assertFalse(rows["another"].startswith("*"))
        self.assertIn("416x320", rows["another"])
        self.assertIn("not usable", rows["bad"])
        self.assertIn("decoder 'none'", rows["bad"])

    def test_info_names_the_file_that_is_no_network(self):
        self.add_model("broken")
        self.assert_last_line_is_error(self.model("info", "broken"), 1, "broken.onnx")
        self.assert_one_line_error(self.model("info", self.data / "x.onnx"), 1, "x.onnx")

    def test_install_says_what_is_not_there(self):
        missing = self.data / "missing.onnx"
        result = self.model("install", "--from", missing)
        self.assert_last_line_is_error(result, 1)
        self.assertFalse(self.models.exists())

    def test_needs_a_subcommand(self):
        self.assertEqual(self.model().returncode, 2)


if __name__ == "__main__":
    main()
