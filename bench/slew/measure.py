#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Slews an arm with and without feedback of its strain, and writes a page.

    bench/slew/measure.py --limber build/release/src/app/limber [--out FOLDER]
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess

import numpy
import scipy.linalg

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SCENE = ROOT / "examples/damped_slew.toml"

GAIN = 150.0  # of the example [1/s]
GAINS = (50.0, 100.0, GAIN, 200.0)
PERIOD = 5e-4  # of its controller [s]
LIMIT = 400.0  # of its torque [N m]
QUIET = 0.75  # from here on no command moves [s]
LAST = 1.6  # from here on the residual vibration counts [s]

INTRODUCTION = """\
Written by `bench/slew/measure.py`, including all text; do not edit. The arm of
[slew.toml](../../../examples/slew.toml) swings on after its slew of half a turn in 0.6 s. In
[damped_slew.toml](../../../examples/damped_slew.toml) a second torque of its motor follows the
integral of the bending moment at the beam's root, as strain gauges there measure it, sampled
every 0.5 ms; the law knows nothing of the arm. *Without* is the same file with
`--set drive.damper.signal.factor=0`: the law runs, and nothing follows it. The residual vibration
is that of the tip's deformation in the last 0.4 s of 2 s, peak to peak. (The
[page on shapers](README.md) has another measure: the tip's deviation from the commanded direction,
from 0.87 s on.)"""
POLES = """\
The damping ratio of a run is that of a straight line through the logarithms of the tip's peaks after
the command has ended. Beside it is that of the first pole of the closed loop, found outside of
Limber from the plant that `limber linearize` writes (`--inputs damper --outputs root.tz`): its exact
transition over a period (`scipy.linalg.expm`), under an input that goes to each sample's value along
a straight line, together with the sampled integral."""


class Runner:
    def __init__(self, limber, work):
        self.limber, self.work = limber, work

    def call(self, *words):
        done = subprocess.run([self.limber, *words], capture_output=True, text=True,
                              check=False, cwd=self.work)
        if done.returncode != 0:
            raise SystemExit(f"limber {' '.join(map(str, words))}: {done.stderr}")
        return done.stdout

    def run(self, name, *settings):
        """Columns of the run's probes, by their names without units."""
        words = [word for one in settings for word in ("--set", one)]
        self.call("run", SCENE, "--out", name, *words)
        with open(self.work / name / "probes.csv", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        names = [cell.split(" [")[0] for cell in rows[0]]
        return dict(zip(names, numpy.array(rows[1:], float).T))

    def find_plant(self):
        self.call("linearize", SCENE, "--inputs", "damper", "--outputs", "root.tz",
                  "-o", "plant.npz")
        return numpy.load(self.work / "plant.npz")


def find_pole(plant, gain):
    """Of the sampled loop, the one of the beam's first mode [1/s]."""
    a, b, c, d = (plant[name] for name in "ABCD")
    n = len(a)
    # x' = a x + b v, v' = s: transitions by x, v and s over a period.
    whole = numpy.zeros((n + 2, n + 2))
    whole[:n, :n], whole[:n, n], whole[n, n + 1] = a, b[:, 0], 1.0
    whole = scipy.linalg.expm(whole * PERIOD)
    # At a sample the integral, so far v, becomes w = v - gain T y.
    to_w = numpy.append(-gain * PERIOD * c[0], 1.0 - gain * PERIOD * d[0, 0])
    loop = numpy.zeros((n + 1, n + 1))
    loop[:n, :n], loop[:n, n] = whole[:n, :n], whole[:n, n]
    change = to_w.copy()
    change[n] -= 1.0
    loop[:n] += numpy.outer(whole[:n, n + 1] / PERIOD, change)
    loop[n] = to_w
    poles = numpy.log(numpy.linalg.eigvals(loop).astype(complex)) / PERIOD
    first = [s for s in poles if 4.0 < s.imag / (2.0 * math.pi) < 16.0]
    return max(first, key=lambda s: s.real)


def find_peaks(run):
    t, y = run["time"], numpy.abs(run["tip.dy"])
    middle = (y[1:-1] > y[:-2]) & (y[1:-1] >= y[2:]) & (t[1:-1] > QUIET)
    return t[1:-1][middle], y[1:-1][middle]


def find_decay(run):
    """Rate at which the peaks fall [1/s]."""
    t, y = find_peaks(run)
    return -numpy.polyfit(t, numpy.log(y), 1)[0]


def find_residual(run):
    """Peak to peak [m]."""
    return numpy.ptp(run["tip.dy"][run["time"] > LAST])


WITHOUT, WITH = "#d55e00", "#0072b2"  # colours


def make_panel(title, label, curves, extra=()):
    """@param curves (name, style, times, values)"""
    lines = [f"set title '{title}'", "set xlabel 'time [s]'", f"set ylabel '{label}'", *extra]
    parts = [f"'-' with {how} title '{name}'" for name, how, _, _ in curves]
    lines.append("plot " + ", ".join(parts))
    for _, _, x, y in curves:
        lines += [f"{a:.6g} {b:.6g}" for a, b in zip(x, y)] + ["e"]
    return lines + ["unset logscale", "set autoscale"]


def draw(file, without, damped, poles):
    tip, falls, decays = [], [], []
    for name, run, pole, colour in (("without feedback", without, poles[0], WITHOUT),
                                    ("with feedback", damped, poles[1], WITH)):
        tip.append((name, f"lines lw 1.5 lc rgb '{colour}'", run["time"], 1e3 * run["tip.dy"]))
        t, y = find_peaks(run)
        falls.append((name, f"points pt 7 lc rgb '{colour}'", t, 1e3 * y))
        decays.append(("pole of its loop", f"lines dt 2 lc rgb '{colour}'", t,
                       1e3 * y[0] * numpy.exp(pole.real * (t - t[0]))))
    late = [(name, how, x[x > LAST], y[x > LAST]) for name, how, x, y in tip]
    torque = [("with feedback", f"lines lw 1.5 lc rgb '{WITH}'", damped["time"],
               damped["torque.u"])]
    text = ["set terminal pngcairo noenhanced size 1100,820 font 'sans,11'",
            f"set output '{file}'", "set grid lc rgb '#dddddd' lt 1",
            "set key outside bottom center horizontal", "set multiplot layout 2,2",
            *make_panel("Deformation of the tip", "deformation [mm]", tip),
            *make_panel("The same, its last 0.4 s", "deformation [mm]", late),
            *make_panel("Its peaks", "deformation [mm]", falls + decays, ["set logscale y"]),
            *make_panel("Torque of the damper", "torque [N m]", torque), "unset multiplot"]
    subprocess.run(["gnuplot"], input="\n".join(text) + "\n", text=True, check=True)


def to_row(name, run, torque, pole, free):
    residual = find_residual(run)
    return (f"| {name} | {find_decay(run) / abs(pole):.4f} | {-pole.real / abs(pole):.4f} "
            f"| {torque:.0f} | {1e3 * residual:.3f} | {free / residual:.1f} |")


def measure(runner):
    """The page's text, the two runs that are drawn, and the claims."""
    plant = runner.find_plant()
    without = runner.run("without", "drive.damper.signal.factor=0")
    free = find_residual(without)
    poles = [find_pole(plant, 0.0)]
    rows = [to_row("without", without, 0.0, poles[0], free)]
    errors = [abs(find_decay(without) / -poles[0].real - 1.0)]
    for gain in GAINS:
        run = runner.run(f"gain{gain:g}", f"controller.damper.integral={gain}")
        pole = find_pole(plant, gain)
        rows.append(to_row(f"{gain:g}", run, numpy.abs(run["torque.u"]).max(), pole, free))
        if numpy.abs(run["torque.u"]).max() < LIMIT:
            errors.append(abs(find_decay(run) / -pole.real - 1.0))
        if gain == GAIN:
            damped, less = run, free / find_residual(run)
            poles.append(pole)
    claims = [(less >= 10.0, f"the feedback of the example leaves {less:.1f} times less of "
                             "the vibration, at least ten times less."),
              (max(errors) < 0.01, "the vibration of each run whose torque stays within its limits "
                                   f"of {LIMIT:g} N m falls at the rate of its loop's pole, to "
                                   f"{100.0 * max(errors):.1g} %.")]
    return rows, claims, (without, damped, poles)


def write_page(out, rows, claims):
    text = ["# A slew, damped by feedback", "", INTRODUCTION, "",
            "| gain [1/s] | damping ratio | of the loop's pole | largest torque [N m] "
            "| left [mm] | times less |", "|---:|---:|---:|---:|---:|---:|", *rows, "", POLES, ""]
    for holds, claim in claims:
        text += [f"- **{'Holds' if holds else 'MISSED'}:** {claim}", ""]
    text += ["![Deformation of the tip, its peaks, and the torque](feedback.png)", "",
             f"*With the gain of the example, {GAIN:g} 1/s. Dashed: the decay of the loop's pole, "
             "from the first peak.*"]
    (out / "feedback.md").write_text("\n".join(text) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--limber", default=ROOT / "build/release/src/app/limber")
    parser.add_argument("--out", default=ROOT / "out/slew", type=pathlib.Path)
    options = parser.parse_args()
    out, work = options.out.resolve(), ROOT / "out/slew-runs"
    for folder in (out, work):
        folder.mkdir(parents=True, exist_ok=True)
    runner = Runner(pathlib.Path(options.limber).resolve(), work)
    rows, claims, drawn = measure(runner)
    draw(out / "feedback.png", *drawn)
    write_page(out, rows, claims)
    return 0 if all(holds for holds, _ in claims) else 1


if __name__ == "__main__":
    raise SystemExit(main())
