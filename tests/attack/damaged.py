# SPDX-License-Identifier: BSD-3-Clause
"""Damaged bodies, checkpoints and results; resumes of a changed scene."""

import re
import shutil
import signal
import time
from functools import cache
from random import Random

import scene
from command import Limber
from mutate import mutate_bytes

RUN = scene.run_words("arm")
RESUME = [*RUN, "--resume"]
KILL_WITHIN = 60.0  # s


def _is_kept(out):
    """Whether a checkpoint that can be resumed is there."""
    return (out / "checkpoint.bin").exists()


def interrupt_run(limber, words=RUN, by=signal.SIGKILL):
    """Starts a run that keeps checkpoints and ends it once there is one."""
    child = limber.start(*words, "--checkpoint-interval", "0")
    begin = time.monotonic()
    while not _is_kept(limber.place / "out") and child.poll() is None:
        if time.monotonic() - begin > KILL_WITHIN:
            break
        time.sleep(0.001)
    child.send_signal(by)
    child.communicate()
    return _is_kept(limber.place / "out")


@cache
def _prepare(program, folder, stock, name):
    """Made once by each worker: a run cut short, a body, and an answer."""
    place = stock / f"prepared_{name}"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    limber = Limber(program, place, folder)
    scene.lay_out(place)
    for _ in range(20):
        if interrupt_run(limber, scene.run_words(name)):
            break
        shutil.rmtree(place / "out", ignore_errors=True)
    else:
        raise RuntimeError("no run could be cut short: is the scene too short?")
    whole = limber.run(*scene.run_words(name, "whole"))
    body = limber.run("reduce", "bar.geo", *scene.MATERIAL,
                      "-o", "body.h5")
    for ended in (whole, body):
        if ended.status != 0:
            raise RuntimeError(f"nothing to damage: {ended.errors}")
    return place


def prepare(limber, name="arm"):
    return _prepare(limber.program, limber.cache, limber.cache.parent, name)


def damage(file, random):
    file.write_bytes(mutate_bytes(file.read_bytes(), random))


def attack_body(seed, limber):
    """`info` answers or refuses; the body's own seal says which."""
    shutil.copy(prepare(limber) / "body.h5", limber.place)
    damage(limber.place / "body.h5", Random(f"body {seed}"))
    ended = limber.run("info", "body.h5")
    if ended.status == 0:
        ended.problems.append("a damaged body was read")
    return ended


LOOKS = [["info", "out/results.h5"], ["view", "out"],
         ["export", "out", "-o", "out/scene.glb"]]


def attack_results(seed, limber):
    """Nothing seals results: what looks at them may answer, but must end in words."""
    random = Random(f"results {seed}")
    name = random.choice(scene.SCENES)
    shutil.copytree(prepare(limber, name) / "whole", limber.place / "out")
    damage(limber.place / "out" / "results.h5", random)
    return limber.run(*random.choice(LOOKS))


def attack_checkpoint(seed, limber):
    """A damaged file of a run under way is refused, or does not matter."""
    random = Random(f"checkpoint {seed}")
    name = random.choice(scene.SCENES)
    prepared = prepare(limber, name)
    scene.lay_out(limber.place)
    out = limber.place / "out"
    shutil.copytree(prepared / "out", out)
    kept = sorted(file for file in out.iterdir() if "checkpoint" in file.name)
    damage(random.choice(kept), random)
    ended = limber.run(*scene.run_words(name), "--resume")
    if ended.status == 0:
        differs = scene.answers_differ(out, prepared / "whole")
        if differs:
            ended.problems.append(f"damage was accepted: {differs}")
    return ended


TOML_PAIR = re.compile(r'\w+"?\s*=\s*(\[[^\]]*\]|"[^"]*"|[^\s,}\[{]+)')
XML_PAIR = re.compile(r'\w+="([^"]*)"')
STRING = re.compile(r'"[^"]*"')
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def _find_atoms(text, begin, end):
    """Places of the numbers in a value, or of the whole of it."""
    value = text[begin:end].strip('"')
    if value.startswith("[") and '"' in value:
        return [match.span() for match in STRING.finditer(text, begin, end)]
    if re.search(r"[A-Za-z_]{2}", value):
        return [(begin, end)]
    return [match.span() for match in NUMBER.finditer(text, begin, end)]


def _find_pairs(name, pattern):
    text = scene.read(name)
    begin = text.index("<robot") if name.endswith(".urdf") else 0
    return [(name, *atom) for pair in pattern.finditer(text, begin)
            for atom in _find_atoms(text, *pair.span(1))]


def _find_changes():
    """(scene, file, begin, end) of each number and word of its files."""
    found = []
    for owner, name, pattern in (
        ("arm", "arm.toml", TOML_PAIR),
        ("arm", "arm.urdf", XML_PAIR),
        ("craft", "craft.toml", TOML_PAIR),
        ("craft", "rover.urdf", XML_PAIR),
        ("craft", "pod.urdf", XML_PAIR),
    ):
        found += [(owner, *place) for place in _find_pairs(name, pattern)]
    for owner, name, words in (
        ("arm", "bar.geo", r"0\.008"),
        ("craft", "bar.geo", r"0\.008"),
        ("craft", "block.stl", r"0\.015"),
        ("craft", "wedge.obj", r"-0\.02"),
        ("craft", "u.txt", r"4e-06"),
        ("craft", "nodes.txt", r"0\.04"),
    ):
        found.append((owner, name, *re.search(words, scene.read(name)).span()))
    return found


CHANGES = _find_changes()


def _change_value(old):
    if old in ("true", "false"):
        return "false" if old == "true" else "true"
    if not NUMBER.fullmatch(old):
        return old[:-1] + '_2"' if old.endswith('"') else old + "_2"
    if old.lstrip("+-").isdigit():
        return str(int(old) + 1)
    return repr(1.01 * float(old) if float(old) else 0.001)


def _change(number):
    owner, name, begin, end = CHANGES[number]
    text = scene.read(name)
    old = text[begin:end]
    new = _change_value(old)
    return owner, name, old, new, text[:begin] + new + text[end:]


def attack_resume(number, limber):
    """A resume of a changed scene refuses, or answers as a fresh run does."""
    owner, name, old, new, text = _change(number)
    words = scene.run_words(owner)
    scene.lay_out(limber.place)
    shutil.copytree(prepare(limber, owner) / "out", limber.place / "out")
    (limber.place / name).write_text(text)
    ended = limber.run(*words, "--resume")
    if ended.status not in (0, 3):
        return ended
    fresh = limber.run(*scene.run_words(owner, "fresh"))
    differs = scene.answers_differ(limber.place / "out", limber.place / "fresh")
    if fresh.status != ended.status:
        differs = f"status {ended.status}, fresh {fresh.status}"
    if differs:
        ended.problems.append(f"{name}: {old} -> {new} was accepted: {differs}")
    return ended
