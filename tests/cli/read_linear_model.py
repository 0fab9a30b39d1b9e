# SPDX-License-Identifier: BSD-3-Clause
"""Linearises scenarios and opens the models with SciPy and NumPy.

usage: read_linear_model.py LIMBER FOLDER
"""

import json
import pathlib
import subprocess
import sys

import numpy
import scipy.io
import scipy.linalg

ROBOT = """<robot name='r'><link name='world'/>
<link name='upper'><inertial><origin xyz='0.2 0 0'/><mass value='2'/><inertia ixx='0.02'
 iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<link name='lower'><inertial><origin xyz='0.3 0 0'/><mass value='1'/><inertia ixx='0.01'
 iyy='0.05' izz='0.05' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='shoulder' type='continuous'><parent link='world'/><child link='upper'/>
 <axis xyz='0 0 1'/></joint>
<joint name='elbow' type='continuous'><origin xyz='0.4 0 0'/><parent link='upper'/>
 <child link='lower'/><axis xyz='0 0 1'/></joint>
<coupler joint='shoulder' translational_stiffness='4e7' rotational_stiffness='2e6'/>
<coupler joint='elbow' translational_stiffness='4e7' rotational_stiffness='2e6'/></robot>
"""

SCENARIO = """robot = 'robot.urdf'
[time]
duration = 0.5
step = 0.0005
output_interval = 0.5
[output]
pictures = false
[[drive]]
joint = 'shoulder'
mode = 'position'
stiffness = 200.0
damping = 1.0
signal = { kind = 'constant', value = 0.0 }
[[drive]]
joint = 'elbow'
mode = 'position'
stiffness = 80.0
damping = 0.5
signal = { kind = 'constant', value = 0.0 }
[[load]]
name = 'push'
link = 'lower'
point = [0.6, 0.0, 0.0]
force = [0.0, 1e-5, 0.0]
time = { kind = 'steps', times = [0.1], values = [1.0] }
[[probe]]
name = 'tip'
link = 'lower'
point = [0.6, 0.0, 0.0]
[[probe]]
name = 'hold'
coupler = 'elbow'
quantity = 'effort'
[[probe]]
name = 'energy'
coupler = 'elbow'
quantity = 'energy'
"""

KEYS = ["A", "B", "C", "D", "u0", "y0"]


def run(limber, folder, *arguments):
    done = subprocess.run([limber, *arguments], cwd=folder, check=True, capture_output=True, text=True)
    return done.stdout, done.stderr


def text_list(cells):
    return [str(cell) for cell in numpy.atleast_1d(cells)]


def read_all(folder, name):
    mat = scipy.io.loadmat(folder / (name + ".mat"), squeeze_me=False)
    npz = numpy.load(folder / (name + ".npz"))
    with open(folder / (name + ".json"), encoding="utf-8") as file:
        plain = json.load(file)
    for key in KEYS:
        assert numpy.array_equal(mat[key], npz[key]), key
        assert numpy.array_equal(mat[key], numpy.array(plain[key])), key
    for key in ["input_names", "output_names", "output_units", "state_names"]:
        names = [str(cell[0][0]) if cell[0].size else "" for cell in mat[key]]
        assert names == list(npz[key]) == plain[key], (key, names, npz[key], plain[key])
    return npz


def check_step(limber, folder, model):
    """The step of the load against the nonlinear run."""
    a, b, c = model["A"], model["B"], model["C"]
    n = a.shape[0]
    push = list(model["input_names"]).index("push")
    whole = numpy.zeros((n + 1, n + 1))
    whole[:n, :n] = a
    whole[:n, n] = b[:, push]
    z = scipy.linalg.expm(0.4 * whole)[:n, n]
    y = dict(zip(model["output_names"], c @ z + model["D"][:, push]))
    out, _ = run(limber, folder, "run", "s.toml", "--out", "o", "--json", "--set",
                 "time.integrator=runge-kutta-4", "--set", "time.step=2e-5")
    probes = json.loads(out)["probes"]
    for name in ["tip.uy", "hold.effort"]:
        true = probes[name]["final"]
        assert abs(true) > 1e-9, (name, true)
        assert abs(y[name] - true) < 1e-6 * abs(true), (name, y[name], true)


def check_frequencies(limber, folder, model):
    out, _ = run(limber, folder, "frequencies", "s.toml", "--json", "--count", "50")
    values = scipy.linalg.eigvals(model["A"])
    modes = [m for m in json.loads(out)["modes"] if not m["moves_freely"]]
    assert modes
    for mode in modes:
        s = complex(mode["growth_rate"], 2.0 * numpy.pi * mode["damped_frequency"])
        assert numpy.min(numpy.abs(values - s)) < 1e-9 * abs(s), s


def check_truncation(limber, folder, full):
    run(limber, folder, "linearize", "s.toml", "-o", "few.npz", "--states", "4",
        "--inputs", "push", "--outputs", "tip.uy")
    few = numpy.load(folder / "few.npz")
    assert few["A"].shape == (4, 4)
    row = list(full["output_names"]).index("tip.uy")
    column = list(full["input_names"]).index("push")
    # Hankel singular values by SciPy's own Lyapunov equations.
    a, b, c = full["A"], full["B"][:, [column]], full["C"][[row], :]
    p = scipy.linalg.solve_continuous_lyapunov(a, -b @ b.T)
    q = scipy.linalg.solve_continuous_lyapunov(a.T, -c.T @ c)
    hankel = numpy.sort(numpy.sqrt(numpy.abs(scipy.linalg.eigvals(p @ q))))[::-1]
    found = few["hankel_singular_values"][:, 0]
    assert numpy.all(numpy.abs(found - hankel)[:2] < 1e-6 * hankel[0]), (found, hankel)
    bound = few["error_bound"][0, 0]
    for w in numpy.logspace(-1, 3, 400):
        def gain(a, b, c, d):
            return c @ numpy.linalg.solve(1j * w * numpy.eye(len(a)) - a, b) + d
        gap = gain(a, b, c, full["D"][row, column]) - gain(few["A"], few["B"], few["C"], few["D"])
        assert numpy.abs(gap[0, 0]) <= bound * (1.0 + 1e-6) + 1e-12 * hankel[0], (w, gap, bound)


def main():
    limber, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "robot.urdf").write_text(ROBOT)
    (folder / "s.toml").write_text(SCENARIO)
    for ending in ["mat", "npz", "json"]:
        _, errors = run(limber, folder, "linearize", "s.toml", "-o", "full." + ending)
        assert "'energy.energy' can not be linear" in errors, errors
    model = read_all(folder, "full")
    assert list(model["input_names"]) == ["push", "shoulder", "shoulder.rate", "elbow", "elbow.rate"]
    assert list(model["output_names"]) == ["tip.ux", "tip.uy", "tip.uz", "hold.effort"]
    check_frequencies(limber, folder, model)
    check_step(limber, folder, model)
    check_truncation(limber, folder, model)


main()
