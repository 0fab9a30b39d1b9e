#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a study of many struck arms, and writes what it cost beside its steps.

    bench/study/measure.py --limber build/release/src/app/limber [--out FOLDER]
        [--samples 1000] [--jobs 2]

Times are those of an idle machine; on a busy one the page says so.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import sqlite3
import statistics
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
STUDY = ROOT / "examples/strike_study.toml"
SCENE = ROOT / "examples/struck_finger.toml"
# One run with values from the middle of the factors.
ONE = ("--unset", "time.steps", "--set", "time.step=1e-4", "--set", "load.strike.force.2=-125",
       "--set", "load.strike.time.duration=0.0063", "--set", "output.pictures=false")
DURATION = 0.05  # of a run [s]
REPEATS = 15
FEW = 40  # runs of a study whose steps are compared with those of a longer one
MOST = 1.15
PICTURES = ("response_turn", "map_turn")

INTRODUCTION = """\
Written by `bench/study/measure.py`, including all text; do not edit.
[strike_study.toml](../../../examples/strike_study.toml) with {samples} runs in place of 12: a Latin
hypercube of three factors, the force and the duration of a blow to a fingertip and the stiffness of
two links of the arm, of 10 bodies with 108 modes; 50 ms at steps of 0.1 ms. `--jobs {jobs}`, bodies
reduced before. {how}"""
TERMS = """\
*Steps of one run*: `seconds_online` of `limber run` with values from the middle of the factors, the
least of {repeats} runs; *steps of all runs*: the table `timing` of the study. *Processor time of steps*:
how much more of it a study of {few} such runs takes for each further 50 ms of motion of a run, the
median of three pairs (it lacks the verdict on levels, which `limber run` gives and no response asks for).
*The study* is the whole command, from its start to its end, pictures included. Resident memory is the
most that the process of `limber` ever had."""


def cost_of(words, cwd):
    """(wall, processor time [s], resident memory [kB], output) of a command."""
    with open(cwd / "out.txt", "w+", encoding="utf-8") as out:
        begin = time.monotonic()
        child = subprocess.Popen([str(word) for word in words], stdout=out,
                                 stderr=subprocess.DEVNULL, cwd=cwd)
        resident, status, usage = 0, None, None
        while status is None:
            try:
                text = pathlib.Path(f"/proc/{child.pid}/status").read_text()
                resident = max([resident] + [int(n) for n in re.findall(r"VmHWM:\s+(\d+)", text)])
            except OSError:
                pass
            pid, code, usage = os.wait4(child.pid, os.WNOHANG)
            status = code if pid else None
            time.sleep(0.002)
        wall = time.monotonic() - begin
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        if child.returncode != 0:
            raise SystemExit(f"{' '.join(map(str, words))}: status {child.returncode}")
        return wall, usage.ru_utime + usage.ru_stime, resident, out.read()


class Bench:
    def __init__(self, options, work):
        self.limber = pathlib.Path(options.limber).resolve()
        self.jobs, self.work = options.jobs, work
        self.cache = ["--cache", work / "cache"]

    def run(self, duration):
        words = [self.limber, "run", SCENE, *ONE, "--set", f"time.duration={duration}", "--json",
                 "--out", "one", *self.cache]
        _, processor, resident, out = cost_of(words, self.work)
        return processor, resident, json.loads(out)["seconds_online"]

    def study(self, name, samples, duration=DURATION):
        """(wall, processor, resident, [steps], folder) of a study."""
        text = STUDY.read_text(encoding="utf-8")
        text = re.sub(r"samples = \d+", f"samples = {samples}", text)
        text = text.replace(f"time.duration={DURATION}", f"time.duration={duration}")
        text = text.replace('"struck_finger.toml"', json.dumps(str(SCENE)))
        file = self.work / f"{name}.toml"
        file.write_text(text, encoding="utf-8")
        folder = self.work / name
        shutil.rmtree(folder, ignore_errors=True)
        words = [self.limber, "study", file, "--out", folder, "--jobs", self.jobs, *self.cache]
        wall, processor, resident, _ = cost_of(words, self.work)
        with sqlite3.connect(folder / "study.sqlite") as table:
            steps = [row[0] for row in table.execute("SELECT steps FROM timing")]
            (failed,) = table.execute("SELECT count(*) FROM runs WHERE error <> ''").fetchone()
        if len(steps) != samples or failed:
            raise SystemExit(f"{name}: {len(steps)} rows, {failed} of them failed")
        return wall, processor, resident, steps, folder

    def measure_one(self):
        """Least seconds of steps, processor seconds of steps, and memory of a run."""
        self.run(DURATION)
        online, resident, processor = [], [], []
        for _ in range(REPEATS):
            _, kilobytes, seconds = self.run(DURATION)
            online.append(seconds)
            resident.append(kilobytes)
        for _ in range(3):
            short = self.study("short", FEW)[1]
            long = self.study("long", FEW, 5 * DURATION)[1]
            processor.append((long - short) / (4 * FEW))
        return min(online), statistics.median(processor), statistics.median(resident)


def write_page(out, options, one, few, many, load):
    online, of_steps, resident = one
    wall, processor, most, steps, _ = many
    n, jobs = options.samples, options.jobs
    share = wall / (n * online / jobs)
    own = wall / (sum(steps) / jobs)
    used = processor / (n * of_steps)
    is_idle = load < 0.5
    how = (f"The load of the machine before it was {load:.1f}"
           + ("." if is_idle else ": it was busy, so that\ntimes are not those of this study alone: "
              "those of steps vary by more than twice from one measurement to the next."))
    rows = [("steps of one run [ms]", f"{1e3 * online:.1f}"),
            ("processor time of steps of one run [ms]", f"{1e3 * of_steps:.1f}"),
            ("steps of all runs [s]", f"{sum(steps):.1f}"),
            ("the study [s]", f"{wall:.1f}"),
            (f"the same over {n} times the steps of one run by {jobs}", f"{share:.3f}"),
            (f"the same over the steps of all runs by {jobs}", f"{own:.3f}"),
            ("processor time of the study [s]", f"{processor:.1f}"),
            (f"the same over {n} times that of steps of one run", f"{used:.3f}"),
            ("resident memory of one run [MB]", f"{resident / 1024:.1f}"),
            ("of a study of 4 runs [MB]", f"{few[2] / 1024:.1f}"),
            (f"of the study of {n} runs [MB]", f"{most / 1024:.1f}")]
    # By the steps of all runs: a run alone also judges its levels, a study does not.
    claims = [(own <= MOST, f"wall time: at most {MOST} times the steps of all runs."),
              (most < 1.25 * few[2], f"{n} runs need the memory of 4: bodies are shared.")]
    text = ["# A study of struck arms", "",
            INTRODUCTION.format(samples=n, jobs=jobs, how=how), "", "| | |", "|---|---:|",
            *[f"| {name} | {value} |" for name, value in rows], "",
            TERMS.format(repeats=REPEATS, few=FEW), ""]
    if not is_idle:
        claims.pop(0)
        text += [f"- **Not measured:** that the study takes at most {MOST} times its steps. It asks "
                 "for an idle machine.", ""]
    for holds, words in claims:
        text += [f"- **{'Holds' if holds else 'MISSED'}:** {words}", ""]
    for name in PICTURES:
        text += [f"![{name} of the study]({name}.png)", ""]
    (out / "README.md").write_text("\n".join(text[:-1]) + "\n", encoding="utf-8")
    return all(holds for holds, _ in claims)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--limber", default=ROOT / "build/release/src/app/limber")
    parser.add_argument("--out", default=ROOT / "out/study", type=pathlib.Path)
    parser.add_argument("--samples", default=1000, type=int)
    parser.add_argument("--jobs", default=2, type=int)
    options = parser.parse_args()
    out, work = options.out.resolve(), ROOT / "out/study-runs"
    for folder in (out, work):
        folder.mkdir(parents=True, exist_ok=True)
    load = os.getloadavg()[0]
    bench = Bench(options, work)
    bench.study("warm", 4)  # reduces what is not in the cache
    one = bench.measure_one()
    few = bench.study("four", 4)
    many = bench.study("strike_study", options.samples)
    for name in PICTURES:
        shutil.copy(many[-1] / f"{name}.png", out)
    return 0 if write_page(out, options, one, few, many, load) else 1


if __name__ == "__main__":
    raise SystemExit(main())
