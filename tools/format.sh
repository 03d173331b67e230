#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Formats all C++ files in place, or with --check only lists what would change (exit 1).
# Another clang-format than 14 lays code out differently and is refused (exit 77: "skipped").
set -euo pipefail
cd "$(dirname "$0")/.."

formatter=
for candidate in clang-format-14 clang-format; do
  if "$candidate" --version 2>/dev/null | grep -q 'version 14\.'; then
    formatter=$candidate
    break
  fi
done
if [ -z "$formatter" ]; then
  echo "skipped: clang-format 14 is not installed (Debian 12: apt-get install clang-format)" >&2
  exit 77
fi

mapfile -t files < <(find src apps tests bench examples \( -name '*.h' -o -name '*.cpp' \) | sort)
if [ "${1:-}" = --check ]; then
  changed=0
  for file in "${files[@]}"; do
    if ! "$formatter" --dry-run --Werror "$file" 2>/dev/null; then
      echo "$file: not as clang-format lays it out; run tools/format.sh"
      changed=1
    fi
  done
  exit "$changed"
fi
"$formatter" -i "${files[@]}"
