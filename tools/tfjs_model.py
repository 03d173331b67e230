# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Turns a NanoDet detector stored as a tfjs graph model into an ONNX graph.

A tfjs graph model is a JSON file with TensorFlow nodes and the raw bytes of its weights beside it.
Only the operations that NanoDet consists of are known. The tfjs graph changes between the channel
orders NCHW and NHWC around each operation; the ONNX graph is NCHW throughout, so that those
transposes vanish, explicit padding moves into the convolutions, and additions of constants become
their bias. It ends at the raw values of each level, [1, classes + box bins, h, w]: what follows in
the original (sigmoid, reshape, transpose) is cheaper where the boxes are decoded.
"""

import base64
import json
import pathlib

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

TO_NHWC = [0, 2, 3, 1]
TO_NCHW = [0, 3, 1, 2]
INPUT_NAME = "data"
OPSET = 11  # what OpenCV 4.6 reads best
IR_VERSION = 6


class ConversionError(Exception):
    """The model is not what the converter knows; one line for the user."""


def read_weights(manifest, folder):
    """All constants by name. Half precision is widened to float32."""
    weights = {}
    for group in manifest:
        data = b"".join((folder / path).read_bytes() for path in group["paths"])
        offset = 0
        for entry in group["weights"]:
            stored = entry.get("quantization", {}).get("dtype", entry["dtype"])
            kinds = {"float16": np.float16, "float32": np.float32, "int32": np.int32}
            if stored not in kinds:
                raise ConversionError(f"weight '{entry['name']}' is of the unknown type {stored}")
            count = int(np.prod(entry["shape"], dtype=np.int64))
            size = count * np.dtype(kinds[stored]).itemsize
            if offset + size > len(data):
                raise ConversionError(f"{', '.join(group['paths'])} is shorter than its JSON says")
            values = np.frombuffer(data, kinds[stored], count, offset).reshape(entry["shape"])
            if stored != "int32":
                values = values.astype(np.float32)
            weights[entry["name"]] = values
            offset += size
    return weights


class Value:
    """A tensor of the ONNX graph as the tfjs graph sees it."""

    def __init__(self, name, layout, stride, channels, pads=(0, 0, 0, 0)):
        self.name = name
        self.layout = layout  # "NCHW" or "NHWC"
        self.stride = stride  # px of the input per cell
        self.channels = channels
        self.pads = tuple(pads)  # top, left, bottom, right, not yet applied

    def like(self, **changes):
        fields = dict(name=self.name, layout=self.layout, stride=self.stride,
                      channels=self.channels, pads=self.pads)
        return Value(**{**fields, **changes})


class Converter:
    """Emits ONNX nodes on the way from the outputs back to the input."""

    def __init__(self, topology, weights):
        self.nodes = {node["name"]: node for node in topology["node"]}
        self.weights = weights
        self.values = {}
        self.onnx_nodes = []
        self.initializers = []

    def constant(self, name):
        return self.weights.get(name.split(":")[0])

    def value(self, name):
        """The tensor of that name, padding perhaps still to come."""
        name = name.split(":")[0]
        if name not in self.values:
            self.values[name] = self.emit(self.nodes[name])
        return self.values[name]

    def plain_value(self, name):
        value = self.value(name)
        if any(value.pads):
            raise ConversionError(f"'{name}' is padded for something else than a convolution")
        return value

    def add_node(self, kind, inputs, name, **attributes):
        self.onnx_nodes.append(helper.make_node(kind, inputs, [name], name=name, **attributes))
        return name

    def add_initializer(self, name, values):
        self.initializers.append(numpy_helper.from_array(np.ascontiguousarray(values), name))
        return name

    def emit(self, node):
        emitters = {
            "Placeholder": self.emit_input, "Transpose": self.emit_transpose,
            "Pad": self.emit_pad, "PadV2": self.emit_pad, "Conv2D": self.emit_conv,
            "Add": self.emit_add, "AddV2": self.emit_add, "LeakyRelu": self.emit_leaky_relu,
            "ConcatV2": self.emit_concat, "MaxPool": self.emit_max_pool,
            "ResizeBilinear": self.emit_resize,
        }
        if node["op"] not in emitters:
            raise ConversionError(f"operation {node['op']} ('{node['name']}') is not known")
        return emitters[node["op"]](node)

    def emit_input(self, node):
        del node
        return Value(INPUT_NAME, "NCHW", 1, 3)

    def emit_transpose(self, node):
        value = self.value(node["input"][0])
        order = self.constant(node["input"][1]).tolist()
        expected, result = (TO_NHWC, "NHWC") if value.layout == "NCHW" else (TO_NCHW, "NCHW")
        if order != expected:
            raise ConversionError(f"transpose '{node['name']}' by {order} is not known")
        return value.like(layout=result)

    def emit_pad(self, node):
        value = self.plain_value(node["input"][0])
        pads = self.constant(node["input"][1])
        rows, columns = (pads[2], pads[3]) if value.layout == "NCHW" else (pads[1], pads[2])
        if int(np.sum(pads)) != int(np.sum(rows) + np.sum(columns)):
            raise ConversionError(f"'{node['name']}' pads channels")
        return value.like(pads=[int(rows[0]), int(columns[0]), int(rows[1]), int(columns[1])])

    def window(self, node, value):
        """Strides and padding of a convolution or pooling; all are NHWC."""
        attributes = node["attr"]
        order = base64.b64decode(attributes["data_format"]["s"]).decode()
        padding = base64.b64decode(attributes["padding"]["s"]).decode()
        strides = [int(i) for i in attributes["strides"]["list"]["i"]]
        dilations = [int(i) for i in attributes.get("dilations", {}).get("list", {}).get("i", [1])]
        if order != "NHWC" or value.layout != "NHWC" or padding != "VALID" or max(dilations) != 1:
            raise ConversionError(f"the layout of '{node['name']}' is not known")
        if strides[1] != strides[2]:
            raise ConversionError(f"'{node['name']}' has strides {strides}")
        return strides[1:3], list(value.pads)

    def emit_conv(self, node):
        value = self.value(node["input"][0])
        kernel = np.transpose(self.constant(node["input"][1]), (3, 2, 0, 1))
        strides, pads = self.window(node, value)
        weight = self.add_initializer(node["name"] + "_w", kernel)
        self.add_node("Conv", [value.name, weight], node["name"], strides=strides, pads=pads,
                      kernel_shape=kernel.shape[2:], dilations=[1, 1], group=1)
        return value.like(name=node["name"], stride=value.stride * strides[0],
                          channels=kernel.shape[0], pads=(0, 0, 0, 0))

    def emit_add(self, node):
        constants = [self.constant(name) for name in node["input"]]
        if constants[0] is None and constants[1] is None:
            a, b = (self.plain_value(name) for name in node["input"])
            self.add_node("Add", [a.name, b.name], node["name"])
            return a.like(name=node["name"])
        data = self.value(node["input"][0 if constants[0] is None else 1])
        bias = constants[1] if constants[0] is None else constants[0]
        conv = next((n for n in self.onnx_nodes if n.name == data.name), None)
        if conv is None or conv.op_type != "Conv" or bias.ndim != 1 or len(conv.input) != 2:
            raise ConversionError(f"'{node['name']}' is not the bias of a convolution")
        conv.input.append(self.add_initializer(data.name + "_b", bias))
        return data

    def emit_leaky_relu(self, node):
        value = self.plain_value(node["input"][0])
        self.add_node("LeakyRelu", [value.name], node["name"],
                      alpha=float(node["attr"]["alpha"]["f"]))
        return value.like(name=node["name"])

    def emit_concat(self, node):
        values = [self.plain_value(name) for name in node["input"][:-1]]
        axis = int(self.constant(node["input"][-1]))
        if axis != 1 or any(v.layout != "NCHW" for v in values):
            raise ConversionError(f"'{node['name']}' does not join channels")
        self.add_node("Concat", [v.name for v in values], node["name"], axis=1)
        return values[0].like(name=node["name"], channels=sum(v.channels for v in values))

    def emit_max_pool(self, node):
        value = self.value(node["input"][0])
        strides, pads = self.window(node, value)
        kernel = [int(i) for i in node["attr"]["ksize"]["list"]["i"]][1:3]
        self.add_node("MaxPool", [value.name], node["name"], kernel_shape=kernel, strides=strides,
                      pads=pads)
        return value.like(name=node["name"], stride=value.stride * strides[0], pads=(0, 0, 0, 0))

    def emit_resize(self, node):
        """By two, up or down. Half-pixel bilinear down by two is the mean of 2 x 2."""
        value = self.plain_value(node["input"][0])
        height = int(self.constant(node["input"][1])[0])
        old_height = self.input_height() // value.stride
        if not node["attr"]["half_pixel_centers"]["b"] or node["attr"]["align_corners"]["b"]:
            raise ConversionError(f"'{node['name']}' is not a half-pixel resize")
        if height == 2 * old_height:
            roi = self.add_initializer(node["name"] + "_roi", np.zeros(0, np.float32))
            scales = np.array([1, 1, 2, 2], np.float32)
            scales = self.add_initializer(node["name"] + "_scales", scales)
            self.add_node("Resize", [value.name, roi, scales], node["name"], mode="linear",
                          coordinate_transformation_mode="pytorch_half_pixel")
            return value.like(name=node["name"], stride=value.stride // 2)
        if 2 * height == old_height:
            self.add_node("AveragePool", [value.name], node["name"], kernel_shape=[2, 2],
                          strides=[2, 2])
            return value.like(name=node["name"], stride=value.stride * 2)
        raise ConversionError(f"'{node['name']}' resizes {old_height} to {height} rows")

    def input_height(self):
        for node in self.nodes.values():
            if node["op"] == "Placeholder":
                return int(node["attr"]["shape"]["shape"]["dim"][2]["size"])
        raise ConversionError("the graph has no input")


def level_values(converter):
    """The raw values of each level, finest first: what is split into classes and boxes."""
    levels = [converter.value(node["input"][0]) for node in converter.nodes.values()
              if node["op"] == "SplitV"]
    if not levels:
        raise ConversionError("the graph has no split into classes and boxes; is it a NanoDet?")
    return sorted(levels, key=lambda value: value.stride)


def read_tfjs_model(json_file, width, height):
    """The ONNX model of a tfjs NanoDet for an input of the given size in px."""
    json_file = pathlib.Path(json_file)
    try:
        model = json.loads(json_file.read_text(encoding="utf-8"))
        weights = read_weights(model["weightsManifest"], json_file.parent)
        converter = Converter(model["modelTopology"], weights)
        levels = level_values(converter)
    except (ValueError, KeyError, TypeError, AttributeError, IndexError) as error:
        raise ConversionError(f"{json_file}: not a tfjs graph model of a NanoDet "
                              f"({type(error).__name__}: {error})") from error
    outputs = []
    for level in levels:
        shape = [1, level.channels, height // level.stride, width // level.stride]
        outputs.append(helper.make_tensor_value_info(level.name, TensorProto.FLOAT, shape))
    data = helper.make_tensor_value_info(INPUT_NAME, TensorProto.FLOAT, [1, 3, height, width])
    graph = helper.make_graph(converter.onnx_nodes, "nanodet", [data], outputs,
                              converter.initializers)
    onnx_model = helper.make_model(graph, producer_name="changing-slam",
                                   opset_imports=[helper.make_opsetid("", OPSET)])
    onnx_model.ir_version = IR_VERSION
    onnx.checker.check_model(onnx_model)
    return onnx_model
