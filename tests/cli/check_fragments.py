#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the command accepts the examples of docs/reference/scenario.md, controllers.md, urdf.md and others:
alone, or in place of the same tables and elements of the scene that a tutorial builds. Their commands run in that
scene, and what README.md shows of it is there.

  check_fragments.py LIMBER SOURCE_FOLDER WORK_FOLDER
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tomllib
import xml.etree.ElementTree

limber, source, work = (pathlib.Path(text).resolve() for text in sys.argv[1:4])
sys.path.insert(0, str(source / "tests/support"))
from page_blocks import read_blocks  # noqa: E402

SCENARIO_PAGES = tuple(source / f"docs/{name}.md" for name in (
    "reference/scenario", "reference/controllers", "how-to/choose_level"))
ROBOT_PAGE = source / "docs/reference/urdf.md"
TUTORIAL = source / "docs/tutorials/catch.md"
SCENARIO, ROBOT = "catch.toml", "gripper.urdf"


def merge(scenario, fragment):
    """Tables replace tables; of arrays of tables those of the same name."""
    merged = dict(scenario)
    for key, value in fragment.items():
        if isinstance(value, list) and isinstance(merged.get(key), list):
            names = {item.get("name") for item in value} - {None}
            kept = [item for item in merged[key] if item.get("name") not in names]
            merged[key] = kept + value
        else:
            merged[key] = value
    return merged


def to_toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(k)} = {to_toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(to_toml, value)) + "]"
    return json.dumps(value)


def name_element(element):
    names = [element.get(key) for key in ("name", "link", "joint")]
    return element.tag, next((name for name in names if name), None)


def merge_robot(robot, fragment):
    """Elements replace those of the same tag and name."""
    merged = xml.etree.ElementTree.fromstring(robot)
    for element in xml.etree.ElementTree.fromstring(f"<robot>{fragment}</robot>"):
        for other in merged.findall(element.tag):
            if name_element(other) == name_element(element):
                merged.remove(other)
        merged.append(element)
    return xml.etree.ElementTree.tostring(merged, encoding="unicode")


def check(file, place):
    result = subprocess.run([limber, "check", file], cwd=work, capture_output=True, text=True,
                            env={**os.environ, "LIMBER_CACHE": str(work / "cache")})
    if result.returncode != 0:
        return [f"{place}: status {result.returncode}: {result.stderr}"]
    return [f"{place}: {text}" for text in result.stdout.splitlines()
            if text.startswith("problem")]


def check_scenario(page, block, scenario):
    fragment = tomllib.loads(block.text)
    if block.values["fragment"] != "alone":
        fragment = merge(scenario, fragment)
    file = work / f"{page.stem}_{block.line}.toml"
    file.write_text("".join(f"{key} = {to_toml(value)}\n" for key, value in fragment.items()))
    return check(file, f"{page.relative_to(source)}:{block.line}")


def check_robot(page, block, robot):
    name = f"line_{block.line}"
    (work / f"{name}.urdf").write_text(merge_robot(robot, block.text))
    file = work / f"{name}_robot.toml"
    file.write_text(f'robot = "{name}.urdf"\n[time]\nduration = 0.01\nstep = 1e-3\n')
    return check(file, f"{page.relative_to(source)}:{block.line}")


def run_commands(page):
    """Those of a page of the scenario's reference, in the tutorial's scene."""
    for block in read_blocks(page):
        if block.language == "sh":
            (work / "limber").unlink(missing_ok=True)
            (work / "limber").symlink_to(limber)
            result = subprocess.run(["bash", "-euc", block.text], cwd=work, capture_output=True, text=True, env={
                **os.environ, "LIMBER_CACHE": str(work / "cache"), "PATH": f"{work}:{os.environ['PATH']}"})
            if result.returncode != 0:
                yield f"{page.relative_to(source)}:{block.line}: status {result.returncode}: {result.stderr}"


def check_readme(scenario):
    """Each line of its part of the scenario is one of the tutorial's, but for comments."""
    def split(text):
        return [line.partition("#")[0].rstrip() for line in text.splitlines()]
    lines = [line for block in read_blocks(source / "README.md") if block.language == "toml"
             for line in split(block.text)]
    return [f"README.md: not in {TUTORIAL.relative_to(source)}: {line}"
            for line in lines or ["a block of toml"] if line not in split(scenario)]


def main():
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    for block in read_blocks(TUTORIAL):
        if "file" in block.values:
            (work / block.values["file"]).write_text(block.text)
    scenario = tomllib.loads((work / SCENARIO).read_text())
    robot = (work / ROBOT).read_text()
    problems, count = [], 0
    for page, function, scene in (*((page, check_scenario, scenario) for page in SCENARIO_PAGES),
                                  (ROBOT_PAGE, check_robot, robot)):
        for block in read_blocks(page):
            if "fragment" in block.values:
                count += 1
                problems += function(page, block, scene)
    problems += [*run_commands(SCENARIO_PAGES[0]), *check_readme((work / SCENARIO).read_text())]
    if count < 20:
        problems.append("the examples were not found")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{count} examples")


main()
