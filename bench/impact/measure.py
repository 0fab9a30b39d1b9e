#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Strikes a bar, a plate and a thin bar, and writes a page with pictures.

    bench/impact/measure.py --limber build/release/src/app/limber [--out FOLDER]
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

# Whole finite elements with contact at nodes of a graded mesh: peak [N],
# duration [s], impulse [N s]. Of the thin bar no duration was kept.
BODIES = {
    "bar": (
        "Bar of 200 x 20 x 10 mm",
        (10, 20, 40, 80),
        (1692.6, 49.20e-6, 0.04368),
    ),
    "plate": (
        "Plate of 200 x 200 x 4 mm",
        (20, 80, 320),
        (978.1, 84.5e-6, 0.03623),
    ),
    "thin_bar": (
        "Bar of 200 x 20 x 3 mm",
        (30, 60, 120),
        (655.0, None, 0.02552),
    ),
}
INTRODUCTION = """\
Written by `bench/impact/measure.py`, including all text; do not edit. A rigid ball of
steel, 20 mm thick, strikes the middle of free steel bodies with 1 m/s, without friction
or damping ([scenes](../scenes), steps of 0.25 us). The truth is whole finite elements of a
mesh graded down to 0.16 mm under the ball, with contact at nodes, outside of this
project. Modes count all of the free body: the truth's own comparison with bases, on a
quarter of the body, has a quarter of them. Of the plate Zener's closed form, for a plate
without edges [@zener1941], is a second witness."""
MODULUS, RATIO, DENSITY, RADIUS, SPEED = 210e9, 0.3, 7850.0, 0.01, 1.0
MASS = DENSITY * 4 / 3 * math.pi * RADIUS**3


def zener(thickness):
    """A ball on an infinite plate (Zener, 1941): m a = -F, w' = F / Z.

    Z = 8 sqrt(D rho h) is the plate's impedance at a point. Midpoint rule.
    """
    reduced = MODULUS / (1 - RATIO**2)
    k = 4 / 3 * reduced * math.sqrt(RADIUS)
    stiffness = reduced * thickness**3 / 12
    impedance = 8 * math.sqrt(stiffness * DENSITY * thickness)
    h, t, z, v, w = 2e-9, 0.0, 0.0, SPEED, 0.0
    times, forces, impulse = [0.0], [0.0], 0.0
    while True:
        force = k * max(z - w, 0.0) ** 1.5
        middle = k * max(z + v * h / 2 - w - force / impedance * h / 2, 0) ** 1.5
        z += (v - force / MASS * h / 2) * h
        v -= middle / MASS * h
        w += middle / impedance * h
        t += h
        impulse += middle * h
        times.append(t)
        forces.append(middle)
        if z <= w:
            return times[::100], forces[::100], (max(forces), t, impulse)


class Runner:
    def __init__(self, limber, out, work):
        self.limber, self.out, self.work = limber, out, work
        self.scenes = HERE / "scenes"

    def run(self, name, text, more="", options=()):
        """The summary of a scene's run, its folder, and its seconds."""
        scene = self.scenes / f".{name}.toml"  # its paths are relative to it
        scene.write_text(text + more)
        folder = self.work / name
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            result = subprocess.run(
                [self.limber, "run", scene, "--json", "--out", folder]
                + ["--cache", self.work / "cache", *options],
                capture_output=True,
                text=True,
                check=False,
            )
        finally:
            scene.unlink()
        if result.returncode != 0:
            raise SystemExit(f"{name}: {result.stderr}")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return json.loads(result.stdout), folder, after.ru_utime - before.ru_utime


def read_force(folder):
    with open(folder / "probes.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    return [float(r[0]) for r in rows], [float(r[1]) for r in rows]


def share(value, truth):
    return "" if truth is None else f" ({100 * (value / truth - 1):+.1f} %)"


def to_row(name, contact, truth):
    peak, duration, impulse = truth
    return (
        f"| {name} | {contact['peak_force']:.1f}{share(contact['peak_force'], peak)} "
        f"| {1e6 * contact['duration']:.2f}{share(contact['duration'], duration)} "
        f"| {contact['impulse']:.5f}{share(contact['impulse'], impulse)} "
        f"| {contact['touches']} |"
    )


STYLES = (
    "lw 2 lc rgb '#999999'",
    "lw 2 lc rgb '#009e73'",
    "lw 2 lc rgb '#56b4e9'",
    "lw 2 lc rgb '#d55e00'",
    "lw 2 dt 3 lc rgb '#000000'",
)


def draw(file, title, curves, truth, end):
    """Curves (title, times, forces); the truth's peak is a line."""
    parts = [
        "set terminal pngcairo noenhanced size 900,480 font 'sans,11'",
        f"set output '{file}'",
        f"set title '{title}'",
        "set xlabel 'time [us]'",
        "set ylabel 'force [N]'",
        "set grid lc rgb '#dddddd'",
        "set key top right",
        f"set xrange [0:{end}]",
        "set yrange [0:*]",
    ]
    plots = [
        f"'-' with lines {STYLES[i]} title '{curve[0]}'"
        for i, curve in enumerate(curves)
    ] + [f"{truth} with lines dt 2 lc rgb 'black' title 'peak by whole finite elements'"]
    parts.append("plot " + ", ".join(plots))
    for _, times, forces in curves:
        parts += [f"{1e6 * t:.4f} {f:.4f}" for t, f in zip(times, forces)] + ["e"]
    subprocess.run(["gnuplot"], input="\n".join(parts) + "\n", text=True, check=True)


def measure_body(runner, name):
    title, bases, truth = BODIES[name]
    text = (runner.scenes / f"{name}.toml").read_text()
    lines, curves, found, notes = [], [], {}, []
    rigid, folder, _ = runner.run(f"{name}-rigid", text, "", ["--fidelity", "rigid"])
    lines.append(to_row("rigid", rigid["contacts"][0], truth))
    found["rigid"] = rigid["contacts"][0]
    curves.append(("rigid", *read_force(folder)))
    for modes in bases:
        basis = f"\n[basis]\neigenmodes = {modes}\n"
        summary, folder, _ = runner.run(f"{name}-{modes}", text, basis)
        contact = summary["contacts"][0]
        found[modes] = contact
        lines.append(to_row(f"{modes} modes", contact, truth))
        curves.append((f"{modes} modes", *read_force(folder)))
        notes += [f"{modes} modes: {w}" for w in summary["warnings"] if "answer" in w]
    if name == "plate":
        times, forces, closed = zener(0.004)
        lines.append(
            f"| Zener, infinite plate | {closed[0]:.1f}{share(closed[0], truth[0])} "
            f"| {1e6 * closed[1]:.2f}{share(closed[1], truth[1])} "
            f"| {closed[2]:.5f}{share(closed[2], truth[2])} | 1 |"
        )
        start = found["rigid"]["time"]
        curves.append(("Zener", [start + t for t in times], forces))
    lasts = "" if truth[1] is None else f"{1e6 * truth[1]:.2f}"
    count = 4 if name == "thin_bar" else 1
    lines.append(
        f"| **whole finite elements** | {truth[0]:.1f} | {lasts} | {truth[2]:.5f} | {count} |"
    )
    end = max(c[1][-1] for c in curves if c[0] != "Zener") * 1e6
    draw(runner.out / f"{name}.png", title, curves, truth[0], end)
    return title, lines, found, notes


def measure_restitution(runner):
    text = (runner.scenes / "wall.toml").read_text()
    lines = []
    for wanted in (1.0, 0.9, 0.7, 0.5, 0.3, 0.1):
        summary, _, _ = runner.run("wall", text, f"restitution = {wanted}\n")
        contact = summary["contacts"][0]
        lines.append(
            f"| {wanted} | {contact['restitution']:.5f} | {contact['peak_force']:.1f} "
            f"| {1e6 * contact['duration']:.2f} |"
        )
    return lines


def measure_claw(runner):
    """Microseconds of processor time a step, with reading and writing."""
    text = (ROOT / "examples/catch.toml").read_text()
    text = text.replace("../models", str(ROOT / "models"))
    text = text.replace("[time]", "[output]\npictures = false\n\n[time]")
    free = text.split("# The pads are of rubber.")[0] + "\n"
    for part in text.split("\n\n"):
        if part.startswith("[[drive]]"):
            free += part + "\n\n"
    # Balls around it, none of which a pad ever meets: 34 x 3 pairs.
    idle = text + "".join(
        f"""
[[obstacle]]
name = "idle_{i}"
shape = "sphere"
radius = 0.05
position = [{math.cos(i):.3f}, {math.sin(i):.3f}, {-0.5 + 0.05 * i:.3f}]
"""
        for i in range(34)
    )
    idle += """
[[contact]]
between = ["claw.pad_*", "idle_*"]
friction = 0.8
restitution = 0.3
"""
    scenes = (("with contact", text), ("without", free), ("with 102 pairs more, idle", idle))
    lines = []
    for name, scene in scenes:
        best = math.inf
        for _ in range(3):
            summary, _, seconds = runner.run("claw", scene)
            best = min(best, seconds / summary["steps"])
        newton = summary["newton_iterations"] / summary["steps"]
        lines.append(f"| {name} | {1e6 * best:.1f} | {newton:.2f} |")
    return lines


def write_page(out, bodies, restitution, claw):
    head = "| basis | peak [N] | lasts [us] | impulse [N s] | touches |\n|---|---:|---:|---:|---:|"
    text = ["# Impacts: basis against truth", ""]
    text += [INTRODUCTION, ""]
    for name, (title, lines, _, notes) in bodies.items():
        text += [f"## {title}", "", head, *lines, ""]
        text += [f"![Force on the ball]({name}.png)", ""]
        if notes:
            text += ["What the runs warn of:", ""]
            text += [f"- {note}" for note in notes] + [""]
    text += ["## Rigid against flexible", "", "| body | rigid [N] | flexible [N] | ratio |"]
    text.append("|---|---:|---:|---:|")
    for title, _, found, _ in bodies.values():
        last = list(found)[-1]
        rigid, flexible = found["rigid"]["peak_force"], found[last]["peak_force"]
        text.append(
            f"| {title}, {last} modes | {rigid:.0f} | {flexible:.0f} | {rigid / flexible:.2f} |"
        )
    text += ["", "## Restitution", "", "| asked | found | peak [N] | lasts [us] |"]
    text += ["|---:|---:|---:|---:|", *restitution, ""]
    text += ["## Cost of a step", "", "| the claw that catches | us a step | Newton |"]
    text += ["|---|---:|---:|", *claw, ""]
    (out / "README.md").write_text("\n".join(text))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--limber", default=ROOT / "build/release/src/app/limber")
    parser.add_argument("--out", default=ROOT / "out/impact", type=pathlib.Path)
    options = parser.parse_args()
    out = options.out.resolve()
    work = ROOT / "out/impact-runs"
    for folder in (out, work):
        folder.mkdir(parents=True, exist_ok=True)
    runner = Runner(options.limber, out, work)
    bodies = {name: measure_body(runner, name) for name in BODIES}
    write_page(out, bodies, measure_restitution(runner), measure_claw(runner))


if __name__ == "__main__":
    main()
