#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures a batch of n worlds on one and on two threads beside single worlds and
single runs, and the memory of a world.

    PYTHONPATH=build/release/python /usr/bin/python3 bench/batch/measure.py [--worlds N]

Every figure of a scene comes from one process and rounds that take turns; compare
ratios. Times are the least of the rounds: by the clock, which needs an idle machine, and
of the processors, which hardly does.
"""

import argparse
import pathlib
import subprocess
import sys
import time
import warnings

import numpy

import limber

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
# Name: scenario, keys, control period [s].
SCENES = {
    "flexible arm": ("damped_slew.toml", {"time.duration": 0.1}, 2e-3),
    "struck bar": ("ball_on_link.toml", {"time.duration": 2e-4}, 1e-5),
    "four-bar": ("four_bar.toml", {"time.duration": 0.1}, 1e-2),
}


def load(name):
    file, keys, period = SCENES[name]
    return limber.load(EXAMPLES / file, set=keys), period


def make(name, worlds, threads):
    scenario, period = load(name)
    return limber.Batch(scenario, worlds, period=period, threads=threads)


def now():
    """Time of the clock and of the processors [s]."""
    return numpy.array([time.perf_counter(), time.process_time()])


def step_all(batch):
    """Times of a whole scenario, without the reset before."""
    batch.reset()
    controls = numpy.zeros((len(batch), len(batch.inputs)))
    begin = now()
    while not batch.ended.all():
        batch.step(controls, mask=~batch.failed)
        if batch.failed.any():
            raise RuntimeError(batch.failures)
    return now() - begin


def step_each(batches):
    return sum(step_all(batch) for batch in batches)


def run_each(name, count):
    """Times of whole runs, each of which builds its scene."""
    scenario, _ = load(name)
    begin = now()
    for _ in range(count):
        scenario.run(judge=False)
    return now() - begin


def measure_times(name, worlds, rounds):
    one, two = make(name, worlds, 1), make(name, worlds, 2)
    alone = [make(name, 1, 1) for _ in range(min(worlds, 8))]
    runs = 2
    ways = {
        "single worlds": (lambda: step_each(alone), len(alone)),
        "batch, 1 thread": (lambda: step_all(one), worlds),
        "batch, 2 threads": (lambda: step_all(two), worlds),
        "single runs": (lambda: run_each(name, runs), runs),
    }
    each = {way: [] for way in ways}
    for _ in range(rounds):
        for way, (work, count) in ways.items():
            each[way].append(work() / count)
    return each


def measure_memory(name):
    """Resident memory that a world adds [B], from two processes."""
    few, many = 50, 250
    sizes = [int(subprocess.run([sys.executable, __file__, "--resident", name, str(count)],
                                check=True, capture_output=True, text=True).stdout)
             for count in (few, many)]
    return (sizes[1] - sizes[0]) / (many - few)


def print_resident(name, count):
    batch = make(name, count, 1)
    batch.step(numpy.zeros((count, len(batch.inputs))))
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    print(pages * 4096)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--worlds", type=int, default=32)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--resident", nargs=2, help=argparse.SUPPRESS)
    options = parser.parse_args()
    warnings.simplefilter("ignore", limber.LimberWarning)
    if options.resident:
        return print_resident(options.resident[0], int(options.resident[1]))
    print("| scene | way | ms a world, clock | ms, processors | worlds/s | "
          "faster than single worlds, clock | processors |")
    print("|---|---|---|---|---|---|---|")
    for name in SCENES:
        least = {way: numpy.min(times, axis=0) for way, times in
                 measure_times(name, options.worlds, options.rounds).items()}
        for way, (clock, processors) in least.items():
            ratios = least["single worlds"] / least[way]
            print(f"| {name} | {way} | {1e3 * clock:.2f} | {1e3 * processors:.2f} | "
                  f"{1 / clock:.1f} | {ratios[0]:.2f} | {ratios[1]:.2f} |", flush=True)
    print("\n| scene | kB a world |\n|---|---|")
    for name in SCENES:
        print(f"| {name} | {measure_memory(name) / 1e3:.0f} |", flush=True)
    return None


if __name__ == "__main__":
    main()
