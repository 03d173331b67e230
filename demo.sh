#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds the program, fetches a detector if there is none, and runs SLAM on a
# sequence: a folder in the layout of the TUM RGB-D benchmark, or, without one, a tour of a room that
# is rendered here once.
#   ./demo.sh [SEQUENCE [options of 'changing-slam run']]
set -euo pipefail
case ${1:-} in
  -h | --help)
    sed -n '3,6s/^# //p' "$0"
    exit 0
    ;;
esac
sequence=
if [ "$#" -gt 0 ]; then
  sequence=$(realpath -m -- "$1")
  if [ ! -d "$sequence" ]; then # before minutes of building
    echo "error: there is no folder '$1'" >&2
    exit 1
  fi
  shift
fi
called_from=$PWD
cd "$(dirname "$0")"
root=$PWD
. tools/setup.sh

install_packages "${build_packages[@]}" "${model_packages[@]}"
configure_and_build release changing_slam
program=$root/build/release/changing-slam
install_detector "$program"

if [ -z "$sequence" ]; then
  sequence=$root/data/demo
  if [ ! -f "$sequence/camera.yaml" ]; then # written last: the sequence is complete
    say "Rendering a sequence into $sequence"
    mkdir -p data
    "$program" dataset render demo --fps 15 --out "$sequence" --force
  fi
fi

out=$root/runs/$(basename "$sequence")
say "Running on $sequence"
cd "$called_from" # what the options name is meant from there
"$program" run "$sequence" --out "$out" "$@"
say "Plot of the trajectory (open it in a browser): $out/trajectory.svg"
