# SPDX-License-Identifier: BSD-3-Clause
"""Mutated scenarios, robots, geometries and meshes; geometries with orders."""

import shutil
from pathlib import Path
from random import Random

import scene
from mutate import mutate_text

# One in so many that give an answer is asked again, without the cache.
ASKED_AGAIN = 20


def _repeats(limber, words, ended, random):
    """Whether a second run, from scratch, gives the same answer."""
    if ended.status != 0 or random.randrange(ASKED_AGAIN):
        return []
    again = limber.run(*words[:-2], "--out", "fresh", "--cache", "fresh_cache")
    if again.status != 0:
        return [f"status {again.status} when it is run again"]
    differs = scene.answers_differ(limber.place / "out", limber.place / "fresh")
    return [f"run again: {differs}"] if differs else []


def _mutated(*choices):
    """@param choices files that are mutated by turns, and the scenes they are of"""

    def attack(seed, limber):
        name, owner = choices[seed % len(choices)]
        words = scene.run_words(owner)
        random = Random(f"{name} {seed}")
        scene.lay_out(limber.place)
        text = mutate_text(scene.read(name), random)
        (limber.place / name).write_bytes(text.encode(errors="replace"))
        ended = limber.run(*words)
        ended.problems += _repeats(limber, words, ended, random)
        return ended

    return attack


attack_scenario = _mutated(("arm.toml", "arm"), ("craft.toml", "craft"))
attack_robot = _mutated(("arm.urdf", "arm"), ("rover.urdf", "craft"),
                        ("arm.urdf", "arm"), ("pod.urdf", "craft"))
attack_geometry = _mutated(("bar.geo", "arm"))
attack_shape = _mutated(("block.stl", "craft"), ("wedge.obj", "craft"),
                        ("nodes.txt", "craft"), ("u.txt", "craft"))

BEAM = """robot = "beam.urdf"
[time]
duration = 0.01
step = 1e-4
[output]
pictures = false
"""
BEAM_ROBOT = """<robot name="beam"><link name="B"/><flexible link="B">
<mesh file="beam.msh"/>
<material youngs_modulus="70e9" poisson_ratio="0.33" density="2700"/>
<basis eigenmodes="4"/></flexible></robot>
"""


def attack_mesh(seed, limber):
    random = Random(f"mesh {seed}")
    text = mutate_text(scene.MESH.read_text(), random)
    (limber.place / "beam.msh").write_bytes(text.encode(errors="replace"))
    (limber.place / "beam.urdf").write_text(BEAM_ROBOT)
    (limber.place / "beam.toml").write_text(BEAM)
    words = ["run", "beam.toml", "--out", "out"]
    ended = limber.run(*words)
    ended.problems += _repeats(limber, words, ended, random)
    return ended


MATRICES = Path(__file__).resolve().parents[1] / "data" / "matrices"
# Of the whole model [kg].
MASSES = {"arch": 7.4186889, "beam": 4.68, "beam_lumped": 4.68, "beam_mm": 4.68e-3,
          "superelement": 7.4, "calculix_beam": 11.9317, "calculix_fold": 780.0,
          "calculix_shell": 63.6358, "calculix_spider": 193.6}


def attack_matrices(seed, limber):
    """One file of a model by its matrices, in each form by turns."""
    random = Random(f"matrices {seed}")
    samples = sorted(path.name for path in MATRICES.iterdir() if path.is_dir())
    sample = samples[seed % len(samples)]
    folder = limber.place / "matrices"
    shutil.copytree(MATRICES / sample, folder)
    choices = sorted(path for path in folder.rglob("*") if path.is_file())
    file = random.choice(choices)
    text = mutate_text(file.read_text(), random)
    file.write_bytes(text.encode(errors="replace"))
    words = ["modes", "--matrices", "matrices", "--mass", str(MASSES.get(sample, 1.71335)), "--count", "2"]
    if sample == "superelement":
        words += ["--recovery", "matrices/recovery/otm.mtx", "matrices/recovery/points.csv"]
    return limber.run(*words)


TESTS = Path(__file__).resolve().parents[1]
DECKS = [path for folder, suffix in
         (("data/structures", ""), ("fuzz/corpus/bulk_structure", ".bdf"), ("fuzz/corpus/input_structure", ".inp"))
         for path in sorted((TESTS / folder).iterdir()) if path.suffix in (".bdf", ".inp") or suffix]


def attack_deck(seed, limber):
    """A deck of beams, shells, solids and rigid parts."""
    random = Random(f"deck {seed}")
    deck = DECKS[seed % len(DECKS)]
    suffix = deck.suffix or (".bdf" if "bulk" in deck.parent.name else ".inp")
    text = mutate_text(deck.read_text(errors="replace"), random)
    (limber.place / f"deck{suffix}").write_bytes(text.encode(errors="replace"))
    return limber.run("modes", f"deck{suffix}", "--count", "2")


PANEL = """\
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Point(5) = {0.5, 0, 0.5};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {2, 5};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Recombine Surface {1};
Physical Surface("skin") = {1};
Physical Curve("mast") = {5};
"""
SECTIONS = [
    ("--material", 'group="cfrp" youngs_modulus="140e9 9e9 9e9" poisson_ratio="0.3 0.3 0.4" '
                   'shear_modulus="5e9 5e9 3e9" density="1600"'),
    ("--material", 'youngs_modulus="70e9" poisson_ratio="0.33" density="2700"'),
    ("--shell", 'group="skin" thickness="0.001 0.002" angles="0 30" materials="cfrp" axis_1="1 0 0" offset="0.001"'),
    ("--beam", 'group="mast" section="box" height="0.03" width="0.02" flange="0.002" web="0.001" y_axis="0 1 0"')]


def attack_sections(seed, limber):
    """Sections on groups of a geometry: the geometry, or one of its regions."""
    random = Random(f"sections {seed}")
    regions = list(SECTIONS)
    geometry = PANEL
    if seed % 3 == 0:
        geometry = mutate_text(PANEL, random)
    else:
        at = random.randrange(len(regions))
        # An argument has no zero byte and is shorter than 128 KiB.
        regions[at] = (regions[at][0], mutate_text(regions[at][1], random).replace("\0", "0")[:100000])
    (limber.place / "panel.geo").write_bytes(geometry.encode(errors="replace"))
    words = [word for region in regions for word in region]
    return limber.run("modes", "panel.geo", "--size", "0.25", "--count", "2", *words)


# Each tries to leave a file or a process behind, or never to end.
ORDERS = [
    'SystemCall "touch canary";',
    'System "touch canary";',
    'NonBlockingSystemCall "sleep 1000";',
    'NonBlockingSystemCall "touch canary";',
    'OnelabRun("touch", "canary");',
    'Printf("canary") > "canary";',
    'Printf("canary") >> "canary";',
    'Save "canary.msh";',
    'Print "canary.msh";',
    'Print.Background = 1; Print "canary.png";',
    "Exit;",
    "Abort;",
    "Sleep 1000;",
    "General.NumThreads = 100000;",
    "Mesh.MaxNumThreads3D = 100000;",
    "l() = {0:1e12:1};",
    "For i In {0:1e12} x = i; EndFor",
    'Macro Loop\n Call Loop;\nReturn\nCall Loop;',
    'Include "bar.geo";',
    'Merge "bar.geo";',
    'Merge "/dev/zero";',
    'Merge "/dev/stdin";',
    'Merge "fifo";',
    'Include "/proc/self/environ";',
    "Mesh.MeshSizeMax = 1e-7; Mesh.MeshSizeMin = 1e-8;",
    "layers = 1000000000;",
    "Delete Model;",
    "Delete All;",
    "Mesh.Algorithm = -1;",
    "Mesh.ElementOrder = 1000;",
    'DefineConstant[ x = {1, Name "x", ServerAction "ResetDatabase"} ];',
    'SetChanged; Background Mesh View[0];',
    'Plugin(Skin).Run;',
    'Draw;',
    'General.OptionsFileName = "canary"; Save Options "canary";',
    'CreateDir "canary";',
    'UnixSystemCall "touch canary";',
    "Error('stop');",
]


def attack_order(number, limber):
    """An order before and after the geometry, in a .geo and in a .msh."""
    import os

    scene.lay_out(limber.place)
    os.mkfifo(limber.place / "fifo")
    order = ORDERS[number // 3]
    where = number % 3
    bar = scene.read("bar.geo")
    if where == 0:
        (limber.place / "bar.geo").write_text(order + "\n" + bar)
    elif where == 1:
        (limber.place / "bar.geo").write_text(bar + "\n" + order + "\n")
    else:
        (limber.place / "bar.msh").write_text(bar + "\n" + order + "\n")
        robot = scene.read("arm.urdf").replace("bar.geo", "bar.msh")
        (limber.place / "arm.urdf").write_text(robot)
    ended = limber.run(*scene.run_words("arm"))
    for found in limber.place.rglob("canary*"):
        ended.problems.append(f"wrote {found.relative_to(limber.place)}")
    return ended


ORDER_COUNT = 3 * len(ORDERS)
