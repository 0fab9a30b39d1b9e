# SPDX-License-Identifier: BSD-3-Clause
"""--set and --unset: keys of scenario and robot, wrong paths, wrong values.

What is set is refused in words, or is in what the run depends on, or is told to
change nothing. What a run depends on is its manifest, by which a study knows
whether its rows are of the same scene.
"""

import json
import re
import sqlite3
import tomllib
import xml.etree.ElementTree
from functools import cache
from random import Random

import scene
from mutate import NUMBER, STRINGS, mutate_text

# Elements under <robot>, and the attribute by which they are known.
KINDS = {"link": "name", "joint": "name", "flexible": "link", "coupler": "joint",
         "loop": "name", "spring": "name", "bushing": "name", "latch": "name",
         "tendon": "name", "gear": "name", "contact": "link"}
VALUES = [
    "", "nan", "inf", "-inf", "1e400", "-1e308", "1e308", "1e-320", "0", "-0.0", "-1",
    "9223372036854775807", "9223372036854775808", "0x10", "1_0", "1,5", "true", "[]", "{}",
    "[[]]", "[1, 2]", "[nan, 1, 2]", "[1, 2, 3, 4]", '""', "'x'", '"\\u0000"', "ü", "'日本'",
    "\u202e", "1979-05-27", "07:32:00", "{a = 1}", "[{a = 1}]", "# 1", "1 # 2", "'''\n'''",
    "a=b", "--set", "A" * 5000, "[" * 300,
]
PARTS = ["", "0", "-1", "99", "1.5", "name", "x", "ü", '"', '"a.b"', "9" * 30, "force", "*",
         "A" * 600, "\0", " "]
# Names by which a result is told, or a file is written: of no run.
LABELS = re.compile(r"^(output\.|drive\.[^.]*\.name$|advice\.|robot\.(rover\.|pod\.)?name$)")


def _quote(part):
    return part if re.fullmatch(r"[\w-]+", part) else f'"{part}"'


def _list_scenario_keys(node, path):
    """(path, value) of all values, of tables and entries of arrays included."""
    yield path, node
    if isinstance(node, dict):
        for key, value in node.items():
            yield from _list_scenario_keys(value, path + [key])
    elif isinstance(node, list):
        for i, value in enumerate(node):
            name = value.get("name") if isinstance(value, dict) else None
            yield from _list_scenario_keys(value, path + [name or str(i)])


def _list_robot_keys(element, path):
    for name, value in element.attrib.items():
        yield path + [name], value
    tags = [child.tag for child in element]
    for child in element:
        of_tag = [other for other in element if other.tag == child.tag]
        number = [str(of_tag.index(child))] if tags.count(child.tag) > 1 else []
        yield from _list_robot_keys(child, path + [child.tag] + number)


def _list_robot(file, path):
    for element in xml.etree.ElementTree.fromstring(scene.read(file)):
        if element.tag in KINDS:
            name = element.get(KINDS[element.tag])
            yield from _list_robot_keys(element, path + [element.tag, name])


@cache
def list_keys(name):
    """All (parts of a path, value) of a scene."""
    table = tomllib.loads(scene.read(f"{name}.toml"))
    keys = [(path, value) for path, value in _list_scenario_keys(table, []) if path]
    robots = table["robot"]
    if isinstance(robots, str):
        return keys + list(_list_robot(robots, ["robot"]))
    for robot in robots:
        keys += list(_list_robot(robot["file"], ["robot", robot["name"]]))
    return keys


def _mutate_path(parts, random):
    """One slip, or a part too many, too few, or another."""
    parts = list(parts)
    at = random.randrange(len(parts))
    kind = random.randrange(5)
    if kind == 0:
        parts[at] = mutate_text(parts[at], random) or "x"
    elif kind == 1:
        parts.insert(at, random.choice(PARTS))
    elif kind == 2:
        parts.append(random.choice(PARTS))
    elif kind == 3 and len(parts) > 1:
        del parts[at]
    else:
        parts[at] = random.choice(PARTS)
    return parts


def _scale(before, random):
    """A number, or the first one of several, times something; none of a text."""
    factor = random.choice([-1.0, 0.5, 1.1, 1.1, 1.1, 1e3])
    words = before.split() if isinstance(before, str) else [before]
    if isinstance(before, list) and before:
        words = list(before)
    try:
        words = [float(word) for word in words]
    except (TypeError, ValueError):
        return None
    words[0] = words[0] * factor or 0.01
    if isinstance(before, list):
        return repr(words)
    return " ".join(map(repr, words))


def _draw_value(name, before, random):
    """What is set: odd, near to what was there, or a number of the scene."""
    if random.random() < 0.4:
        return random.choice(VALUES + STRINGS)
    near = _scale(before, random)
    if near is not None and random.random() < 0.8:
        return near
    return random.choice(NUMBER.findall(scene.read(f"{name}.toml")))


def _draw_setting(name, random):
    """Two words of the command line, and the value before, if the path is right."""
    parts, before = random.choice(list_keys(name))
    if random.random() < 0.25:
        parts, before = _mutate_path(parts, random), None
    path = ".".join(map(_quote, parts) if random.random() < 0.8 else parts)
    if random.random() < 0.1:
        return ["--unset", path], None
    return ["--set", f"{path}={_draw_value(name, before, random)}"], before


def _is_equal(word, before):
    """Whether it sets what is there: the same number or text."""
    value = word.split("=", 1)[1].strip()
    try:
        return float(value) == float(before)
    except (TypeError, ValueError):
        return value.strip("'\"") == str(before)


def _is_longer(word, before):
    """Whether it only makes the wall's normal longer, which has one component."""
    path, _, value = word.partition("=")
    try:
        return ".normal" in path and float(before) * float(value) > 0
    except (TypeError, ValueError):
        return False


def _draw_settings(name, random):
    """Words of the command line, none with a byte 0, and whether they set one
    key that is there to something else, which then has to act."""
    words, before = _draw_setting(name, random)
    acts = (before is not None and not LABELS.match(words[1])
            and not _is_equal(words[1], before) and not _is_longer(words[1], before))
    if random.random() < 0.25:
        words += random.choice([words, _draw_setting(name, random)[0]])
        acts = False
    return [word.replace("\0", "") for word in words], acts


def _study(limber, name, words, folder):
    """The command study with the settings, and the manifest of its one run."""
    study = {
        "scenario": f"../{name}.toml",
        "set": [text for kind, text in zip(words[::2], words[1::2]) if kind == "--set"],
        "unset": [text for kind, text in zip(words[::2], words[1::2]) if kind == "--unset"],
    }
    text = "version = 1\n" + "".join(f"{key} = {json.dumps(value)}\n"
                                     for key, value in study.items())
    text += ('[design]\nkind = "grid"\n[[factor]]\nname = "shown"\npath = "output.xdmf"\n'
             'values = [false]\n[[response]]\nname = "work"\nsummary = "energy.work"\n')
    file = limber.place / "out" / f"{folder}.toml"
    file.write_text(text)
    ended = limber.run("study", file, "--out", f"out/{folder}",
                       environment={"PATH": "/nonexistent"})  # without pictures
    table = limber.place / "out" / folder / "study.sqlite"
    if ended.status != 0 or not table.exists():
        return ended, None
    with sqlite3.connect(table) as connection:
        rows = dict(connection.execute("SELECT key, value FROM study"))
    return ended, [line for line in rows["manifest"].splitlines()
                   if not line.startswith("study")]


def attack_setting(seed, limber):
    """A setting is refused, acts, or is told to change nothing."""
    random = Random(f"setting {seed}")
    scene.lay_out(limber.place)
    (limber.place / "out").mkdir()
    name = random.choice(scene.SCENES)
    words, acts = _draw_settings(name, random)
    command = random.choice([["run", "--out", "out/o"], ["static", "--out", "out/o"],
                             ["frequencies"], ["linearize", "-o", "out/m.npz"],
                             ["study"], ["study"], ["study"]])
    if command != ["study"]:
        return limber.run(command[0], f"{name}.toml", *command[1:], *words)
    ended, manifest = _study(limber, name, words, "all")
    if acts and manifest is not None and "changes nothing" not in ended.errors:
        if manifest == _study(limber, name, [], "plain")[1]:
            ended.problems.append(f"accepted and without effect: {words[1][:200]}")
    return ended
