#!/usr/bin/env python3
"""compare.py NATIVE FLAT: whether the states in results of the playground's module (a flat file,
src/limber/common/files/flat_file.hpp) are those of `limber run` (results.h5) at all outputs: the last bits of sines,
logarithms and powers are those of the C library, and grow as the motion does."""
import struct
import sys

import h5py
import numpy as np

STATES = ("p_WB", "quat_WB", "v_WB_W", "w_WB_B", "eta", "etadot")


def read_flat(file):
    """Datasets of doubles by name."""
    data = open(file, "rb").read()
    assert data[:8] == b"LIMBFLAT", "not a flat file"
    at, sets = 8, {}

    def number():
        nonlocal at
        at += 8
        return struct.unpack_from("<Q", data, at - 8)[0]

    def take(size):
        nonlocal at
        at += size
        return data[at - size:at]

    while at < len(data):
        name = take(number()).decode()
        take(number())
        kind, rows, columns = number(), number(), number()
        values = take(rows * columns * {0: 8, 1: 8, 2: 1, 3: 4}[kind])
        if kind == 0:
            sets[name] = np.frombuffer(values).reshape(rows, columns)
    return sets


MOST = 1e-10  # of the largest of a state over all bodies
# Modes ride on bodies: their coordinates are judged beside the motion of these, too.
CARRIED_BY = {"eta": "p_WB", "etadot": "v_WB_W"}


def main(native, flat):
    played = read_flat(flat)
    gaps, largest, compared, unequal = {}, {}, 0, 0
    with h5py.File(native) as run:
        for body, group in run["bodies"].items():
            for state in STATES:
                if state not in group:
                    continue
                one, other = group[state][:], played[f"bodies/{body}/{state}"]
                assert one.shape == other.shape, f"{body}/{state}: {one.shape} and {other.shape}"
                assert np.isfinite(other).all(), f"{body}/{state} is not finite"
                compared += one.size
                unequal += int((one != other).sum())
                gaps[state] = max(gaps.get(state, 0.0), np.abs(one - other).max(initial=0.0))
                largest[state] = max(largest.get(state, 0.0), np.abs(one).max(initial=0.0))
    assert compared > 0, "no states"
    scales = {state: max(largest[state], largest[CARRIED_BY.get(state, state)]) for state in gaps}
    parts = {state: gap / scales[state] if gap > 0.0 else 0.0 for state, gap in gaps.items()}
    print(f"{compared} numbers of states, {compared - unequal} equal to the bit; the largest difference, "
          "of the largest value: " + ", ".join(f"{state} {part:.1e}" for state, part in parts.items()))
    sys.exit(1 if max(parts.values()) > MOST else 0)


main(*sys.argv[1:])
