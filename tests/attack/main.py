# SPDX-License-Identifier: BSD-3-Clause
"""Attacks a built limber, case by case, and tells what did not hold.

Whatever it is given, the command must end with status 0, 2 or 3 (130, 143
when it is asked to end), in words, within a minute, leave no process and write
nothing outside its folders; and an answer must be that of a fresh run.
"""

import argparse
import multiprocessing
import os
import shutil
import signal
import sys
import time
from collections import Counter
from pathlib import Path

import damaged
import faults
import files
import scene
import settings
import studies
from command import Limber, adopt_orphans

# family: what attacks, how many cases there are, whether there are always more
FAMILIES = {
    "scenarios": (files.attack_scenario, 2000, True),
    "robots": (files.attack_robot, 1500, True),
    "geometries": (files.attack_geometry, 800, True),
    "meshes": (files.attack_mesh, 800, True),
    "shapes": (files.attack_shape, 400, True),
    "matrices": (files.attack_matrices, 600, True),
    "decks": (files.attack_deck, 600, True),
    "sections": (files.attack_sections, 300, True),
    "settings": (settings.attack_setting, 1000, True),
    "study files": (studies.attack_study_file, 300, True),
    "tables": (studies.attack_table, 200, True),
    "study kills": (studies.attack_study_kill, 20, True),
    "studies at once": (studies.attack_study_twice, 6, True),
    "orders": (files.attack_order, files.ORDER_COUNT, False),
    "bodies": (damaged.attack_body, 250, True),
    "results": (damaged.attack_results, 100, True),
    "checkpoints": (damaged.attack_checkpoint, 200, True),
    "resumes": (damaged.attack_resume, len(damaged.CHANGES), False),
    "kills": (faults.attack_kill, 20, True),
    "signals": (faults.attack_signal, 30, True),
    "limits": (faults.attack_limit, faults.LIMIT_COUNT, False),
    "odd files": (faults.attack_odd_file, faults.ODD_FILE_COUNT, False),
    "streams": (faults.attack_stream, faults.STREAM_COUNT, False),
    "disks": (faults.attack_disk, faults.DISK_COUNT, False),
    "environments": (faults.attack_environment, faults.ENVIRONMENT_COUNT, False),
    "two at once": (faults.attack_two, 10, True),
}
WHERE = ("home", "tmp", "out", "fresh", "fresh_cache", "all", "one", "whole", "kept", "out.glb")


def _find_strays(place, before):
    """Files that a case left outside of the folders that are its own."""
    tmp = [f"tmp/{path.name}" for path in (place / "tmp").iterdir()]
    after = {path.name for path in place.iterdir()}
    return tmp + sorted(after - before - set(WHERE) - {"bin", "cache here"})


def _run_case(job):
    program, work, family, number = job
    adopt_orphans()
    worker = work / f"worker{os.getpid()}"
    place = worker / f"{family}-{number}".replace(" ", "_")
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    limber = Limber(program, place, worker / "cache")
    laid = {*scene.FILES, "deck.bdf", "deck.inp", "panel.geo", "bar.msh", "fifo", "beam.msh", "beam.urdf", "beam.toml",
            "body.h5", "bar.step", "values.txt", "matrices", *faults.ODD_PLACES}
    try:
        ended = FAMILIES[family][0](number, limber)
        # Results that found no other place are where the error says.
        strays = [name for name in _find_strays(place, laid)
                  if Path(name).name not in ended.errors]
        if strays:
            ended.problems.append(f"left behind: {', '.join(strays[:5])}")
        status, problems, said = ended.status, ended.problems, ended.errors
        if ended.stopped and status == 130:
            status = "long, ended when asked"
    except Exception as error:  # a defect of the attack is one, too
        status, problems, said = "attack failed", [repr(error)], ""
    if problems:
        kept = work / "failed" / place.name
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(place, kept, symlinks=True,
                        ignore=shutil.ignore_patterns("fifo", "home", "*fifo*"),
                        ignore_dangling_symlinks=True)
    shutil.rmtree(place, ignore_errors=True)
    return family, number, status, problems, said[:300]


def _parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path)
    parser.add_argument("families", nargs="*", metavar="FAMILY[:CASE]",
                        help=f"of {', '.join(FAMILIES)}; all")
    parser.add_argument("--work", type=Path, default=Path("build/attack"))
    parser.add_argument("--scale", type=float, default=1.0,
                        help="times as many of the drawn cases")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    return parser.parse_intermixed_args()


def _list_jobs(arguments):
    program, work = arguments.program.resolve(), arguments.work.resolve()
    for name in arguments.families or FAMILIES:
        family, _, case = name.partition(":")
        if family not in FAMILIES:
            sys.exit(f"attack: no family '{family}'; there are: {', '.join(FAMILIES)}")
        _, count, is_drawn = FAMILIES[family]
        numbers = range(max(1, round(arguments.scale * count)) if is_drawn else count)
        for number in [int(case)] if case else numbers:
            yield program, work, family, number


def _show_progress(done, jobs, begin):
    if sys.stderr.isatty():
        left = (time.monotonic() - begin) * (jobs - done) / done
        print(f"\r\033[K{done} of {jobs}, {left:.0f} s left", end="", file=sys.stderr)


def _attack(jobs, workers):
    """Ends of each family, and how many cases did not hold."""
    ends = {}
    failures = 0
    begin = time.monotonic()
    with multiprocessing.Pool(workers) as pool:
        cases = pool.imap_unordered(_run_case, jobs, chunksize=1)
        for done, (family, number, status, problems, said) in enumerate(cases, 1):
            ends.setdefault(family, Counter())[status] += 1
            if problems:
                failures += 1
                print(f"\r\033[K" * sys.stderr.isatty() + f"FAILED {family}:{number}: "
                      f"{'; '.join(problems)}\n    {said.strip()}", flush=True)
            _show_progress(done, len(jobs), begin)
    return ends, failures


def main():
    arguments = _parse()
    # What a shell starts in the background ignores it, and so would the command.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    jobs = list(_list_jobs(arguments))
    shutil.rmtree(arguments.work, ignore_errors=True)
    arguments.work.mkdir(parents=True)
    ends, failures = _attack(jobs, arguments.jobs)
    print()
    for family, counts in ends.items():
        words = ", ".join(f"{n} x {status}" for status, n in sorted(
            counts.items(), key=lambda item: str(item[0])))
        print(f"{family:14} {sum(counts.values()):5}   {words}")
    print(f"{len(jobs)} attacks, {failures} did not hold"
          + (f"; their files are in {arguments.work}/failed" if failures else ""))
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
