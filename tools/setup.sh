#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What demo.sh and test.sh share; sourced by them from the top folder. Needs Debian 12 or newer.

build_packages=(
  cmake ninja-build g++ pkg-config ccache git
  libopencv-dev libeigen3-dev libceres-dev libtbb-dev libfmt-dev libspdlog-dev libcli11-dev
  libyaml-cpp-dev nlohmann-json3-dev libembree-dev libturbojpeg0-dev libpng-dev zlib1g-dev
  libsqlite3-dev)
model_packages=(python3 python3-numpy python3-onnx) # to install a detector
test_packages=(libgtest-dev libgmock-dev python3 clang-format)

say() {
  printf '\n== %s\n' "$*" >&2
}

# Prints those of the given packages that are not installed.
missing_packages() {
  local package
  for package in "$@"; do
    if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      printf '%s\n' "$package"
    fi
  done
}

# Installs the given packages as far as they are missing; asks for nothing when none is.
install_packages() {
  if ! command -v apt-get >/dev/null; then
    say "No apt-get here: assuming that these are installed under your system's names: $*"
    return 0
  fi
  local missing
  mapfile -t missing < <(missing_packages "$@")
  if [ "${#missing[@]}" -eq 0 ]; then
    return 0
  fi
  local as_root=(env)
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "error: these packages are missing, and there is no sudo to install them with." >&2
      echo "As root: apt-get install --no-install-recommends ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo env)
  fi
  say "Installing ${#missing[@]} packages: ${missing[*]}"
  "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get update -qq >&2
  "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
    -o Dpkg::Use-Pty=0 --no-install-recommends "${missing[@]}" >&2
}

# install_detector PROGRAM: once, if there is no model yet. SLAM runs without one, too.
install_detector() {
  local program=$1
  local limit_s=240 # of the 10 minutes a demo may take
  if [ -n "$("$program" model list 2>/dev/null)" ]; then
    return 0
  fi
  say "Fetching a detector of people and things (144.5 MB, once; docs/models.md)"
  local log=build/model_install.log
  timeout "$limit_s" "$program" model install >"$log" 2>&1 </dev/null & # in a group of its own
  local installer=$!
  trap 'kill "$installer"; exit 130' INT TERM
  local status=0
  wait "$installer" || status=$?
  trap - INT TERM
  if [ "$status" -ne 0 ]; then
    grep -a error "$log" | tail -n 1 >&2 || true
    echo "Going on without a detector. Later: $program model install" >&2
  fi
}

# configure_and_build PRESET [TARGET...]: without targets, everything is built.
configure_and_build() {
  local preset=$1
  shift
  local targets=()
  if [ "$#" -gt 0 ]; then
    targets=(--target "$@")
  fi
  say "Configuring and building ($preset)"
  cmake --preset "$preset" --log-level=WARNING >&2
  cmake --build --preset "$preset" --parallel "$(nproc)" "${targets[@]}" >&2
}
