#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random impacts through the public command, and how they end.

    bench/impact/random_impacts.py --limber build/release/src/app/limber
        [--number 1000] [--seed 1] [--only SEED,...] [--keep FOLDER] [--jobs 2]

Each draws two bodies: spheres, boxes, cylinders, capsules, collision meshes,
planes and flexible bars at any level; sizes, masses, moduli, speeds from 1e-4 to
100 m/s, friction, restitution and steps from a hundredth to thirty times the
impact's own duration. It must end with status 0, a touch, and an energy that
never rose by more than 0.5 %, or be refused in words (status 2 or 3) within
three minutes of processor time. Energy may rise where the run says that the
impact is too deep for Hertz's law; such runs are counted. A run that does not
end so is told at once.
"""
import argparse
import collections
import concurrent.futures
import json
import math
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
MOST_RISE = 0.005  # of the energy
MOST_SECONDS = 180  # of processor time
# Of warnings: too deep for Hertz's law, and energy that does not balance.
DEEP = "its force and energy are not reliable"
UNBALANCED = "energy error"
LEVELS = ("rigid", "uncoupled", "one-way", "coupled", "nonlinear", "full")
KNOWN = ("good", "refused", "too deep")
KINDS = ("sphere", "box", "cylinder", "capsule", "cube", "ball", "bar", "plane")
BAR_MASS = 7850.0 * 0.2 * 0.02 * 0.01
BAR_MODULUS = 210e9


def log_uniform(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def direction(rng):
    while True:
        x = [rng.uniform(-1.0, 1.0) for _ in range(3)]
        norm = math.hypot(*x)
        if 0.1 < norm < 1.0:
            return [c / norm for c in x]


def format_vector(x, factor=1.0):
    return "[" + ", ".join(f"{factor * c:.9g}" for c in x) + "]"


def make_cube():
    """Corners and triangles of a cube of edge 2."""
    corners = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2)]
    quads.append((1, 3, 7, 5))
    return corners, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def make_ball():
    """An icosahedron whose faces are divided twice, within the unit sphere."""
    g = (1 + math.sqrt(5)) / 2
    corners = []
    for a in (-1, 1):
        for b in (-g, g):
            corners += [(0, a, b), (a, b, 0), (b, 0, a)]
    corners = [tuple(c / math.hypot(*x) for c in x) for x in corners]
    edge = min(math.dist(corners[0], x) for x in corners[1:]) * 1.01
    faces = []
    for i, a in enumerate(corners):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                b, c = corners[j], corners[k]
                if max(math.dist(a, b), math.dist(b, c), math.dist(c, a)) > edge:
                    continue
                volume = sum(
                    a[n] * (b[n - 2] * c[n - 1] - b[n - 1] * c[n - 2])
                    for n in range(3)
                )
                faces.append((i, j, k) if volume > 0 else (i, k, j))
    for _ in range(2):
        corners, faces = divide(corners, faces)
    return corners, faces


def divide(corners, faces):
    corners, middles, divided = list(corners), {}, []

    def middle(i, j):
        key = (min(i, j), max(i, j))
        if key not in middles:
            x = [p + q for p, q in zip(corners[i], corners[j])]
            corners.append(tuple(c / math.hypot(*x) for c in x))
            middles[key] = len(corners) - 1
        return middles[key]

    for i, j, k in faces:
        a, b, c = middle(i, j), middle(j, k), middle(k, i)
        divided += [(i, a, c), (a, j, b), (c, b, k), (a, b, c)]
    return corners, divided


def write_obj(path, mesh, size):
    corners, faces = mesh
    lines = [f"v {size * x:.9g} {size * y:.9g} {size * z:.9g}" for x, y, z in corners]
    lines += [f"f {i + 1} {j + 1} {k + 1}" for i, j, k in faces]
    path.write_text("\n".join(lines) + "\n")


class Body:
    """A body of the draw, about `size` from its middle to its surface."""

    def __init__(self, rng, name, kind, size, mass):
        self.name, self.kind, self.size = name, kind, size
        self.mass = BAR_MASS if kind == "bar" else mass
        if kind == "bar":
            self.size = 0.01
        if kind == "plane":
            self.mass = math.inf
        self.modulus = BAR_MODULUS if kind == "bar" else log_uniform(rng, 1e6, 2e11)
        self.ratios = [rng.uniform(0.3, 1.0) for _ in range(2)]
        self.level = rng.choice(LEVELS) if kind == "bar" else None
        self.rpy = [rng.uniform(-3.0, 3.0) for _ in range(3)]
        if rng.random() < 0.25:
            self.rpy = [0.0, 0.0, 0.0]  # flat on flat, edge on edge

    def extent(self):
        """Of its points from its middle, at most [m]."""
        if self.kind == "bar":
            return 0.102
        return 0.0 if self.kind == "plane" else 2.5 * self.size

    def geometry(self, folder):
        a, b = self.ratios
        if self.kind == "sphere":
            return f"<sphere radius='{self.size:.9g}'/>"
        if self.kind == "box":
            edges = [2 * self.size, 2 * a * self.size, 2 * b * self.size]
            return "<box size='" + " ".join(f"{e:.9g}" for e in edges) + "'/>"
        if self.kind in ("cylinder", "capsule"):
            length = 4 * a * b * self.size
            return (
                f"<{self.kind} radius='{self.size:.9g}' length='{length:.9g}'/>"
            )
        path = folder / f"{self.name}.obj"
        write_obj(path, make_cube() if self.kind == "cube" else make_ball(), self.size)
        return f"<mesh filename='{path.name}'/>"

    def write(self, folder):
        if self.kind == "plane":
            return
        if self.kind == "bar":
            text = f"""<robot name="r"><link name="{self.name}"/>
<flexible link="{self.name}"><mesh file="{ROOT}/meshes/struck_bar.geo" size="0.01"/>
<material youngs_modulus="{BAR_MODULUS}" poisson_ratio="0.3" density="7850"/>
<basis eigenmodes="20"/></flexible></robot>"""
        else:
            inertia = 0.4 * self.mass * self.size**2
            text = f"""<robot name="r"><link name="{self.name}"><inertial>
<mass value="{self.mass:.9g}"/><inertia ixx="{inertia:.9g}" iyy="{inertia:.9g}"
izz="{inertia:.9g}" ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry>
{self.geometry(folder)}</geometry></collision></link><contact link="{self.name}"
youngs_modulus="{self.modulus:.9g}" poisson_ratio="0.3"/></robot>"""
        (folder / f"{self.name}.urdf").write_text(text)

    def scene(self, position, velocity, spin):
        if self.kind == "plane":
            return (
                f"[[obstacle]]\nname = '{self.name}'\nshape = 'plane'\n"
                f"position = [0.0, 0.0, 0.0]\nnormal = {format_vector(position)}\n"
                f"youngs_modulus = {self.modulus:.9g}\npoisson_ratio = 0.3\n"
            )
        return (
            f"[[robot]]\nname = '{self.name}'\nfile = '{self.name}.urdf'\n"
            f"position = {format_vector(position)}\nvelocity = "
            f"{format_vector(velocity)}\norientation_rpy = {format_vector(self.rpy)}\n"
            f"angular_velocity = {format_vector(spin)}\n"
        )

    def link(self):
        return self.name if self.kind == "plane" else f"{self.name}.{self.name}"


class Impact:
    """The draw of a seed."""

    def __init__(self, seed):
        rng = random.Random(f"impact {seed}")
        self.seed = seed
        kinds = [rng.choice(KINDS[:-1]), rng.choice(KINDS)]
        size = 0.01 if "bar" in kinds else log_uniform(rng, 1e-3, 1.0)
        mass = BAR_MASS if "bar" in kinds else log_uniform(rng, 1e-3, 10.0)
        ratio = log_uniform(rng, 1e-4, 1e4)
        # The first is struck, the second strikes; a plane is struck.
        relative = log_uniform(rng, 0.1, 10.0)
        self.B = Body(rng, "b", kinds[0], relative * size, ratio * mass)
        other = mass * ratio if kinds[0] == "bar" else mass
        self.A = Body(rng, "a", kinds[1], size, other)
        self.way = direction(rng)
        self.speed = log_uniform(rng, 1e-4, 100.0)
        slowest = min(self.A.size, self.B.size)
        turn = 0.1 * self.speed / max(slowest, self.B.extent())
        self.spin = [turn * rng.uniform(-1.0, 1.0) for _ in range(3)]
        self.friction = rng.choice((0.0, rng.uniform(0.0, 1.0)))
        self.restitution = rng.choice((1.0, rng.uniform(0.0, 1.0)))
        reduced = 1 / (1 / self.A.mass + 1 / self.B.mass)
        modulus = 1 / (0.91 / self.A.modulus + 0.91 / self.B.modulus)
        k = 4 / 3 * modulus * math.sqrt(slowest)
        self.duration = 3.218 * (reduced**2 / (k**2 * self.speed)) ** 0.2
        self.step = self.duration * log_uniform(rng, 0.01, 30.0)
        self.distance = 1.2 * (self.A.extent() + self.B.extent())

    def describe(self):
        A, B = self.A, self.B
        levels = "".join(f" {b.level}" for b in (A, B) if b.level)
        return (
            f"{B.kind} on {A.kind}{levels}, sizes {B.size:.3g} {A.size:.3g} m, masses "
            f"{B.mass:.3g} {A.mass:.3g} kg, moduli {B.modulus:.2g} {A.modulus:.2g}, "
            f"{self.speed:.3g} m/s, friction {self.friction:.2g}, restitution "
            f"{self.restitution:.2g}, steps {self.step / self.duration:.2g} T_c"
        )

    def write(self, folder, times):
        level = next((b.level for b in (self.A, self.B) if b.level), "rigid")
        for body in (self.A, self.B):
            body.write(folder)
        start = [self.distance * c for c in self.way]
        origin = self.way if self.A.kind == "plane" else [0.0, 0.0, 0.0]
        text = (
            self.A.scene(origin, [0.0] * 3, [0.0] * 3)
            + self.B.scene(start, [-self.speed * c for c in self.way], self.spin)
            + f"[[contact]]\nbetween = ['{self.A.link()}', '{self.B.link()}']\n"
            f"friction = {self.friction:.9g}\nrestitution = {self.restitution:.9g}\n"
            f"[fidelity]\ndefault = '{level}'\n[output]\npictures = false\n"
            + times
        )
        (folder / "scene.toml").write_text(text)


def run(limber, folder, cache):
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS))

    result = subprocess.run(
        [limber, "run", "scene.toml", "--json", "--out", "out", "--cache", cache],
        cwd=folder, capture_output=True, text=True, check=False, preexec_fn=limit,
    )
    return result


def judge(result, must_touch=True):
    """"good", "refused", "too deep" or what is wrong, and the run's summary."""
    if result.returncode in (2, 3):
        lines = [x for x in result.stderr.splitlines() if "error" in x] or [""]
        words = lines[-1].split("error:")[-1].strip()
        return ("refused: " + words) if words else "refused without words", {}
    if result.returncode < 0:
        return f"ended by signal {-result.returncode}", {}
    if result.returncode != 0:
        return f"status {result.returncode}: {result.stderr[-300:]}", {}
    summary = json.loads(result.stdout)
    energy = summary["energy"]
    rise = energy["peaks"]["stored"]["value"] / energy["initial"] - 1.0
    if not rise <= MOST_RISE:
        if DEEP in result.stderr:
            return "too deep", summary
        is_told = UNBALANCED in result.stderr
        told = "as the run says" if is_told else "without a word"
        return f"energy rose by {100 * rise:.3g} %, {told}", summary
    if must_touch and not summary["contacts"]:
        return "passed through", summary
    return "good", summary


def examine(limber, seed, cache, keep):
    """Two runs of a draw: with steps of its way, and with its own."""
    impact = Impact(seed)
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(keep or temporary) / str(seed)
        folder.mkdir(parents=True, exist_ok=True)
        end = 1.5 * impact.distance / impact.speed
        long_step = end / 20
        impact.write(
            folder, f"[time]\nduration = {end:.9g}\nstep = {long_step:.9g}\n"
        )
        verdict, summary = judge(run(limber, folder, cache))
        verdicts = [("long steps", verdict)]
        touch = min((c["time"] for c in summary.get("contacts", [])), default=None)
        if touch is not None:
            begin = max(touch - 5 * impact.step, 0.1 * touch)
            # A touch is told up to 1e-4 of a step's way before it.
            late = 2e-4 * long_step
            end = touch + late + 10 * impact.step + 10 * impact.duration
            count = min(max(round((end - begin) / impact.step), 1), 20000)
            impact.write(
                folder,
                f"[time]\nduration = {end:.12g}\nsteps = {{ from = [0.0, {begin:.12g}],"
                f" size = [{begin / 10:.9g}, {(end - begin) / count:.9g}] }}\n",
            )
            verdict, _ = judge(run(limber, folder, cache))
            verdicts.append(("steps of its own", verdict))
    return seed, impact.describe(), verdicts


def include(seed, words, verdicts, tally, refusals):
    for steps, verdict in verdicts:
        kind = verdict.split(":")[0]
        tally[kind if kind in KNOWN else "failed"] += 1
        if verdict.startswith("refused: "):
            refusals[f"{words.split(',')[0]}: {verdict[9:160]}"] += 1
        elif kind not in KNOWN:
            print(f"seed {seed}, {steps}: {verdict}; {words}", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Random impacts: how they end")
    parser.add_argument("--limber", required=True, type=pathlib.Path)
    parser.add_argument("--number", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1, help="the first")
    parser.add_argument("--only", help="these seeds, in place of a row of them")
    parser.add_argument("--keep", help="folder for the scenes")
    parser.add_argument("--cache", help="folder of reduced bodies")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    seeds = range(options.seed, options.seed + options.number)
    if options.only:
        seeds = [int(s) for s in options.only.split(",")]
    tally, refusals = collections.Counter(), collections.Counter()
    with tempfile.TemporaryDirectory() as temporary:
        cache = pathlib.Path(options.cache or temporary).resolve()
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            jobs = [
                pool.submit(examine, options.limber.resolve(), s, cache, options.keep)
                for s in seeds
            ]
            try:
                for job in jobs:
                    include(*job.result(), tally, refusals)
            except KeyboardInterrupt:
                pool.shutdown(wait=False, cancel_futures=True)
                print("stopped; of the seeds before:")
    for text, count in refusals.most_common():
        print(f"{count:4} refused, {text}")
    print(", ".join(f"{n} {kind}" for kind, n in sorted(tally.items())))
    return 1 if tally["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
