#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Writes docs/config.md from the program's own list of options, or with --check compares only.
#   tools/config_docs.sh [--check] path/to/changing-slam
set -euo pipefail
root=$(dirname "$0")/..

if [ "${1:-}" = --check ]; then
  if ! "$2" config --markdown | diff -u "$root/docs/config.md" - >&2; then
    echo "docs/config.md is out of date; run: tools/config_docs.sh $2" >&2
    exit 1
  fi
else
  page=$("$1" config --markdown)
  printf '%s\n' "$page" > "$root/docs/config.md"
fi
