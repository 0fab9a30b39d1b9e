# SPDX-License-Identifier: BSD-3-Clause
"""Studies: mutated files, damaged tables, kill -9, signals, two at once."""

import shutil
import signal
from functools import cache
from random import Random

import scene
from command import Limber
from damaged import damage
from mutate import mutate_text

STUDY = ["study", "study.toml", "--out", "out", "--csv"]
TABLE = "study.sqlite"
COMMAND_SECONDS = 2.0  # s, in which a moment is drawn


@cache
def _prepare(program, folder, stock):
    """Made once by each worker: a whole study."""
    place = stock / "prepared_study"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    scene.lay_out(place)
    whole = Limber(program, place, folder).run(*STUDY)
    if whole.status != 0:
        raise RuntimeError(f"nothing to damage: {whole.errors}")
    return place / "out"


def prepare_study(limber):
    return _prepare(limber.program, limber.cache, limber.cache.parent)


def tables_differ(limber):
    """Whether the table is not that of an undisturbed study."""
    mine = limber.place / "out" / "study.csv"
    whole = prepare_study(limber) / "study.csv"
    if not mine.exists():
        return "no table"
    return "" if mine.read_bytes() == whole.read_bytes() else "another table"


def attack_study_file(seed, limber):
    """A mutated study is refused or made; made again, it is the same."""
    random = Random(f"study {seed}")
    scene.lay_out(limber.place)
    changed = mutate_text(scene.read("study.toml"), random)
    (limber.place / "study.toml").write_bytes(changed.encode(errors="replace"))
    ended = limber.run(*STUDY)
    if ended.status == 0:
        again = limber.run(*STUDY)
        if again.status != 0:
            ended.problems.append(f"status {again.status} when it is run again")
    return ended


READS = [STUDY, ["study", "--collect", f"out/{TABLE}", "--out", "all"],
         ["run", "--from", f"out/{TABLE}#2", "--out", "one"]]


def attack_table(seed, limber):
    """A damaged table is refused, or what was damaged does not matter."""
    random = Random(f"table {seed}")
    scene.lay_out(limber.place)
    shutil.copytree(prepare_study(limber), limber.place / "out")
    damage(limber.place / "out" / TABLE, random)
    words = random.choice(READS)
    ended = limber.run(*words)
    if ended.status == 0 and words is STUDY and tables_differ(limber):
        ended.problems.append("damage was accepted: another table")
    return ended


def _go_on(limber, problems):
    """Whatever ended a study, the same command goes on to the same table."""
    ended = limber.run(*STUDY)
    problems += ended.problems
    if ended.status != 0:
        problems.append(f"again: status {ended.status}: {ended.errors[-200:]}")
    elif tables_differ(limber):
        problems.append(f"again: {tables_differ(limber)}")


def attack_study_kill(seed, limber):
    """kill -9, SIGINT or SIGTERM at a random moment, then the same command."""
    prepare_study(limber)
    random = Random(f"study kill {seed}")
    by = random.choice([signal.SIGKILL, signal.SIGINT, signal.SIGTERM])
    scene.lay_out(limber.place)
    moment = random.uniform(0.0, COMMAND_SECONDS)
    ended = limber.run_until(*STUDY, moment=moment, by=by)
    if ended.status not in (0, 128 + by):
        ended.problems.append(f"status {ended.status} after {by.name}")
    if ended.seconds > 2.0:
        ended.problems.append(f"ended {ended.seconds:.1f} s after {by.name}")
    _go_on(limber, ended.problems)
    return ended


def attack_study_twice(seed, limber):
    """Of two studies in one folder one is refused, or both end with the table."""
    prepare_study(limber)
    random = Random(f"study twice {seed}")
    scene.lay_out(limber.place)
    ended, _ = limber.run_twice(*STUDY, apart=random.uniform(0.0, 0.5))
    if tables_differ(limber):
        ended.problems.append(tables_differ(limber))
    return ended
