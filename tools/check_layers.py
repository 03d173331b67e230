#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Checks the rules of ARCHITECTURE.md that a compiler does not: who includes whom, where threads
and heavy third-party headers may appear, and that every file names its licence.

Usage: check_layers.py [ROOT]   prints file:line: complaint; exit 1 if there is any.
"""

import pathlib
import re
import sys

# Folder -> folders below it that it may include. Each may include itself as well.
LOW = {"util", "geometry", "vision"}
STAGE = LOW | {"map", "semantics", "objects", "messages", "optim"}
LAYERS = {
    "util": set(),
    "geometry": {"util"},
    "vision": {"util", "geometry"},
    "map": LOW,
    "navigation": LOW | {"map"},
    "optim": {"util", "geometry"},
    "io": LOW | {"map"},
    "atlas_io": LOW | {"map", "io"},
    "eval": LOW | {"map"},
    "sim": LOW | {"map", "io"},
    "assets": LOW | {"map", "io", "sim"},
    "actors": LOW | {"map", "io", "sim", "assets"},
    "dataset": LOW | {"map", "io", "sim", "assets", "actors"},
    "scene_eval": LOW | {"map", "io", "eval", "semantics", "sim", "assets", "actors", "dataset"},
    "benchmark": LOW | {"map", "io", "eval", "semantics", "sim", "assets", "actors", "dataset",
                        "scene_eval"},
    "semantics": LOW | {"map", "io"},
    "objects": LOW | {"map", "semantics"},
    "messages": LOW | {"map", "semantics", "objects"},
    "tracking": STAGE,
    "mapping": STAGE,
    "loop": STAGE,
    "pipeline": STAGE | {"tracking", "mapping", "loop", "navigation", "io", "atlas_io", "eval"},
    "run": STAGE | {"pipeline", "navigation", "io", "atlas_io", "eval"},
    "viewer": STAGE | {"pipeline", "run", "io", "eval"},
}
TEST_ALSO = {"loop": {"mapping"}}  # tests of these folders: a loop is tested as it is applied
TEST_TOOLS = {"io", "eval", "sim", "assets", "actors", "dataset"}  # tests of any layer may use these

THREAD_FILES = {  # all others are synchronous
    "src/cslam/util/channel.h",
    "src/cslam/util/gate.h",
    "src/cslam/util/latest.h",
    "src/cslam/pipeline/threaded_executor.cpp",
    "src/cslam/pipeline/threaded_stages.h",
    "src/cslam/pipeline/threaded_stages.cpp",
    "src/cslam/run/map_saver.h",
    "src/cslam/run/map_saver.cpp",
    "src/cslam/run/sequence_player.cpp",
    "src/cslam/sim/resting_cache.h",
    "src/cslam/sim/resting_cache.cpp",
    "src/cslam/dataset/sequence_writer.cpp",
    "apps/interrupt.cpp",
}
THREADS = re.compile(
    r"\bstd::(mutex|shared_mutex|recursive_mutex|thread|jthread|atomic\w*|condition_variable\w*"
    r"|async|future|promise|latch|barrier|counting_semaphore|call_once|once_flag)\b")
PACING_FILES = {"src/cslam/run/sequence_player.cpp"}  # plays recordings by their timestamps
SLEEPS = re.compile(r"\b(sleep_for|sleep_until|usleep|nanosleep)\b")
CONSOLE = re.compile(r"\bstd::(cout|cerr|clog)\b")

# Third-party prefix -> folders of src/cslam whose .cpp files may include it; headers may not.
PRIVATE_LIBRARIES = {
    "ceres/": {"optim"},
    "embree3/": {"sim"},
    "yaml-cpp/": {"io"},
    "sqlite3": {"atlas_io"},
    "nlohmann/": {"io", "eval", "scene_eval", "benchmark", "atlas_io", "pipeline"},
    "CLI/": set(),
    "opencv2/dnn": {"semantics"},
    "opencv2/imgproc": None,  # None: the .cpp files of every folder
    "opencv2/features2d": None,
    "opencv2/imgcodecs": None,
}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]')
SOURCES = {".h", ".cpp"}
FOLDERS = ["src", "apps", "tests", "bench", "examples", "tools", "cmake"]


def is_test_header(path):
    """Whether it holds what several tests share."""
    return path.suffix == ".h" and path.stem.startswith("test_")


def check_include(rel, layer, is_test, target):
    """The complaint about one include of a file in src/cslam/<layer>, or None."""
    match = re.match(r"cslam/(\w+)/", target)
    if match:
        other = match.group(1)
        allowed = LAYERS[layer] | {layer} | (
            TEST_TOOLS | TEST_ALSO.get(layer, set()) if is_test else set())
        if other not in LAYERS:
            return f"unknown layer '{other}'; add it to tools/check_layers.py"
        if other not in allowed:
            return f"{layer} must not include {other}"
        return None
    for prefix, folders in PRIVATE_LIBRARIES.items():
        if not target.startswith(prefix):
            continue
        if rel.suffix == ".h":
            return f"<{target}> belongs into a .cpp file"
        if folders is not None and layer not in folders and not is_test:
            return f"<{target}> is not for {layer}"
    return None


def check_licence(lines):
    head = "\n".join(lines[:3])
    if "SPDX-FileCopyrightText:" in head and "SPDX-License-Identifier: Apache-2.0" in head:
        return None
    return "the two SPDX lines are missing at the top"


def check_source(root, rel):
    """Yields (line number, complaint) for one C++ file."""
    lines = (root / rel).read_text(encoding="utf-8").splitlines()
    is_test = (rel.stem.endswith("_test") or is_test_header(rel)
               or rel.parts[0] in {"tests", "bench"})
    in_library = rel.parts[:2] == ("src", "cslam")
    layer = rel.parts[2] if in_library else None
    if in_library and layer not in LAYERS:
        yield 1, f"unknown layer '{layer}'; add it to tools/check_layers.py"
        return
    complaint = check_licence(lines)
    if complaint:
        yield 1, complaint
    if rel.suffix == ".h" and "#pragma once" not in lines:
        yield 1, "#pragma once is missing"
    for number, line in enumerate(lines, 1):
        include = INCLUDE.match(line)
        if include and in_library:
            target = include.group(1)
            complaint = check_include(rel, layer, is_test, target)
            if not is_test and is_test_header(pathlib.PurePosixPath(target)):
                complaint = f"<{target}> is for tests"
            if complaint:
                yield number, complaint
        code = line.split("//")[0]
        if rel.as_posix() not in PACING_FILES and SLEEPS.search(code):
            yield number, "nothing sleeps here; wait for an event"
        if not is_test and rel.as_posix() not in THREAD_FILES and THREADS.search(code):
            yield number, "threads and locks live in the files of THREAD_FILES only"
        if in_library and CONSOLE.search(code):
            yield number, "only apps/ writes to the console"


def check_text(root, rel):
    """Yields (line number, complaint) for a script or CMake file."""
    lines = (root / rel).read_text(encoding="utf-8").splitlines()
    if "SPDX-License-Identifier: Apache-2.0" not in "\n".join(lines[:3]):
        yield 1, "the SPDX licence line is missing at the top"


def find_files(root):
    for folder in FOLDERS:
        yield from sorted(p for p in (root / folder).rglob("*") if p.is_file())
    yield from sorted(p for p in root.iterdir() if p.is_file())


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[1])
    num_checked = 0
    num_complaints = 0
    for path in find_files(root):
        rel = path.relative_to(root)
        if rel.suffix in SOURCES:
            complaints = check_source(root, rel)
        elif rel.suffix in {".py", ".sh", ".cmake"} or rel.name == "CMakeLists.txt":
            complaints = check_text(root, rel)
        else:
            continue
        num_checked += 1
        for number, complaint in complaints:
            print(f"{rel.as_posix()}:{number}: {complaint}")
            num_complaints += 1
    print(f"{num_checked} files checked, {num_complaints} complaints", file=sys.stderr)
    if num_checked == 0:
        print(f"no sources under '{root}'", file=sys.stderr)
    return 1 if num_complaints or num_checked == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
