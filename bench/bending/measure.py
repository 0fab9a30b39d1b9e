#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bends, compresses, spins and strikes bars; writes a page with pictures.

    bench/bending/measure.py --limber build/release/src/app/limber [--out FOLDER]
"""
import argparse
import csv
import json
import math
import pathlib
import resource
import shutil
import subprocess

import page

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
EI = 2e11 * 0.05**4 / 12  # of the bar's section, 1 m^-2 [N m^2]
EULER = math.pi**2 * EI / 4  # of the bar, held at one end [N]
PRINCETON = 13.345  # N
SIDE = math.sqrt(0.5) * PRINCETON
LEVELS = ("coupled", "nonlinear", "two pieces", "full")  # two pieces at nonlinear
REDUCED = LEVELS[:3]
WHOLE = LEVELS[:2]

# Name, scene, force on the tip [N], errors of `nonlinear` that were aimed at in one
# piece and in two [%].
BENT = (
    ("bent to 20 %", "bar", (0, 0, 0.2065 * 3 * EI), 0.3, 0.1),
    ("bent to 40 %", "bar", (0, 0, 0.465 * 3 * EI), 1.0, 0.15),
    ("bent to 60 %", "bar", (0, 0, 0.92 * 3 * EI), 2.0, 0.5),
    ("Princeton, 0 degrees", "strip", (0, 0, PRINCETON), 1.1, 0.15),
    ("Princeton, 45 degrees", "strip", (0, SIDE, SIDE), 1.1, 0.15),
    ("pressed by 0.8 of Euler's load", "bar", (-0.8 * EULER, 0, 0.03 * EI), 0.3, None),
    ("pressed by 1.05", "bar", (-1.05 * EULER, 0, 0.03 * EI), None, 1.0),
    ("pressed by 1.2, more across", "bar", (-1.2 * EULER, 0, 0.2 * EI), None, 1.0),
    ("arc, closed further", "arc", (0, 0.225 * EI, 0), 1.5, 0.3),
    ("arc, opened", "arc", (0.375 * EI, -0.225 * EI, 0), 1.5, 0.3),
    ("arc, out of its plane", "arc", (0, 0, 0.1125 * EI), 1.5, 0.3),
)
# Of a rotating cantilever, in sqrt(E I / (rho A L^4)): flap and lag (Wright et al., 1982).
BLADE = {
    1: (3.6817, 3.5432),
    2: (4.1373, 3.6218),
    3: (4.7973, 3.7435),
    4: (5.5850, 3.8977),
    5: (6.4495, 4.0739),
    6: (7.3604, 4.2632),
}
BLADE_UNIT = 1.0801234  # rad/s
# Finite elements: lag [m], its time [s], foreshortening [m], stretch [m].
SPIN_UP = (0.5738, 6.76, 0.018824, 5.14e-4)


class Refused(Exception):
    """A command that ended with an error."""


class Runner:
    """Runs commands of limber, with a cache of bodies."""

    def __init__(self, limber, work):
        self.limber, self.work = limber, work

    def call(self, command, scene, *options):
        """Its JSON and the processor's seconds."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        result = subprocess.run(
            [self.limber, command, scene, "--json", "--cache", self.work / "cache"]
            + list(options),
            capture_output=True,
            text=True,
            check=False,
        )
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if result.returncode != 0:
            raise Refused(result.stderr.strip())
        return json.loads(result.stdout), after.ru_utime - before.ru_utime

    def run(self, name, scene, *options):
        folder = self.work / name
        found, seconds = self.call("run", scene, "--out", folder, *options)
        return found, seconds, folder

    def find_step_seconds(self, name, scene, steps, *options):
        """Of the processor, of one step of a run: less a run of few."""
        few = max(1, steps // 20)
        step = find_step(scene)
        times = []
        for count in (few, few, steps):  # the first may reduce the body
            end = f"time.duration={count * step:.17g}"
            sets = ("--set", end, "--set", "output.pictures=false")
            interval = f"time.output_interval={few * step:.17g}"
            times.append(
                self.run(name + "-cost", scene, *sets, "--set", interval, *options)[1]
            )
        return (times[2] - times[1]) / (steps - few)


def find_step(scene):
    """The step of a scenario [s]."""
    for line in pathlib.Path(scene).read_text(encoding="utf-8").splitlines():
        if line.startswith("step = "):
            return float(line.split("=")[1].split("#")[0])
    raise SystemExit(f"{scene}: no step")


def at_level(level):
    if level == "two pieces":
        return ("--fidelity", "nonlinear", "--set", "basis.pieces=2")
    return ("--fidelity", level)


def name_folder(*words):
    return "-".join(words).replace(" ", "-")


def find_tip(runner, scene, force, level):
    """Displacement of the tip in equilibrium [m], and the seconds; None: refused."""
    load = "load.pull.force=[" + ",".join(f"{float(f):.17g}" for f in force) + "]"
    folder = runner.work / name_folder(scene, level)
    file = HERE / f"scenes/{scene}.toml"
    try:
        found, seconds = runner.call(
            "static", file, "--out", folder, "--set", load, *at_level(level)
        )
    except Refused as error:
        print(f"{scene}, {force}, {level}: {error}")
        return None, None
    return [found["probes"][f"tip.u{axis}"]["value"] for axis in "xyz"], seconds


def measure_bent(runner):
    """Error of the tip's displacement and its cost; claims."""
    rows, claims = [], []
    for scene in ("bar", "strip", "arc"):
        for level in LEVELS:
            find_tip(runner, scene, (0, 0, 1.0), level)  # fills the cache
    for name, scene, force, aim, aim_in_two in BENT:
        tips = {level: find_tip(runner, scene, force, level) for level in LEVELS}
        truth = tips["full"][0]
        row = [name]
        for level in REDUCED:
            tip = tips[level][0]
            error = math.dist(tip, truth) / math.hypot(*truth) if tip else None
            row.append(page.percent(error))
            if level == "nonlinear" and aim is not None:
                claims.append((name, error, aim / 100))
            if level == "two pieces" and aim_in_two is not None:
                claims.append((f"{name}, in two pieces", error, aim_in_two / 100))
        row.append(f"{math.hypot(*truth):.5f}")
        row += [page.number(tips[level][1]) for level in LEVELS]
        rows.append(row)
    return rows, claims


def sweep(runner, forces, share):
    """Curves (level, points) of the bar's tip across over a load."""
    curves = []
    for level in LEVELS:
        points = []
        for force in forces:
            tip, _ = find_tip(runner, "bar", force, level)
            if tip is not None:
                points.append((share(force), tip[2]))
        curves.append((level, "linespoints", points))
    return curves


def measure_blade(runner):
    rows, claims = [], []
    curves = {level: ([], []) for level in WHOLE}
    file = ROOT / "examples/blade.toml"
    for times, (flap, lag) in BLADE.items():
        speed = f"{times * BLADE_UNIT:.9g}"
        sets = ["--set", f"initial.joints.axle.velocity={speed}"]
        sets += ["--set", f"drive.axle.signal.value={speed}"]
        row = [str(times)]
        for level, (lags, flaps) in curves.items():
            try:
                found, _ = runner.call("frequencies", file, *sets, *at_level(level))
            except Refused as error:
                print(f"blade at {times}, {level}: {error}")
                row += ["-", "-"]
                continue
            rates = [m["frequency"] * 2 * math.pi / BLADE_UNIT for m in found["modes"]]
            got = sorted(rate for rate in rates if rate > 0.5)[:2]
            errors = (got[0] / lag - 1, got[1] / flap - 1)
            lags.append((times, got[0]))
            flaps.append((times, got[1]))
            row += [page.percent(error, 3) for error in errors]
            if level == "nonlinear":
                for what, error in zip(("lag", "flap"), errors):
                    claims.append((f"blade at {times} times, {what}", abs(error), 5e-4))
        rows.append(row)
    return rows, claims, curves


def find_column(head, name):
    """Its place; a head is a name and a unit."""
    return [column.split(" ")[0] for column in head].index(name)


def read_probe(folder, names):
    with open(folder / "probes.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    columns = [find_column(rows[0], n) for n in names]
    return [[float(r[0])] + [float(r[c]) for c in columns] for r in rows[1:]]


def measure_spin_up(runner):
    rows, claims, curves = [], [], []
    file = ROOT / "examples/spin_up.toml"
    for level in WHOLE:
        _, _, folder = runner.run(f"spin-up-{level}", file, *at_level(level))
        tip = read_probe(folder, ["tip_lag.ux", "tip_lag.uy"])
        t, _, dy = max(tip, key=lambda r: abs(r[2]))
        lag, short = abs(dy), -min(r[1] for r in tip)
        late = [r[1] for r in tip if r[0] > 16.0]
        stretch = sum(late) / len(late)
        curves.append((level, "lines", [(r[0], r[2]) for r in tip]))
        cells = [level]
        for value, true, digits in (
            (lag, SPIN_UP[0], ".4f"),
            (short, SPIN_UP[2], ".6f"),
            (stretch, SPIN_UP[3], ".3e"),
        ):
            cells.append(f"{value:{digits}} ({100 * (value / true - 1):+.2f} %)")
        rows.append(cells[:2] + [f"{t:.2f}"] + cells[2:])
        if level == "nonlinear":
            claims += [
                ("spin-up, lag", abs(lag / SPIN_UP[0] - 1), 0.001),
                ("spin-up, foreshortening", abs(short / SPIN_UP[2] - 1), 0.003),
                ("spin-up, stretch", abs(stretch / SPIN_UP[3] - 1), 0.01),
            ]
    rows.append(
        ["**finite elements**"]
        + [f"{SPIN_UP[0]}", f"{SPIN_UP[1]}", f"{SPIN_UP[2]}", f"{SPIN_UP[3]:.2e}"]
    )
    curves.append(("peak of finite elements", "points", [(SPIN_UP[1], -SPIN_UP[0])]))
    return rows, claims, curves


def compare_motion(runner, name, file, probe, *options):
    """A probe's displacement [m] by level, the largest of `full`, and errors."""
    columns = [f"{probe}.u{axis}" for axis in "xyz"]
    motions = {}
    for level in LEVELS:
        try:
            _, _, folder = runner.run(
                name_folder(name, level), file, *options, *at_level(level)
            )
        except Refused as error:
            print(f"{name}, {level}: {error}")
            continue
        motions[level] = read_probe(folder, columns)
    size = max(math.hypot(*r[1:]) for r in motions["full"])
    errors = {level: None for level in REDUCED}
    for level in errors:
        if level in motions:
            pairs = zip(motions[level], motions["full"], strict=True)
            errors[level] = max(math.dist(a[1:], b[1:]) for a, b in pairs) / size
    return motions, size, errors


def measure_struck(runner):
    rows, claims, curves = [], [], {}
    file = HERE / "scenes/struck.toml"
    for rate, aim, aim_in_two in ((30, 0.5, None), (100, 4.0, 1.0)):
        spin = ("--set", f"initial.base.angular_velocity=[0.0,0.0,{rate}.0]")
        motions, size, errors = compare_motion(runner, f"struck-{rate}", file, "tip", *spin)
        row = [f"{rate} rad/s"] + [page.percent(errors[n]) for n in REDUCED]
        rows.append(row + [page.percent(size)])
        claims.append((f"struck at {rate} rad/s", errors["nonlinear"], aim / 100))
        if aim_in_two is not None:
            name = f"struck at {rate} rad/s, in two pieces"
            claims.append((name, errors["two pieces"], aim_in_two / 100))
        curves[rate] = [
            (n, "lines", [(1e3 * r[0], 1e3 * r[2]) for r in m]) for n, m in motions.items()
        ]
    return rows, claims, curves


def sum_contacts(folder):
    """Of all touches: the largest force, the impulse, and their number."""
    text = (folder / "summary.json").read_text(encoding="utf-8")
    found = json.loads(text)["contacts"]
    return {
        "peak_force": max(c["peak_force"] for c in found),
        "impulse": sum(c["impulse"] for c in found),
        "touches": sum(c["touches"] for c in found),
    }


def measure_catch(runner):
    """Of a bar's tip; of the contact the peak force and the impulse."""
    file = HERE / "scenes/catch.toml"
    motions, size, errors = compare_motion(runner, "catch", file, "tip")
    curves = [
        (n, "lines", [(1e3 * r[0], 1e3 * r[3]) for r in m]) for n, m in motions.items()
    ]
    contacts = {
        level: sum_contacts(runner.work / name_folder("catch", level)) for level in motions
    }
    truth = contacts["full"]
    rows = []
    for level in motions:
        own = contacts[level]
        row = [level, "" if level == "full" else page.percent(errors[level])]
        for key in ("peak_force", "impulse"):
            share = 100 * (own[key] / truth[key] - 1)
            row.append(f"{own[key]:.4g}" + ("" if level == "full" else f" ({share:+.2f} %)"))
        rows.append(row + [str(own["touches"])])
    return rows, size, curves


def measure_cost(runner):
    rows, claims = [], []
    scenes = (
        ("blade", ROOT / "examples/blade.toml", 4000, ("--unset", "initial.equilibrium")),
        ("spin-up", ROOT / "examples/spin_up.toml", 4000, ()),
        ("struck", HERE / "scenes/struck.toml", 4000, ()),
        ("catch", HERE / "scenes/catch.toml", 1000, ()),
    )
    for name, file, steps, options in scenes:
        seconds = {}
        for level in LEVELS:
            count = 40 if level == "full" else steps
            seconds[level] = runner.find_step_seconds(
                name_folder(name, level), file, count, *options, *at_level(level)
            )
        ratio = seconds["nonlinear"] / seconds["coupled"]
        cheaper = seconds["full"] / seconds["nonlinear"]
        row = [name] + [f"{1e6 * seconds[n]:.3g}" for n in LEVELS]
        rows.append(row + [f"{ratio:.2f}", f"{cheaper:.0f}"])
        if name != "catch":
            claims.append((name, cheaper, 500.0))
    return rows, claims


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--limber", default=ROOT / "build/release/src/app/limber")
    parser.add_argument("--out", default=ROOT / "out/bending", type=pathlib.Path)
    options = parser.parse_args()
    out = options.out.resolve()
    work = ROOT / "out/bending-runs"
    for folder in (out, work):
        folder.mkdir(parents=True, exist_ok=True)
    runner = Runner(pathlib.Path(options.limber).resolve(), work)
    text = page.Page(out)
    bent, claims = measure_bent(runner)
    bending = [(0, 0, share * 3 * EI) for share in (0.1, 0.3, 0.5, 0.7, 0.92)]
    pressing = [(-s * EULER, 0, 0.2 * EI) for s in (0.0, 0.4, 0.8, 1.0, 1.2)]
    text.draw_static(
        sweep(runner, bending, lambda f: f[2] / EI),
        sweep(runner, pressing, lambda f: -f[0] / EULER),
    )
    blade, more, frequencies = measure_blade(runner)
    spin, of_spin, lags = measure_spin_up(runner)
    struck, of_struck, strikes = measure_struck(runner)
    catch, size, catches = measure_catch(runner)
    claims += more + of_spin + of_struck
    text.draw_motion(frequencies, BLADE, lags, strikes, catches)
    cost, cheaper = measure_cost(runner)
    text.write(claims, cheaper, bent, blade, spin, struck, (catch, size), cost)
    shutil.rmtree(work / "cache", ignore_errors=True)


if __name__ == "__main__":
    main()
