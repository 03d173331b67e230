#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds with warnings as errors, and runs all tests.
#   ./test.sh [ctest options]      e.g. ./test.sh -L unit
set -euo pipefail
cd "$(dirname "$0")"
. tools/setup.sh

install_packages "${build_packages[@]}" "${test_packages[@]}" "${model_packages[@]}"
configure_and_build ci
say "Testing"
log=build/test/ctest.log
status=0
ctest --preset ci --no-tests=error --parallel "$(nproc)" "$@" | tee "$log" || status=$?
grep 'tests passed' "$log" || true # once more: below it ctest lists what was skipped
exit "$status"
