#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders short sequences, a frame a second, and makes their contact sheets into the pictures of
# the README. Needs the models and textures of docs/assets.md, and netpbm.
#   tools/readme_sheets.sh PROGRAM      after ./demo.sh: tools/readme_sheets.sh build/release/changing-slam
set -euo pipefail
program=$(realpath -- "${1:?which changing-slam?}")
cd "$(dirname "$0")/.."

sequences=(replacing walking_xyz office_day)
width_px=960
"$program" dataset render "${sequences[@]}" --short --fps 1 --look packages --out data/sheets --force
for name in "${sequences[@]}"; do
  pngtopnm "data/sheets/$name/contact_sheet.png" | pamscale -width "$width_px" |
    pnmtojpeg -quality 80 -optimize >"docs/images/$name.jpg"
done
