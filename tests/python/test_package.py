# SPDX-License-Identifier: BSD-3-Clause
"""Stubs, docstrings, values as TOML, and installation by pip."""

import ast
import importlib.util
import inspect
import os
import pathlib
import shutil
import subprocess
import sys

import pytest
from conftest import SOURCE

import limber
from limber import _core
from limber.toml import to_toml


def make_stubs():
    # By its path: the folder would give processes that are started a package
    # without its compiled part.
    spec = importlib.util.spec_from_file_location(
        "make_stubs", SOURCE / "python/make_stubs.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.make()


def test_the_stubs_are_those_of_the_module_and_python():
    stubs = (SOURCE / "python/limber/_core.pyi").read_text()
    ast.parse(stubs)
    assert stubs == make_stubs(), "run python/make_stubs.py"


def test_everything_public_has_a_docstring():
    missing = []
    for name in limber.__all__:
        value = getattr(limber, name)
        if not (inspect.isclass(value) or inspect.isroutine(value)):
            continue
        if not inspect.getdoc(value) and not name.endswith("Index"):
            missing.append(name)
        if inspect.isclass(value) and value.__module__.startswith("limber."):
            if value.__module__ == _core.__name__:
                continue
            missing += [f"{name}.{key}" for key, member in vars(value).items()
                        if not key.startswith("_")
                        and (inspect.isfunction(member) or isinstance(member, property))
                        and not inspect.getdoc(member)]
    assert missing == []


@pytest.mark.parametrize("value, text", [
    (1, "1"), (True, "true"), (0.1, "0.1"), (1e300, "1e+300"), (float("-inf"), "-inf"),
    ("a \"b\"\n", '"a \\"b\\"\\n"'), ([1, 2.5], "[1, 2.5]"), ((1,), "[1]"),
    ({"kind": "ramp", "to": 1.0}, '{"kind" = "ramp", "to" = 1.0}'),
])
def test_values_are_toml(value, text):
    assert to_toml(value) == text


def test_pip_installs_it_without_a_network(tmp_path):
    pip = shutil.which("pip3", path="/usr/bin")
    if pip is None:
        pytest.skip("there is no pip (Debian's python3-pip)")
    target = tmp_path / "site"
    # The build folder is given, so that nothing is compiled again.
    environment = dict(os.environ, LIMBER_BUILD=os.environ["LIMBER_BUILD"])
    environment.pop("PYTHONPATH")
    installed = subprocess.run(
        [sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--target",
         target, SOURCE], env=environment, capture_output=True, text=True, cwd=tmp_path)
    cache = pathlib.Path(os.environ["LIMBER_BUILD"], "CMakeCache.txt").read_text()
    if "BUILD_SHARED_LIBS:BOOL=ON" in cache:
        assert installed.returncode != 0
        assert "expected one with BUILD_SHARED_LIBS=OFF" in installed.stderr
        return
    assert installed.returncode == 0, installed.stderr
    environment["PYTHONPATH"] = str(target)
    environment.pop("LIMBER_BUILD")
    found = subprocess.run(
        [sys.executable, "-c", "import limber; print(limber.__file__)"], check=True,
        env=environment, capture_output=True, text=True, cwd=tmp_path).stdout
    assert pathlib.Path(found.strip()).parent == target / "limber"
    assert (target / "limber/limber-mesh").exists()
