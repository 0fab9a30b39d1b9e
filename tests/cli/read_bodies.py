# SPDX-License-Identifier: BSD-3-Clause
"""Exports reduced bodies and opens the files with SciPy, and by the formats' descriptions.

usage: read_bodies.py LIMBER SOURCE FOLDER
"""

import json
import pathlib
import shutil
import subprocess
import sys

import numpy as np
import scipy.io
import scipy.linalg

ROBOT = """<robot name='r'><link name='world'/><link name='arm'/>
<joint name='root' type='revolute'><parent link='world'/><child link='arm'/><axis xyz='0 0 1'/>
 <limit effort='100' velocity='10'/></joint>
<flexible link='arm'><matrices path='{path}' mass='{mass}'/><basis eigenmodes='{modes}'/>
 <interface name='root' node='{root}'/><interface name='tip' node='{tip}'/></flexible></robot>
"""
SCENARIO = """robot = '{robot}.urdf'
[time]
duration = 0.05
step = 0.0005
[gravity]
acceleration = [0.0, -9.81, 0.0]
[fidelity]
default = 'coupled'
[output]
pictures = false
[[load]]
name = 'push'
link = 'arm'
interface = 'tip'
force = [0, 0, 20]
[[probe]]
name = 'tip'
link = 'arm'
interface = 'tip'
[[probe]]
name = 'bend'
link = 'arm'
interface = 'tip'
quantity = 'deformation'
"""
BOX = """SetFactory("OpenCASCADE");
Box(1) = {0.1, -0.2, 0.05, 1.0, 0.08, 0.05};
MeshSize {:} = 0.08;
Physical Volume("bar") = {1};
Physical Surface("root") = {1};
Physical Surface("tip") = {2};
"""
RATIO = 0.02


def hat(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def close(found, expected, tolerance, what):
    found, expected = np.asarray(found), np.asarray(expected)
    error = abs(found - expected).max() / abs(expected).max()
    assert error < tolerance, (what, error)


class Command:
    def __init__(self, limber, folder):
        self.limber, self.folder = limber, folder

    def run(self, *arguments, status=0):
        done = subprocess.run([self.limber, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        assert done.returncode == status, (arguments, done.returncode, done.stderr)
        return done.stdout if status == 0 else done.stderr


class Arch:
    """The whole model, by SciPy alone."""

    def __init__(self, folder):
        self.K = scipy.io.mmread(folder / "K.mtx").toarray()
        self.M = scipy.io.mmread(folder / "M.mtx").toarray()
        self.x = np.loadtxt(folder / "nodes.csv", delimiter=",", skiprows=1)[:, 1:4]
        values, self.modes = scipy.linalg.eigh(self.K, self.M)
        self.squares = values[6:]
        self.modes = self.modes[:, 6:]
        self.mass = self.M[0::6, 0::6].sum()


def check_simscape(command, arch):
    """Craig and Bampton's form: origins, rigid motion, Guyan's stiffness, frequencies, damping."""
    command.run("export", "arch.h5", "-o", "arch.mat", "--damping-ratio", RATIO)
    mat = scipy.io.loadmat(command.folder / "arch.mat")
    K, M, D, P = (mat[name] for name in "KMDP")
    close(P, arch.x[[0, 12]], 1e-12, "origins")
    assert [str(cell[0][0]) for cell in mat["interfaces"]] == ["node:1", "node:13"]
    assert np.array_equal(K, K.T) and np.array_equal(M, M.T) and np.array_equal(D, D.T)
    X = np.zeros((len(K), 6))
    for i, p in enumerate(P):
        X[6 * i:6 * i + 6] = np.block([[np.eye(3), -hat(p)], [np.zeros((3, 3)), np.eye(3)]])
    assert abs(K @ X).max() < 1e-7 * abs(K).max()
    whole = np.vstack([np.block([[np.eye(3), -hat(p)], [np.zeros((3, 3)), np.eye(3)]]) for p in arch.x])
    close(X.T @ M @ X, whole.T @ arch.M @ whole, 1e-9, "rigid mass")
    ends = np.r_[0:6, 72:78]
    inner = np.r_[6:72]
    guyan = arch.K[np.ix_(ends, ends)] - arch.K[np.ix_(ends, inner)] @ np.linalg.solve(
        arch.K[np.ix_(inner, inner)], arch.K[np.ix_(inner, ends)])
    close(K[:12, :12], guyan, 1e-6, "stiffness of the ends")
    assert abs(K[:12, 12:]).max() < 1e-6 * abs(K).max()
    values, modes = scipy.linalg.eigh(K, M)
    close(values[6:12], arch.squares[:6], 1e-8, "frequencies")
    damping = np.diag(modes.T @ D @ modes)[6:]
    close(damping, 2 * RATIO * np.sqrt(values[6:]), 1e-6, "damping")


def read_42(file):
    """In the order of 42's InitFlexModes."""
    lines = iter(file.read_text().splitlines())

    def fields():
        return next(lines).split("!")[0].split()

    def entries(shape):
        next(lines)
        values = np.zeros(shape)
        for _ in range(int(fields()[0])):
            *at, value = fields()
            values[tuple(map(int, at))] = float(value)
        return values
    next(lines), next(lines)
    m = int(fields()[0])
    next(lines)
    for _ in range(m):
        assert len(fields()) == 2
    found = {"modes": m}
    for name, shape in (("joint PSI", (m, 9, 3)), ("joint THETA", (m, 9, 3)), ("PSI", (m, 9, 3)), ("THETA", (m, 9, 3)),
                        ("M", (m, m)), ("K", (m, m)), ("C", (m, m))):
        found[name] = entries(shape)
    for name in ("P", "H"):
        next(lines)
        found[name] = np.array([list(map(float, fields())) for _ in range(m)])
    found["L"] = entries((3, 3, m))
    found["N"] = entries((3, 3, m, m))
    assert next(lines, None) is None
    return found


def check_42(command, arch):
    command.run("export", "arch.h5", "-o", "Flex_arch.txt", "--damping-ratio", RATIO)
    flex = read_42(command.folder / "Flex_arch.txt")
    squares = np.diag(flex["K"])
    close(squares[:6], arch.squares[:6], 1e-8, "frequencies")
    close(np.diag(flex["C"]), 2 * RATIO * np.sqrt(squares), 1e-12, "damping")
    assert np.array_equal(flex["M"], np.eye(flex["modes"]))
    ends = arch.modes.reshape(13, 6, -1)[[0, 12]]
    for k in range(6):
        shape = np.hstack([flex["PSI"][k, :2], flex["THETA"][k, :2]])
        sign = np.sign((shape * ends[:, :, k]).sum())
        close(sign * shape, ends[:, :, k], 1e-6, "shapes")
    # Of lumped masses, whose rotary inertia is small.
    masses = np.diag(arch.M)[0::6]
    x = arch.x - masses @ arch.x / masses.sum()
    for k in range(3):
        u = arch.modes.reshape(13, 6, -1)[:, :3, k]
        close(flex["N"][:, :, k, k], np.einsum("n,na,nb->ab", masses, u, u), 1e-2, "N")
        L = np.einsum("n,na,nb->ab", masses, x, u)
        sign = np.sign((flex["L"][:, :, k] * L).sum())
        close(sign * flex["L"][:, :, k], L, 1e-2, "L")
    nodes = (command.folder / "Flex_arch.yaml").read_text()
    assert nodes.count("- Node:") == 2 and "Comment: node:13" in nodes


def read_universal(file):
    """Datasets by number, each a list of lists of lines."""
    datasets = {}
    lines = file.read_text().splitlines()
    at = 0
    while at < len(lines):
        assert lines[at] == "    -1", at
        end = lines.index("    -1", at + 1)
        datasets.setdefault(int(lines[at + 1][:6]), []).append(lines[at + 2:end])
        at = end + 1
    return datasets


def cut(line, width):
    return [line[i:i + width] for i in range(0, len(line), width)]


def check_universal(command, arch):
    for name, number in (("arch.unv", 2411), ("arch.uff", 15)):
        command.run("export", "arch.h5", "-o", name, "--damping-ratio", RATIO)
        datasets = read_universal(command.folder / name)
        (nodes,) = datasets[number]
        if number == 15:
            x = np.array([[float(f) for f in cut(line[40:], 13)] for line in nodes])
        else:
            x = np.array([[float(f) for f in cut(line, 25)] for line in nodes[1::2]])
        assert abs(x - arch.x).max() < (1e-12 if number == 2411 else 1e-5)
        for k, mode in enumerate(datasets[55][:6]):
            assert [int(f) for f in cut(mode[5], 10)] == [1, 2, 2, 8, 2, 3]
            assert [int(f) for f in cut(mode[6], 10)] == [2, 4, 0, k + 1]
            frequency, mass, ratio, _ = (float(f) for f in cut(mode[7], 13))
            assert abs(2 * np.pi * frequency / np.sqrt(arch.squares[k]) - 1) < 1e-5
            assert abs(ratio - RATIO) < 1e-6
            u = np.array([[float(f) for f in cut(line, 13)] for line in mode[9::2]])
            expected = arch.modes.reshape(13, 6, -1)[:, :3, k]
            expected = expected * np.sqrt(mass)
            sign = np.sign((u * expected).sum())
            assert abs(sign * u - expected).max() < 2e-5


def move(command, name, **body):
    (command.folder / (name + ".urdf")).write_text(ROBOT.format(**body))
    (command.folder / (name + ".toml")).write_text(SCENARIO.format(robot=name))
    out = command.run("run", name + ".toml", "--out", name + "_out", "--cache", name + "_cache", "--json")
    return json.loads(out)["probes"]


def check_motion(a, b):
    assert set(a) == set(b)
    sizes = {}
    for name in a:
        group = name.split(".")[0]
        sizes[group] = max(sizes.get(group, 0.0), abs(a[name]["final"]))
    for name in a:
        error = abs(a[name]["final"] - b[name]["final"])
        assert error < 1e-8 * sizes[name.split(".")[0]], (name, a[name]["final"], b[name]["final"])


def check_matrices(command, arch, source):
    """Out and in again the body moves the same."""
    command.run("export", "arch.h5", "-o", "arch_out")
    modes = len((command.folder / "arch_out/rows.csv").read_text().splitlines()) - 7
    before = move(command, "before", path=source, mass=arch.mass, modes=6, root=1, tip=13)
    after = move(command, "after", path="arch_out", mass=arch.mass, modes=modes, root=14, tip=15)
    assert abs(before["bend.dz"]["final"]) > 1e-5
    check_motion(before, after)


def check_mesh(command):
    """A body of a mesh, too."""
    (command.folder / "box.geo").write_text(BOX)
    mesh = ["box.geo", "--youngs-modulus", 7e10, "--poisson-ratio", 0.33, "--density", 2700]
    reduce = ["--modes", 6, "--interface", "root", "--interface", "tip", "--rows", "boundary"]
    command.run("reduce", *mesh, *reduce, "-o", "box.h5")
    command.run("export", "box.h5", "-o", "box_out")
    last = int((command.folder / "box_out/nodes.csv").read_text().splitlines()[-1].split(",")[0])
    mass = 1.0 * 0.08 * 0.05 * 2700
    modes = len((command.folder / "box_out/rows.csv").read_text().splitlines()) - 7
    after = move(command, "box_after", path="box_out", mass=mass, modes=modes, root=last - 1, tip=last)
    robot = (command.folder / "box_after.urdf").read_text()
    start, end = robot.index("<matrices"), robot.index("<interface")
    robot = (robot[:start] + "<mesh file='box.geo'/><material youngs_modulus='7e10' poisson_ratio='0.33' "
             "density='2700'/><basis eigenmodes='6'/><interface name='root' group='root'/>"
             "<interface name='tip' group='tip'/></flexible></robot>")
    (command.folder / "box_before.urdf").write_text(robot)
    (command.folder / "box_before.toml").write_text(SCENARIO.format(robot="box_before"))
    before = json.loads(command.run("run", "box_before.toml", "--out", "box_before_out", "--cache", "box_cache", "--json"))
    check_motion(before["probes"], after)


def check_refusals(command):
    assert "no extension" in command.run("export", "arch.h5", "-o", "arch.csv", status=2)
    assert "has no damping" in command.run("export", "arch.h5", "-o", "a", "--damping-ratio", 0.1, status=2)
    command.run("reduce", "--matrices", "source", "--mass", command.mass, "--clamp", "node:1", "-o", "held.h5")
    for name in ("a", "a.mat", "a.txt"):
        assert "is clamped" in command.run("export", "held.h5", "-o", name, status=2)
    command.run("reduce", "--matrices", "source", "--mass", command.mass, "-o", "bare.h5")
    assert "has no interface" in command.run("export", "bare.h5", "-o", "a.mat", status=2)


def main():
    limber, source, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    shutil.copytree(source / "tests/data/matrices/arch", folder / "source")
    arch = Arch(folder / "source")
    command = Command(limber, folder)
    command.mass = arch.mass
    command.run("reduce", "--matrices", "source", "--mass", arch.mass, "--modes", 6, "--interface", "node:1",
                "--interface", "node:13", "--rows", "all", "-o", "arch.h5")
    check_simscape(command, arch)
    check_42(command, arch)
    check_universal(command, arch)
    check_matrices(command, arch, "source")
    check_mesh(command)
    check_refusals(command)


main()
