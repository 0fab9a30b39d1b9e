"""Writes the models of this folder: stiffness and mass matrices of beams by textbook formulas.

Euler and Bernoulli's beam element with consistent mass (Przemieniecki, Theory of Matrix Structural Analysis, 1968, sections 5.6
and 11.3) or with masses lumped at the nodes. Nothing of Limber is used.

    /usr/bin/python3 make_models.py
"""
import pathlib

import numpy as np
from scipy.linalg import eigh

HERE = pathlib.Path(__file__).parent
E, G, RHO = 200e9, 80e9, 7800.0  # Pa, Pa, kg/m^3
WIDTH, HEIGHT = 0.02, 0.03  # of the section along its y and z [m]
A, IY, IZ = WIDTH * HEIGHT, WIDTH * HEIGHT**3 / 12, HEIGHT * WIDTH**3 / 12
J = 0.196 * HEIGHT * WIDTH**3  # of 1.5 : 1


def element(length, lumped):
    """K and M of a beam along x; rows u, v, w, rx, ry, rz of both ends."""
    K, M = np.zeros((12, 12)), np.zeros((12, 12))
    for i, j, stiffness in ((0, 6, E * A / length), (3, 9, G * J / length)):
        K[np.ix_([i, j], [i, j])] = stiffness * np.array([[1, -1], [-1, 1]])
    a = length
    bend = np.array([[12, 6 * a, -12, 6 * a], [6 * a, 4 * a * a, -6 * a, 2 * a * a],
                     [-12, -6 * a, 12, -6 * a], [6 * a, 2 * a * a, -6 * a, 4 * a * a]]) / a**3
    mass = RHO * A * a / 420 * np.array([[156, 22 * a, 54, -13 * a], [22 * a, 4 * a * a, 13 * a, -3 * a * a],
                                         [54, 13 * a, 156, -22 * a], [-13 * a, -3 * a * a, -22 * a, 4 * a * a]])
    flip = np.diag([1, -1, 1, -1])  # w' = -ry
    for rows, inertia, sign in (([1, 5, 7, 11], IZ, np.eye(4)), ([2, 4, 8, 10], IY, flip)):
        K[np.ix_(rows, rows)] += sign @ (E * inertia * bend) @ sign
        M[np.ix_(rows, rows)] += sign @ mass @ sign
    for i, j, value in ((0, 6, RHO * A * a / 6), (3, 9, RHO * (IY + IZ) * a / 6)):
        M[np.ix_([i, j], [i, j])] = value * np.array([[2, 1], [1, 2]])
    if lumped:
        half = RHO * a / 2
        own = half * np.array([A, A, A, IY + IZ, IY, IZ])
        M = np.diag(np.concatenate([own, own]))
    return K, M


def beam(nodes, lumped):
    """K and M of a chain of elements through `nodes`."""
    count = len(nodes)
    K, M = np.zeros((6 * count,) * 2), np.zeros((6 * count,) * 2)
    for e in range(count - 1):
        along = nodes[e + 1] - nodes[e]
        length = np.linalg.norm(along)
        x = along / length
        z = np.array([0.0, 0.0, 1.0])
        y = np.cross(z, x)
        y /= np.linalg.norm(y)
        R = np.vstack([x, y, np.cross(x, y)])
        T = np.kron(np.eye(4), R)
        rows = np.arange(6 * e, 6 * e + 12)
        for whole, part in zip((K, M), element(length, lumped)):
            whole[np.ix_(rows, rows)] += T.T @ part @ T
    return K, M


def write_matrix(file, A):
    rows = [(i + 1, j + 1, A[i, j]) for j in range(len(A)) for i in range(j, len(A))
            if abs(A[i, j]) > 1e-14 * abs(A).max()]
    with open(file, "w") as out:
        out.write("%%MatrixMarket matrix coordinate real symmetric\n")
        out.write(f"{len(A)} {len(A)} {len(rows)}\n")
        out.writelines(f"{i} {j} {v:.17g}\n" for i, j, v in rows)


def write(name, nodes, lumped, unit=1.0):
    """In units of N, s and `unit` metres."""
    K, M = beam(nodes, lumped)
    D = np.tile([unit] * 3 + [1.0] * 3, len(nodes))  # u_SI = D u
    K, M = (np.outer(D, D) * one / unit for one in (K, M))
    folder = HERE / name
    folder.mkdir(exist_ok=True)
    write_matrix(folder / "K.mtx", K)
    write_matrix(folder / "M.mtx", M)
    with open(folder / "nodes.csv", "w") as out:
        out.write("node,x,y,z\n")
        out.writelines(f"{i + 1},{','.join(f'{c:.17g}' for c in p / unit)}\n" for i, p in enumerate(nodes))


def straight(count, length=1.0):
    return np.array([[length * i / (count - 1), 0.0, 0.0] for i in range(count)])


def curved(count):
    """A quarter of a circle of 1 m, then a straight end out of its plane."""
    angle = np.linspace(0, np.pi / 2, count)
    return np.array([[np.sin(a), 1 - np.cos(a), 0.1 * np.sin(2 * a)] for a in angle])


def rigid_rows(offset):
    """Displacement of a point at `offset` of a node from the node's six rows."""
    x, y, z = offset
    return np.hstack([np.eye(3), -np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])])


def section_points(nodes):
    """(node, offset) of four points about each end of each element, which have its rotary inertia, too."""
    points = []
    for e in range(len(nodes) - 1):
        x = (nodes[e + 1] - nodes[e]) / np.linalg.norm(nodes[e + 1] - nodes[e])
        y = np.cross([0.0, 0.0, 1.0], x)
        y /= np.linalg.norm(y)
        z = np.cross(x, y)
        points += [(n, s * np.sqrt(IZ / A) * y + t * np.sqrt(IY / A) * z)
                   for n in (e, e + 1) for s in (-1, 1) for t in (-1, 1)]
    return points


def write_superelement(name, nodes, modes):
    """Craig and Bampton's reduction (AIAA J. 6 (1968) 1313) to both ends and `modes` fixed-interface modes; recovery rows of
    the section points."""
    K, M = beam(nodes, lumped=True)
    ends = np.r_[0:6, len(K) - 6:len(K)]
    inner = np.setdiff1d(np.arange(len(K)), ends)
    T = np.zeros((len(K), 12 + modes))
    T[ends, :12] = np.eye(12)
    T[inner, :12] = -np.linalg.solve(K[np.ix_(inner, inner)], K[np.ix_(inner, ends)])
    T[inner, 12:] = eigh(K[np.ix_(inner, inner)], M[np.ix_(inner, inner)])[1][:, :modes]
    folder = HERE / name
    folder.mkdir(exist_ok=True)
    write_matrix(folder / "K.mtx", T.T @ K @ T)
    write_matrix(folder / "M.mtx", T.T @ M @ T)
    with open(folder / "nodes.csv", "w") as out:
        out.write("node,x,y,z\n")
        out.writelines(f"{n},{','.join(f'{c:.17g}' for c in p)}\n" for n, p in ((1, nodes[0]), (2, nodes[-1])))
    with open(folder / "rows.csv", "w") as out:
        out.write("row,node,component\n")
        out.writelines(f"{i + 1},{1 + i // 6},{1 + i % 6}\n" for i in range(12))
        out.writelines(f"{i + 1},0,0\n" for i in range(12, 12 + modes))
    points = section_points(nodes)
    rows = np.vstack([rigid_rows(d) @ T[6 * n:6 * n + 6] for n, d in points])
    (folder / "recovery").mkdir(exist_ok=True)
    with open(folder / "recovery/otm.mtx", "w") as out:
        out.write(f"%%MatrixMarket matrix array real general\n{rows.shape[0]} {rows.shape[1]}\n")
        out.writelines(f"{v:.15g}\n" for v in rows.T.ravel())
    with open(folder / "recovery/points.csv", "w") as out:
        out.write("node,x,y,z\n")
        out.writelines(f"{101 + i},{','.join(f'{c:.17g}' for c in nodes[n] + d)}\n" for i, (n, d) in enumerate(points))


if __name__ == "__main__":
    write("beam", straight(21), lumped=False)
    write("beam_mm", straight(21), lumped=False, unit=1e-3)
    write("beam_lumped", straight(21), lumped=True)
    write("arch", curved(13), lumped=True)
    write_superelement("superelement", curved(7), 8)
    print(f"mass of a metre {RHO * A:.17g} kg; EI {E * IY:.17g}, {E * IZ:.17g} N m^2")
