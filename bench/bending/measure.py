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
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
INTRODUCTION = """\
Written by `bench/bending/measure.py`, including all text; do not edit. Bars that stiffen
in spin, bend far, buckle and are struck while they turn, by public commands: level
`coupled`, whose bodies are linear, `nonlinear` in one piece and in two, and the closed form
or the whole mesh (`full`). Errors are percent of the truth. Costs are ratios of one run of
this page; the time of a step is that of the processor, with reading and writing, less that
of a run of one step."""
EI = 2e11 * 0.05**4 / 12  # of bar and arc's section to the fourth [N m^2]
EULER = math.pi**2 * EI / 4  # of the bar, held at one end [N]
PRINCETON = 13.345  # N
SIDE = math.sqrt(0.5) * PRINCETON

# Name, scene, force on the tip [N], error asked of one piece and of two [%].
BENT = (
    ("bent to 20 %", "bar", (0, 0, 0.2065 * 3 * EI), 0.3, 0.1),
    ("bent to 40 %", "bar", (0, 0, 0.465 * 3 * EI), 1.0, 0.15),
    ("bent to 60 %", "bar", (0, 0, 0.92 * 3 * EI), 2.0, 0.5),
    ("Princeton, 0 degrees", "strip", (0, 0, PRINCETON), 1.1, 0.15),
    ("Princeton, 45 degrees", "strip", (0, SIDE, SIDE), 1.1, 0.15),
    ("pressed by 0.8 of Euler's load", "bar", (-0.8 * EULER, 0, 0.03 * EI), 0.3, None),
    ("pressed by 1.05", "bar", (-1.05 * EULER, 0, 0.03 * EI), None, 1.0),
    ("pressed by 1.2", "bar", (-1.2 * EULER, 0, 0.03 * EI), None, 1.0),
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


class Runner:
    """Runs commands of limber, with a cache of bodies."""

    def __init__(self, limber, work):
        self.limber, self.work = limber, work

    def call(self, command, scene, *options):
        """Its JSON and the processor's seconds; None if it is refused."""
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
            return None, result.stderr.strip()
        return json.loads(result.stdout), after.ru_utime - before.ru_utime

    def run(self, name, scene, *options):
        folder = self.work / name
        return *self.call("run", scene, "--out", folder, *options), folder

    def step_seconds(self, name, scene, steps, *options):
        """Of one step."""
        quiet = ("--set", "output.pictures=false", *options)
        spec = json_of_time(scene)
        times = []
        for count in (1, steps):
            end = f"time.duration={count * spec:.17g}"
            found, seconds, _ = self.run(name + "-cost", scene, *quiet, "--set", end)
            if found is None:
                return None
            times.append(seconds)
        return (times[1] - times[0]) / (steps - 1)


def json_of_time(scene):
    """The step of a scenario [s]."""
    for line in pathlib.Path(scene).read_text(encoding="utf-8").splitlines():
        if line.startswith("step = "):
            return float(line.split("=")[1].split("#")[0])
    raise SystemExit(f"{scene}: no step")


def has_pieces():
    return "pieces" in (ROOT / "docs/formats/scenario.md").read_text(encoding="utf-8")


# Columns of all tables: name, options of a command.
LEVELS = {
    "coupled": ("--fidelity", "coupled"),
    "nonlinear": ("--fidelity", "nonlinear"),
    "two pieces": ("--fidelity", "nonlinear", "--set", "basis.pieces=2"),
    "full": ("--fidelity", "full"),
}


def levels(runner_levels=tuple(LEVELS)):
    return [n for n in runner_levels if n != "two pieces" or has_pieces()]


def cell(value, digits=2):
    return "-" if value is None else f"{100 * value:.{digits}f} %"


def distance(a, b):
    return math.dist(a, b) / math.hypot(*b)


def measure_bent(runner):
    """Error of the tip's displacement, and which hold what is asked."""
    rows, claims, curves = [], [], {}
    for name, scene, force, one, two in BENT:
        file = HERE / f"scenes/{scene}.toml"
        load = "load.pull.force=[" + ",".join(f"{float(f):.17g}" for f in force) + "]"
        tips = {}
        for level in levels():
            folder = runner.work / f"{scene}-{level.replace(' ', '-')}"
            found, _ = runner.call(
                "static", file, "--out", folder, "--set", load, *LEVELS[level]
            )
            tips[level] = found and [
                found["probes"][f"tip.d{axis}"]["value"] for axis in "xyz"
            ]
        truth = tips["full"]
        errors = {
            level: distance(tip, truth) if tip else None for level, tip in tips.items()
        }
        rows.append(
            f"| {name} | {cell(errors['coupled'])} | {cell(errors['nonlinear'])} "
            f"| {cell(errors.get('two pieces'))} | {math.hypot(*truth):.5f} |"
        )
        for what, asked in (("nonlinear", one), ("two pieces", two)):
            if asked is not None and what in errors:
                claims.append((f"{name}, {what}", errors[what], asked / 100))
        curves[name] = errors
    return rows, claims, curves


def measure_blade(runner):
    rows, claims = [], []
    curves = {level: ([], []) for level in ("coupled", "nonlinear")}
    file = ROOT / "examples/blade.toml"
    for times, (flap, lag) in BLADE.items():
        speed = f"{times * BLADE_UNIT:.9g}"
        row = f"| {times} |"
        for level, (lags, flaps) in curves.items():
            found, text = runner.call(
                "frequencies",
                file,
                "--set",
                f"initial.joints.axle.velocity={speed}",
                "--set",
                f"drive.axle.signal.value={speed}",
                *LEVELS[level],
            )
            if found is None:
                row += " - | - |"
                continue
            got = sorted(
                m["frequency"] * 2 * math.pi / BLADE_UNIT
                for m in found["modes"]
                if m["frequency"] * 2 * math.pi / BLADE_UNIT > 0.5
            )[:2]
            errors = (got[0] / lag - 1, got[1] / flap - 1)
            lags.append((times, got[0]))
            flaps.append((times, got[1]))
            row += f" {cell(errors[0], 3)} | {cell(errors[1], 3)} |"
            if level == "nonlinear":
                claims.append((f"blade at {times} times, lag", abs(errors[0]), 5e-4))
                claims.append((f"blade at {times} times, flap", abs(errors[1]), 5e-4))
        rows.append(row)
    return rows, claims, curves


def read_probe(folder, names):
    with open(folder / "probes.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    columns = [rows[0].index(n) for n in names]
    return [[float(r[0])] + [float(r[c]) for c in columns] for r in rows[1:]]


def measure_spin_up(runner):
    rows, claims, curves = [], [], {}
    file = ROOT / "examples/spin_up.toml"
    for level in ("coupled", "nonlinear"):
        found, _, folder = runner.run(f"spin-up-{level}", file, *LEVELS[level])
        if found is None:
            continue
        tip = read_probe(folder, ["tip_lag.dx", "tip_lag.dy"])
        t, dx, dy = max(tip, key=lambda r: abs(r[2]))
        lag = abs(dy)
        short = -min(r[1] for r in tip)
        late = [r[1] for r in tip if r[0] > 16.0]
        stretch = sum(late) / len(late)
        curves[level] = [(r[0], r[2]) for r in tip]
        rows.append(
            f"| {level} | {lag:.4f} ({100 * (lag / SPIN_UP[0] - 1):+.2f} %) | {t:.2f} "
            f"| {short:.6f} ({100 * (short / SPIN_UP[2] - 1):+.2f} %) "
            f"| {stretch:.3e} ({100 * (stretch / SPIN_UP[3] - 1):+.2f} %) |"
        )
        if level == "nonlinear":
            claims += [
                ("spin-up, lag", abs(lag / SPIN_UP[0] - 1), 0.001),
                ("spin-up, foreshortening", abs(short / SPIN_UP[2] - 1), 0.003),
                ("spin-up, stretch", abs(stretch / SPIN_UP[3] - 1), 0.01),
            ]
    rows.append(
        f"| **finite elements** | {SPIN_UP[0]} | {SPIN_UP[1]} | {SPIN_UP[2]} | {SPIN_UP[3]:.2e} |"
    )
    return rows, claims, curves


def measure_struck(runner):
    rows, claims, curves = [], [], {}
    file = HERE / "scenes/struck.toml"
    for rate, one, two in ((30, 0.5, None), (100, 4.0, 1.0)):
        spin = ("--set", f"initial.base.angular_velocity=[0.0,0.0,{rate}.0]")
        tips = {}
        for level in levels():
            found, _, folder = runner.run(
                f"struck-{rate}-{level.replace(' ', '-')}", file, *spin, *LEVELS[level]
            )
            if found is not None:
                tips[level] = read_probe(folder, ["tip.dx", "tip.dy", "tip.dz"])
        truth = tips["full"]
        size = max(math.hypot(*r[1:]) for r in truth)
        row = f"| {rate} rad/s |"
        for level in ("coupled", "nonlinear", "two pieces"):
            error = None
            if level in tips:
                error = max(
                    math.dist(a[1:], b[1:]) / size for a, b in zip(tips[level], truth)
                )
            row += f" {cell(error)} |"
            asked = {"nonlinear": one, "two pieces": two}.get(level)
            if error is not None and asked is not None:
                claims.append((f"struck at {rate} rad/s, {level}", error, asked / 100))
        rows.append(row + f" {100 * size:.2f} % |")
        curves[rate] = {n: [(1e3 * r[0], 1e3 * r[2]) for r in t] for n, t in tips.items()}
    return rows, claims, curves


def measure_cost(runner):
    rows = []
    scenes = (
        ("blade", ROOT / "examples/blade.toml", 4000, ("--unset", "initial.equilibrium")),
        ("spin-up", ROOT / "examples/spin_up.toml", 4000, ()),
        ("struck", HERE / "scenes/struck.toml", 4000, ()),
    )
    for name, file, steps, options in scenes:
        seconds = {}
        for level in levels():
            count = 30 if level == "full" else steps
            seconds[level] = runner.step_seconds(
                f"{name}-{level}", file, count, *options, *LEVELS[level]
            )
        base = seconds["coupled"]
        ratios = [
            "-" if not seconds.get(n) else f"{seconds[n] / base:.3g}"
            for n in ("nonlinear", "two pieces", "full")
        ]
        times = seconds["full"] / seconds["nonlinear"] if seconds.get("full") else None
        rows.append(
            f"| {name} | 1 | {ratios[0]} | {ratios[1]} | {ratios[2]} "
            f"| {'-' if times is None else f'{times:.0f}'} |"
        )
    return rows


def plot(out, name, title, labels, series, extra=()):
    styles = ("#d55e00", "#0072b2", "#009e73", "#000000")
    parts = [
        "set terminal pngcairo noenhanced size 900,480 font 'sans,11'",
        f"set output '{out / name}.png'",
        f"set title '{title}'",
        f"set xlabel '{labels[0]}'",
        f"set ylabel '{labels[1]}'",
        "set grid lc rgb '#dddddd'",
        "set key top left",
        *extra,
    ]
    plots = [
        f"'-' with {kind} lw 2 pt 7 lc rgb '{styles[i % 4]}' title '{label}'"
        for i, (label, kind, _) in enumerate(series)
    ]
    parts.append("plot " + ", ".join(plots))
    for _, _, points in series:
        parts += [f"{x:.6g} {y:.6g}" for x, y in points] + ["e"]
    subprocess.run(["gnuplot"], input="\n".join(parts) + "\n", text=True, check=True)


def draw(out, blade, spin, struck):
    series = []
    for level, (lags, flaps) in blade.items():
        series.append((f"{level}, lag", "lines", lags))
        series.append((f"{level}, flap", "lines", flaps))
    truth = [(t, f) for t, (flap, lag) in BLADE.items() for f in (flap, lag)]
    series.append(("closed form", "points", truth))
    labels = ("rotation / sqrt(E I / (rho A L^4))", "frequency / the same")
    plot(out, "blade", "Rotating cantilever", labels, series)
    series = [(level, "lines", points) for level, points in spin.items()]
    plot(out, "spin_up", "Spin-up: lag of the tip", ("time [s]", "tip [m]"), series)
    for rate, tips in struck.items():
        series = [(level, "lines", points) for level, points in tips.items()]
        labels = ("time [ms]", "tip across the root [mm]")
        plot(out, f"struck_{rate}", f"Struck at {rate} rad/s", labels, series)


def write_page(out, claims, bent, blade, spin, struck, cost):
    held = [c for c in claims if c[1] is not None and c[1] <= c[2]]
    text = ["# Bending: level against truth", "", INTRODUCTION, "", "## Claims", ""]
    text.append(f"{len(held)} of {len(claims)} held.")
    text += ["", "| claim | error | asked | |", "|---|---:|---:|---|"]
    for name, error, asked in claims:
        verdict = "held" if (name, error, asked) in held else "**missed**"
        text.append(f"| {name} | {cell(error, 3)} | {cell(asked)} | {verdict} |")
    head = "| | coupled | nonlinear | in two pieces |"
    text += ["", "## Bent, pressed and curved bars", "", "Displacement of the tip.", ""]
    text += [head + " full [m] |", "|---|---:|---:|---:|---:|", *bent, ""]
    text += ["## A rotating blade", "", "`examples/blade.toml`.", ""]
    text += ["| times | coupled, lag | flap | nonlinear, lag | flap |"]
    text += ["|---:|---:|---:|---:|---:|", *blade, "", "![Frequencies](blade.png)", ""]
    text += ["## A spin-up", "", "`examples/spin_up.toml`.", ""]
    text += ["| level | lag [m] | at [s] | foreshortening [m] | stretch [m] |"]
    text += ["|---|---|---:|---|---|", *spin, "", "![Lag](spin_up.png)", ""]
    text += ["## Struck while it spins", ""]
    text += ["Largest error in 50 ms of the tip against the root, of its largest way.", ""]
    text += [head + " way / length |", "|---|---:|---:|---:|---:|", *struck, ""]
    text += ["![30 rad/s](struck_30.png)", "", "![100 rad/s](struck_100.png)", ""]
    text += ["## Cost of a step", "", "In that of `coupled`, one run.", ""]
    text += ["| scene | coupled | nonlinear | in two pieces | full | full / nonlinear |"]
    text += ["|---|---:|---:|---:|---:|---:|", *cost, ""]
    (out / "README.md").write_text("\n".join(text), encoding="utf-8")


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
    bent, claims, _ = measure_bent(runner)
    blade, more, blade_curves = measure_blade(runner)
    spin, of_spin, spin_curves = measure_spin_up(runner)
    struck, of_struck, struck_curves = measure_struck(runner)
    claims += more + of_spin + of_struck
    draw(out, blade_curves, spin_curves, struck_curves)
    write_page(out, claims, bent, blade, spin, struck, measure_cost(runner))


if __name__ == "__main__":
    main()
