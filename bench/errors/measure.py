#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Judges `limber run --errors`: stated errors beside true ones.

    bench/errors/measure.py --limber build/release/src/app/limber SCENARIO ...

The true error of a probe is its difference from a run that is far finer in
everything at once: an eighth of the step or a thousandth of the tolerance,
twice the eigenmodes and ten more, meshes of geometries one order higher or
half as large, four times the impact steps, the level above. Prints one line a
scene, then the shares of probes whose true error is below three times the
stated one, and whose stated one is at most ten times the true one; true errors
below 1e-6 of the largest peak of that unit, as across a plane of symmetry, are left out.
"""
import argparse
import bisect
import csv
import json
import math
import pathlib
import re
import shutil
import subprocess
import tempfile
import tomllib

LEVELS = ["rigid", "uncoupled", "one-way", "coupled", "nonlinear"]


def run(limber, scenario, out, *more):
    command = [limber, "run", scenario, "--out", out, "--json", "-q", *more]
    done = subprocess.run([str(x) for x in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip().splitlines()[-1])
    return json.loads(done.stdout)


def read_curves(folder):
    with open(folder / "probes.csv", newline="") as file:
        rows = list(csv.reader(file))
    names = [name.rsplit(" [", 1)[0] for name in rows[0]]
    columns = zip(*[[float(x) for x in row] for row in rows[1:]])
    return dict(zip(names, columns))


def pick(curves, name, times):
    """Values at these times, between outputs, which may be more, by a line."""
    own, values = curves["time"], curves[name]
    picked = []
    for time in times:
        i = min(max(bisect.bisect_left(own, time), 1), len(own) - 1)
        share = (time - own[i - 1]) / (own[i] - own[i - 1])
        picked.append(values[i - 1] + share * (values[i] - values[i - 1]))
    return picked


def read_peaks(folder):
    if not (folder / "peaks.csv").exists():
        return {}  # of a scene without probes
    with open(folder / "peaks.csv", newline="") as file:
        return {row["name"]: row for row in csv.DictReader(file)}


def refine_robot(text):
    """More modes, finer geometries, no level of its own."""
    text = re.sub(
        r'eigenmodes="(\d+)"', lambda m: f'eigenmodes="{2 * int(m[1]) + 10}"', text
    )

    def refine_mesh(match):
        mesh = match[0]
        if not re.search(r'file="[^"]*\.(geo|step|stp|brep|iges)"', mesh):
            return mesh
        if size := re.search(r'size="([^"]+)"', mesh):
            return mesh.replace(size[0], f'size="{float(size[1]) / 2}"')
        return mesh if "order=" in mesh else mesh.replace("<mesh ", '<mesh order="2" ')

    return re.sub(r"<mesh [^>]*>", refine_mesh, text)


def refine_scenario(scenario):
    """What `--set` changes, and the level above."""
    scene = tomllib.loads(scenario.read_text())
    time = scene.get("time", {})
    changes = []
    if "tolerance" in time:
        changes.append(f"time.tolerance={time['tolerance'] / 1000}")
    if "step" in time:
        changes.append(f"time.step={time['step'] / 8}")
    if "steps" in time:
        sizes = time["steps"]["size"]
        changes += [f"time.steps.size.{k}={s / 8}" for k, s in enumerate(sizes)]
    if "contact" in scene:
        changes.append(f"time.impact_steps={4 * time.get('impact_steps', 20)}")
    level = scene.get("fidelity", {}).get("level", "coupled")
    if level in LEVELS:
        level = LEVELS[max(LEVELS.index("coupled"), LEVELS.index(level)) + 1 :][:1]
    options = [x for change in changes for x in ("--set", change)]
    return options + (["--fidelity", level[0]] if isinstance(level, list) and level else [])


def compare(limber, scenario, place):
    """@returns [(name, true, stated)], of curves and peaks."""
    copy = place / "copy"
    root = scenario.parent.parent
    hidden = shutil.ignore_patterns("build", ".git", "page")
    shutil.copytree(root, copy, ignore=hidden)
    for robot in copy.rglob("*.urdf"):
        robot.write_text(refine_robot(robot.read_text()))
    stated = run(limber, scenario, place / "stated", "--errors")["errors"]["probes"]
    finer = copy / scenario.relative_to(root)
    options = refine_scenario(scenario)
    has_flexible = "modes" in json.dumps(next(iter(stated.values()), {}))
    if not has_flexible and "--fidelity" in options:
        options = options[: options.index("--fidelity")]
    run(limber, finer, place / "true", *options)
    curves, true_curves = read_curves(place / "stated"), read_curves(place / "true")
    peaks, true_peaks = read_peaks(place / "stated"), read_peaks(place / "true")
    largest = {}
    for row in peaks.values():
        size = abs(float(row["peak"]))
        largest[row["unit"]] = max(largest.get(row["unit"], 0.0), size)
    pairs = []
    for name, errors in stated.items():
        total = errors["total"]
        floor = 1e-6 * largest[errors["unit"]]
        for kind in ("curve", "peak"):
            if kind == "curve":
                both = zip(curves[name], pick(true_curves, name, curves["time"]))
                true = max(abs(a - b) for a, b in both)
            else:
                sizes = [abs(float(p[name]["peak"])) for p in (peaks, true_peaks)]
                true = abs(sizes[0] - sizes[1])
            if total.get(kind) is None or not true > floor:
                continue
            pairs.append((f"{name} {kind}", true, total[kind]))
    return pairs


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--limber", type=pathlib.Path, required=True)
    parser.add_argument("--verbose", action="store_true", help="also each probe")
    parser.add_argument("scenarios", type=pathlib.Path, nargs="+")
    options = parser.parse_args()
    everything = []
    for scenario in options.scenarios:
        with tempfile.TemporaryDirectory() as folder:
            try:
                pairs = compare(
                    options.limber.resolve(), scenario.resolve(), pathlib.Path(folder)
                )
            except (RuntimeError, subprocess.SubprocessError) as error:
                print(f"{scenario}: {error}", flush=True)
                continue
        safe = sum(true <= 3 * stated for _, true, stated in pairs)
        tight = sum(stated <= 10 * true for _, true, stated in pairs)
        print(
            f"{scenario}: {len(pairs)}, safe {safe}, tight {tight}", flush=True
        )
        if options.verbose:
            for name, true, stated in pairs:
                ratio = true / stated if stated > 0 else math.inf
                print(f"  {name:28} true {true:9.3g} stated {stated:9.3g} {ratio:9.2f}")
        everything += pairs
    count = max(len(everything), 1)
    safe = sum(true <= 3 * stated for _, true, stated in everything) / count
    tight = sum(stated <= 10 * true for _, true, stated in everything) / count
    print(f"all {len(everything)}: true <= 3 stated {safe:.0%}, stated <= 10 true {tight:.0%}")


if __name__ == "__main__":
    main()
