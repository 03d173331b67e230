#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds the program, and runs SLAM on a sequence: a folder in the
# layout of the TUM RGB-D benchmark, or, without one, a short sequence rendered here.
#   ./demo.sh [SEQUENCE [options of 'changing-slam run']]
set -euo pipefail
sequence=
if [ "$#" -gt 0 ]; then
  sequence=$(realpath -m -- "$1")
  shift
fi
cd "$(dirname "$0")"
. tools/setup.sh

install_packages "${build_packages[@]}"
configure_and_build release changing_slam
program=build/release/changing-slam

if [ -z "$sequence" ]; then
  sequence=data/demo
  if [ ! -d "$sequence" ]; then
    say "Rendering a sequence into $sequence"
    mkdir -p data
    rm -rf "$sequence.part"
    "$program" dataset render demo --out "$sequence.part"
    mv "$sequence.part" "$sequence"
  fi
fi

out=runs/$(basename "$sequence")
say "Running on $sequence"
"$program" run "$sequence" --out "$out" "$@"
say "Trajectory plot (open it in a browser): $out/trajectory.svg"
