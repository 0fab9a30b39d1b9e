# SPDX-License-Identifier: BSD-3-Clause
"""`pip install .`: builds the Python module by CMake. Needs what
scripts/install-deps installs, and no network (docs/reference/python.md)."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent


class BuildByCMake(build_ext):
    """Builds target limber_python and packs its component.

    LIMBER_BUILD names a build folder that has it already, with static libraries."""

    def build_extension(self, ext):
        build = os.environ.get("LIMBER_BUILD")
        if not build:
            build = SOURCE / "build" / "pip"
            subprocess.run(
                ["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja",
                 "-DCMAKE_BUILD_TYPE=Release", "-DLIMBER_PYTHON=ON",
                 "-DLIMBER_TESTS=OFF", "-DLIMBER_REFERENCE=OFF",
                 f"-DPython_EXECUTABLE={sys.executable}"], check=True)
            subprocess.run(["cmake", "--build", build, "--target", "limber_python"],
                           check=True)
        elif has_shared_libraries(build):
            sys.exit(f"LIMBER_BUILD: '{build}' has shared libraries, which are no part of"
                     " a Python package; expected one with BUILD_SHARED_LIBS=OFF")
        with tempfile.TemporaryDirectory() as place:
            subprocess.run(["cmake", "--install", build, "--component", "python",
                            "--prefix", place], check=True)
            made = next(pathlib.Path(place).glob("**/limber"))
            to = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
            shutil.copytree(made, to, dirs_exist_ok=True)


def has_shared_libraries(build):
    cache = pathlib.Path(build, "CMakeCache.txt").read_text()
    return "BUILD_SHARED_LIBS:BOOL=ON" in cache


def read_version():
    for line in (SOURCE / "CMakeLists.txt").read_text().splitlines():
        if line.startswith("project(limber VERSION"):
            return line.split()[2]
    raise RuntimeError("CMakeLists.txt has no version")


setup(
    name="limber",
    version=read_version(),
    description="Simulates arms that bend",
    license="BSD-3-Clause",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["limber"],
    package_dir={"limber": "python/limber"},
    ext_modules=[Extension("limber._core", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
)
