#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Makes a sequence of a lower frame rate: every N-th frame of another, without copying pictures.

    tools/thin_sequence.py SEQUENCE OUT --every 6      # 30 Hz to 5 Hz

Everything but the lists of pictures is a link into SEQUENCE.
"""

import argparse
import pathlib
import sys


def thin(path, every):
    lines = path.read_text().splitlines()
    comments = [line for line in lines if line.startswith("#")]
    frames = [line for line in lines if line and not line.startswith("#")]
    return "\n".join(comments + frames[::every]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sequence", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--every", type=int, default=6, metavar="N")
    arguments = parser.parse_args()
    if arguments.every < 1:
        parser.error("--every must be at least 1")
    if not (arguments.sequence / "rgb.txt").exists():
        sys.exit(f"error: no rgb.txt in '{arguments.sequence}'")
    arguments.out.mkdir(parents=True)
    for entry in sorted(arguments.sequence.iterdir()):
        if entry.name in ("rgb.txt", "depth.txt", "associations.txt"):
            (arguments.out / entry.name).write_text(thin(entry, arguments.every))
        else:
            (arguments.out / entry.name).symlink_to(entry.resolve())


if __name__ == "__main__":
    main()
