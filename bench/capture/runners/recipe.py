# SPDX-License-Identifier: BSD-3-Clause
"""What both runners share: the protocol around a recipe, a Python file in the case's folder.

A recipe has VARIANTS, a tuple of names, or REASON, why the tool cannot express the case; and
measure(tool, variant) -> (answers, curve): {quantity: value in its unit}, and (x, y) or None.
"""
import argparse
import importlib.util
import json
import pathlib
import resource
import shutil
import subprocess

POINTS = 400  # of a curve, at least


class Failed(Exception):
    """A tool that gave no answer; its error message."""


class Unavailable(Exception):
    """A tool that is not installed."""


def call(command, folder=None):
    """What a program printed in a working folder, and its processor time [s], of all that it started too."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [str(c) for c in command], capture_output=True, text=True, check=False, cwd=folder
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise Failed(done.stderr.strip())
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.stdout, seconds


def read_columns(lines, width):
    """Columns of numbers, separated by commas."""
    columns = [[] for _ in range(width)]
    for line in lines:
        for column, cell in zip(columns, line.split(",")):
            column.append(float(cell))
    return columns


def load(case, file):
    """The recipe, or None."""
    path = case / file
    if not path.is_file():
        return None
    spec = importlib.util.spec_from_file_location("case_recipe", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def find_variants(recipe):
    if recipe is None:
        return [], "nobody has written it for this tool"
    return list(getattr(recipe, "VARIANTS", ())), getattr(recipe, "REASON", "")


def answer(tool_class, recipe, options):
    if options.fresh:
        shutil.rmtree(options.work, ignore_errors=True)
    options.work.mkdir(parents=True, exist_ok=True)
    tool = tool_class(options.case, options.work)
    try:
        answers, curve = recipe.measure(tool, options.variant)
    except Failed as error:
        return {"status": "failed", "reason": str(error)}
    found = {"status": "answered", "answers": answers, "cpu_s": tool.cpu_s}
    if tool.simulated_s > 0:
        found["simulated_s"] = tool.simulated_s
    if curve is not None:
        every = max(1, len(curve[0]) // POINTS)
        found["curve"] = {
            "x": [float(f"{x:.6g}") for x in curve[0][::every]],
            "y": [float(f"{y:.6g}") for y in curve[1][::every]],
        }
    return found


def main(name, file, find_version, tool_class):
    parser = argparse.ArgumentParser(description=f"Answers cases of the bench by {name}")
    commands = parser.add_subparsers(dest="command", required=True)
    lister = commands.add_parser("list")
    runner = commands.add_parser("run")
    for sub in (lister, runner):
        sub.add_argument("case", type=lambda text: pathlib.Path(text).resolve())
    runner.add_argument("variant")
    runner.add_argument("--work", type=lambda text: pathlib.Path(text).resolve(), required=True)
    runner.add_argument("--out", type=pathlib.Path, required=True)
    runner.add_argument("--fresh", action="store_true")
    options = parser.parse_args()
    recipe = load(options.case, file)
    variants, reason = find_variants(recipe)
    if options.command == "list":
        try:
            version = find_version()
        except Unavailable as error:
            version, variants, reason = "not installed", [], str(error)
        print(json.dumps({"tool": name, "version": version, "variants": variants, "reason": reason}))
        return
    if options.variant not in variants:
        parser.error(f"{options.case.name}: {name} has no variant '{options.variant}'")
    found = answer(tool_class, recipe, options)
    options.out.write_text(json.dumps(found), encoding="utf-8")
