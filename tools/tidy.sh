#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Lints with clang-tidy 14 (Debian: apt-get install clang-tidy). Slow: about 5 s a file.
#   tools/tidy.sh BUILD_DIR [FILE...]     without files: all sources but the tests
set -euo pipefail
build=${1:?usage: tools/tidy.sh BUILD_DIR [FILE...]}
shift
root=$(cd "$(dirname "$0")/.." && pwd)

files=("$@")
if [ "${#files[@]}" -eq 0 ]; then
  mapfile -t files < <(find "$root/src" "$root/apps" -name '*.cpp' ! -name '*_test.cpp' | sort)
fi
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p "$build" --quiet \
  --extra-arg="-include$root/tools/tidy/source_location.h" 2> >(grep -v 'warnings\? generated\|^Suppressed\|^Use -header' >&2)
