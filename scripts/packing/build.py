# SPDX-License-Identifier: BSD-3-Clause
"""Compiles Limber as packages need it, and installs its components into folders."""
import datetime
import os
import pathlib
import re
import shutil
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
# As a processor without AVX would do it, so that shipped bodies have the same bits
# wherever they are made.
PLAIN_ARITHMETIC = {"OPENBLAS_NUM_THREADS": "1", "OPENBLAS_CORETYPE": "Nehalem",
                    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F"}


def read_project(pattern):
    return re.search(pattern, (SOURCE / "CMakeLists.txt").read_text(), re.M).group(1)


VERSION = read_project(r"^project\(limber VERSION ([\d.]+)")
RELEASED = read_project(r"^set\(LIMBER_RELEASED ([\d-]+)\)")


def find_epoch():
    """The time of every file in a package: the day of this version."""
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if given:
        return int(given)
    day = datetime.date.fromisoformat(RELEASED)
    return int(datetime.datetime.combine(
        day, datetime.time(), datetime.timezone.utc).timestamp())


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, **options)


def read(*command, **options):
    return run(*command, stdout=subprocess.PIPE, text=True, **options).stdout


class Builds:
    """Folders of the two builds: all of Limber, and the Python module without GPL parts."""

    def __init__(self, folder):
        self.whole = folder / "package"
        self.free = folder / "package-bsd"

    @property
    def has_playground(self):
        return (self.whole / "src/app/playground.wasm").exists()


def configure(folder, *options):
    run("cmake", "-S", SOURCE, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_INSTALL_PREFIX=/usr", "-DLIMBER_TESTS=OFF",
        "-DLIMBER_PYTHON=ON", "-DLIMBER_PYTHON_DIR=lib/python3/dist-packages",
        "-DPython_EXECUTABLE=/usr/bin/python3", *options, stdout=subprocess.DEVNULL)


def compile_all(folder, has_wheel):
    builds = Builds(folder)
    configure(builds.whole)
    run("cmake", "--build", builds.whole)
    if not (builds.whole / "src/app/view.html").exists():
        sys.exit("package: the build has no page of limber view; it said what it lacks")
    compile_playground(builds.whole / "src/app")
    if has_wheel:
        configure(builds.free, "-DLIMBER_REDUCTION=OFF", "-DLIMBER_REFERENCE=OFF")
        run("cmake", "--build", builds.free, "--target", "limber_python")
    return builds


def compile_playground(folder):
    """The module of limber view --play, where its compiler is installed."""
    if shutil.which("emcc") is None:
        for name in ("js", "wasm"):  # of other sources
            (folder / f"playground.{name}").unlink(missing_ok=True)
        print("package: without the module of limber view --play, which needs emscripten "
              "(scripts/install-deps --with-playground)")
        return
    run(SOURCE / "scripts/playground", folder, stdout=subprocess.DEVNULL)


def install(build, component, root):
    """Into root/usr, stripped."""
    run("cmake", "--install", build, "--component", component, "--strip", "--prefix", "/usr",
        env=dict(os.environ, DESTDIR=str(root)), stdout=subprocess.DEVNULL)


def ship_bodies(build, root, work, examples="*"):
    """Reduces the bodies of examples, for root/usr/share/limber/bodies."""
    share = root / "usr/share/limber"
    bodies = share / "bodies"
    if not (work / "bodies").exists():
        scenarios = sorted(file for file in (share / "examples").glob(f"{examples}.toml")
                           if not file.stem.endswith("_study"))
        run(build / "src/app/limber", "__ship", "--cache", work / "cache", work / "bodies",
            *scenarios, env=dict(os.environ, **PLAIN_ARITHMETIC))
        run("sh", "-c", 'cp "$1"/*.h5 "$2"', "sh", work / "cache", work / "bodies")
    run("cp", "-r", work / "bodies", bodies)
    for file in bodies.iterdir():
        file.chmod(0o644)
    bodies.chmod(0o755)
