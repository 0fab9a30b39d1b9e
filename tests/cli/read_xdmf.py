# SPDX-License-Identifier: BSD-3-Clause
"""Runs a scenario with --xdmf and opens the files with meshio.

usage: read_xdmf.py LIMBER SCENARIO FOLDER
"""

import csv
import subprocess
import sys

import h5py
import meshio
import numpy


def run(limber, scenario, folder):
    subprocess.run(
        [limber, "run", scenario, "--xdmf", "--out", folder,
         "--cache", folder + "/cache"],
        check=True,
    )


def read_probe(folder, name):
    with open(folder + "/probes.csv", newline="") as file:
        rows = list(csv.reader(file))
    names = [cell.split(" ")[0] for cell in rows[0]]
    columns = [names.index(name + "." + c) for c in ("ux", "uy", "uz")]
    values = numpy.array(rows[1:], dtype=float)
    return values[:, 0], values[:, columns]


def main():
    limber, scenario, folder = sys.argv[1:]
    run(limber, scenario, folder)
    times, moved = read_probe(folder, "B")  # the corner (0, 0, 5)
    with meshio.xdmf.TimeSeriesReader(folder + "/motion.xdmf") as reader:
        points, cells = reader.read_points_cells()
        assert [block.type for block in cells] == ["triangle"], cells
        triangles = cells[0].data
        assert triangles.dtype.kind == "i", triangles.dtype
        assert triangles.min() == 0 and triangles.max() == len(points) - 1
        # A closed surface of genus 0 and its midside nodes: each edge twice.
        edges = numpy.sort(
            triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        _, count = numpy.unique(edges, axis=0, return_counts=True)
        assert (count == 2).all()
        corner = numpy.argmin(
            numpy.linalg.norm(points - [0.0, 0.0, 5.0], axis=1))
        assert numpy.linalg.norm(points[corner] - [0.0, 0.0, 5.0]) < 1e-9
        assert reader.num_steps == len(times), reader.num_steps
        for k in range(reader.num_steps):
            t, point_data, _ = reader.read_data(k)
            assert abs(t - times[k]) < 1e-12, (t, times[k])
            assert point_data["deformation"].shape == (len(points),)
    # meshio reads the first step's points alone; the others by their place.
    with h5py.File(folder + "/motion.h5") as heavy:
        for k in range(0, len(times), 50):
            now = heavy[f"steps/{k:06}/points"][corner]
            error = numpy.abs(now - points[corner] - moved[k]).max()
            assert error < 1e-12, (times[k], error)


main()
