#!/usr/bin/env python3
"""compare.py NATIVE FLAT: whether the states in results of the playground's module (a flat file,
src/limber/common/files/flat_file.hpp) are those of `limber run` (results.h5) to the bit, at all outputs."""
import struct
import sys

import h5py
import numpy as np

STATES = ("p_WB", "quat_WB", "v_WB_W", "w_WB_B", "eta", "etadot")


def read_flat(file):
    """Datasets of doubles by name."""
    data = open(file, "rb").read()
    assert data[:8] == b"LIMBFLAT", "no flat file"
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


def main(native, flat):
    played = read_flat(flat)
    compared, unequal = 0, []
    with h5py.File(native) as run:
        for body, group in run["bodies"].items():
            for state in STATES:
                if state not in group:
                    continue
                name = f"bodies/{body}/{state}"
                one, other = group[state][:], played[name]
                assert one.shape == other.shape, f"{name}: {one.shape} and {other.shape}"
                compared += one.size
                if one.tobytes() != other.tobytes():
                    unequal.append(f"{name}: off by {np.abs(one - other).max():.3g}")
    assert compared > 0, "no states"
    print(f"{compared} numbers of states: "
          + ("equal to the bit" if not unequal else "; ".join(unequal)))
    sys.exit(1 if unequal else 0)


main(*sys.argv[1:])
