#!/usr/bin/env python3
"""Writes the stiffness and mass of one free beam of two elements in every format that Limber reads, a folder each.

The files are of our own making: what each program writes was compared with real files of others, none of which are here.
The folders calculix_* are not from here: README.md says how CalculiX wrote them.
"""
import math
import pathlib

E, G, RHO = 70e9, 27e9, 2700.0
AREA, IY, IZ, IX = 6e-4, 2e-8, 5e-8, 4e-8
NODES = [(10, (0.0, 0.0, 0.0)), (20, (0.5, 0.1, 0.0)), (7, (1.0, 0.0, 0.2))]
N = 6 * len(NODES)
ROWS = [(tag, c) for tag, _ in NODES for c in range(1, 7)]
HERE = pathlib.Path(__file__).parent


def beam(length):
    """Euler's beam along x: u, v, w, three rotations, at both ends (Przemieniecki 1968, 5.116 and 11.21, slender)."""
    K = [[0.0] * 12 for _ in range(12)]
    M = [[0.0] * 12 for _ in range(12)]

    def put(A, rows, values, factor):
        for i, r in enumerate(rows):
            for j, s in enumerate(rows):
                A[r][s] += factor * values[i][j]

    L = length
    bar_k, bar_m = [[1, -1], [-1, 1]], [[2, 1], [1, 2]]
    put(K, (0, 6), bar_k, E * AREA / L)
    put(K, (3, 9), bar_k, G * IX / L)
    put(M, (0, 6), bar_m, RHO * AREA * L / 6)
    put(M, (3, 9), bar_m, RHO * (IY + IZ) * L / 6)
    for rows, s, inertia in (((1, 5, 7, 11), 1, IZ), ((2, 4, 8, 10), -1, IY)):  # about z, about y
        a, b = 6 * L * s, 4 * L * L
        put(K, rows, [[12, a, -12, a], [a, b, -a, b / 2], [-12, -a, 12, -a], [a, b / 2, -a, b]], E * inertia / L**3)
        c, d = 22 * L * s, 13 * L * s
        put(M, rows, [[156, c, 54, -d], [c, b, d, -3 * L * L], [54, d, 156, -c], [-d, -3 * L * L, -c, b]],
            RHO * AREA * L / 420)
    return K, M


def assemble():
    K = [[0.0] * N for _ in range(N)]
    M = [[0.0] * N for _ in range(N)]
    for e in range(2):
        a, b = NODES[e][1], NODES[e + 1][1]
        d = [q - p for p, q in zip(a, b)]
        length = math.sqrt(sum(v * v for v in d))
        x = [v / length for v in d]
        up = (0.0, 0.6, 0.8)
        z = [x[1] * up[2] - x[2] * up[1], x[2] * up[0] - x[0] * up[2], x[0] * up[1] - x[1] * up[0]]
        size = math.sqrt(sum(v * v for v in z))
        z = [v / size for v in z]
        y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
        R = [x, y, z]  # rows: local axes
        for local, whole in zip(beam(length), (K, M)):
            for p in range(4):
                for q in range(4):
                    for i in range(3):
                        for j in range(3):
                            whole[6 * e + 3 * p + i][6 * e + 3 * q + j] += sum(
                                R[k][i] * local[3 * p + k][3 * q + m] * R[m][j] for k in range(3) for m in range(3))
    for A in (K, M):  # symmetric to the last bit
        for i in range(N):
            for j in range(i):
                A[j][i] = A[i][j]
    return K, M


K, M = assemble()
PAIR = (("K", K), ("M", M))
LOWER = [(i, j) for j in range(N) for i in range(j, N) if K[i][j] != 0.0 or M[i][j] != 0.0]


def write(folder, name, text):
    path = HERE / folder
    path.mkdir(exist_ok=True)
    (path / name).write_text(text)


def nodes_csv(components=True):
    head = "# a free beam of two elements\nnode,x,y,z" + (",components" if components else "") + "\n"
    return head + "".join(f"{t},{x!r},{y!r},{z!r}" + (",123456" if components else "") + "\n" for t, (x, y, z) in NODES)


def rows_csv():
    return "row,node,component\n" + "".join(f"{i + 1},{t},{c}\n" for i, (t, c) in enumerate(ROWS))


def bulk(free=False):
    def grid(t, x, y, z):
        return f"GRID,{t},,{x},{y},{z}\n" if free else f"GRID    {t:8d}{'':8s}{x:8.4f}{y:8.4f}{z:8.4f}\n"
    cards = "".join(grid(t, *x) for t, x in NODES)
    return "SOL 103\nCEND\nBEGIN BULK\n$ a free beam\n" + cards + "CBAR,1,1,10,20,0.,.6,.8\nCBAR,2,1,20,7,0.,.6,.8\nENDDATA\n"


def inp():
    return ("*HEADING\na free beam\n*NODE, NSET=ALL\n" + "".join(f"{t}, {x!r}, {y!r}, {z!r}\n" for t, (x, y, z) in NODES) +
            "*ELEMENT, TYPE=B31, ELSET=BEAM\n1, 10, 20\n2, 20, 7\n*NSET, NSET=TIP\n7,\n")


def matrix_market():
    for name, A in PAIR:
        write("matrix_market", f"{name}.mtx", "%%MatrixMarket matrix coordinate real symmetric\n% lower triangle\n"
              f"{N} {N} {len(LOWER)}\n" + "".join(f"{i + 1} {j + 1} {A[i][j]:.16e}\n" for i, j in LOWER))
        both = [(i, j) for i in range(N) for j in range(N) if A[i][j] != 0.0]
        write("matrix_market_general", f"{name}.mtx", f"%%MatrixMarket matrix coordinate real general\n{N} {N} {len(both)}\n" +
              "".join(f"{i + 1} {j + 1} {A[i][j]:.16e}\n" for i, j in both))
        write("matrix_market_array", f"{name}.mtx", f"%%MatrixMarket matrix array real symmetric\n{N} {N}\n" +
              "".join(f"{A[i][j]:.16e}\n" for j in range(N) for i in range(j, N)))
        write("matrix_market_array_general", f"{name}.mtx", f"%%MatrixMarket matrix array real general\n{N} {N}\n" +
              "".join(f"{A[i][j]:.16e}\n" for j in range(N) for i in range(N)))
    for folder in ("matrix_market", "matrix_market_array", "matrix_market_array_general"):
        write(folder, "nodes.csv", nodes_csv())
    write("matrix_market_general", "nodes.csv", nodes_csv(components=False))
    write("matrix_market_general", "rows.csv", rows_csv())


def small_real(v):
    """Eight columns: 2.376+8."""
    for digits in (4, 3, 2):
        mantissa, exponent = f"{v:.{digits}E}".split("E")
        text = f"{mantissa}{int(exponent):+d}"
        if len(text) <= 8:
            return text.rjust(8)
    raise ValueError(v)


def dmig():
    for folder, form, large in (("dmig_large", 6, True), ("dmig_square", 1, True), ("dmig_small", 6, False)):
        text = "$ K and M of a free beam\n"
        for name, A in (("KAAX", K), ("MAAX", M)):
            text += f"DMIG    {name:8s}{0:8d}{form:8d}{2 if large else 1:8d}{0:8d}{'':16s}{N:8d}\n"
            for j in range(N):
                rows = [i for i in range(N) if A[i][j] != 0.0 and (form != 6 or i <= j)]
                if large:
                    text += f"DMIG*   {name:8s}{'':8s}{ROWS[j][0]:16d}{ROWS[j][1]:16d}\n"
                    for i in rows:
                        value = f"{A[i][j]: .9E}".replace("E", "D").rjust(16)
                        text += f"*       {ROWS[i][0]:16d}{ROWS[i][1]:16d}{value}\n"
                    continue
                entry = [f"{ROWS[i][0]:8d}{ROWS[i][1]:8d}{small_real(A[i][j])}" for i in rows]
                text += f"DMIG    {name:8s}{ROWS[j][0]:8d}{ROWS[j][1]:8d}{'':8s}{entry[0]}\n"
                for k in range(1, len(entry), 2):
                    text += " " * 8 + f"{'':8s}".join(entry[k:k + 2]) + "\n"
        write(folder, "beam.pch", text)
        write(folder, "beam.bdf", bulk())
    text = "begin bulk\n" + "".join(f"grid,{t},,{x},{y},{z}\n" for t, (x, y, z) in NODES)
    for name, A in (("k2gg", K), ("m2gg", M)):
        text += f"dmig,{name},0,9,2,0,,,{N}\n"
        for j in range(N):
            rows = [i for i in range(N) if A[i][j] != 0.0]
            text += f"dmig*,{name},{ROWS[j][0]},{ROWS[j][1]},\n"
            text += "".join(f"*,{ROWS[i][0]},{ROWS[i][1]},{A[i][j]:.15E}\n" for i in rows)
    write("dmig_free", "beam.dat", text + "enddata\n")


def op4():
    per, width, digits = 3, 23, 16

    def lines(values):
        return "".join("".join(f"{v:{width}.{digits}E}" for v in values[k:k + per]) + "\n" for k in range(0, len(values), per))

    for folder, words in (("op4_dense", 2), ("op4_numbers", 1), ("op4_sparse", 2), ("op4_bigmat", 2)):
        is_dense, is_big = folder in ("op4_dense", "op4_numbers"), folder == "op4_bigmat"
        text = ""
        for name, A in (("KGG", K), ("MGG", M)):
            text += f"{N:8d}{-N if is_big else N:8d}{6:8d}{2:8d}{name:8s}1P,{per}E{width}.{digits}\n"
            for j in range(N):
                rows = [i for i in range(N) if A[i][j] != 0.0]
                if is_dense:
                    values = [A[i][j] for i in range(rows[0], rows[-1] + 1)]
                    text += f"{j + 1:8d}{rows[0] + 1:8d}{words * len(values):8d}\n" + lines(values)
                    continue
                runs = []
                for i in rows:
                    if runs and runs[-1][-1] == i - 1:
                        runs[-1].append(i)
                    else:
                        runs.append([i])
                text += f"{j + 1:8d}{0:8d}{sum(words * len(r) + (2 if is_big else 1) for r in runs):8d}\n"
                for run in runs:
                    length = words * len(run) + 1
                    text += f"{length:8d}{run[0] + 1:8d}\n" if is_big else f"{run[0] + 1 + 65536 * length:12d}\n"
                    text += lines([A[i][j] for i in run])
            text += f"{N + 1:8d}{1:8d}{1:8d}\n{1.0:{width}.{digits}E}\n"
        write(folder, "beam.op4", text)
        write(folder, "beam.bdf", bulk(free=True))
        if folder == "op4_sparse":
            write(folder, "beam.f06", set_print())
        else:
            write(folder, "rows.csv", rows_csv())


def set_print():
    text = "1    A FREE BEAM\n0\n" + " " * 16 + "U S E T   D E F I N I T I O N   T A B L E   ( I N T E R N A L   S E Q U E N C E ,   R O W   S O R T )\n"
    text += " " * 55 + "G        DISPLACEMENT SET\n" + " " * 16 + "        ".join(f"-{k}-" for k in range(1, 11)) + "\n\n"
    for k in range(0, N, 10):
        text += f" {k + 1:6d}=" + "".join(f"{t:9d}-{c}" for t, c in ROWS[k:k + 10])
        text += (f"      ={k + 10:6d}" if k + 10 <= N else "") + "\n"
    return text + "\n\n1    A FREE BEAM\n"


def abaqus():
    for name, A in (("STIF", K), ("MASS", M)):
        both = "".join(f"{i + 1} {j + 1} {A[i][j]:22.15e}\n" for i in range(N) for j in range(N) if A[i][j] != 0.0)
        write("abaqus_coordinate", f"beam_{name}1.mtx", both)
        lower = "".join(f"{ROWS[i][0]},{ROWS[i][1]}, {ROWS[j][0]},{ROWS[j][1]}, {A[i][j]:22.15e}\n" for i, j in LOWER if A[i][j])
        write("abaqus_matrix_input", f"beam_{name}1.mtx", "** Assembled nodal matrix\n" + lower)
    write("abaqus_coordinate", "beam.inp", inp())
    write("abaqus_coordinate", "rows.csv", rows_csv())
    write("abaqus_matrix_input", "beam.inp", inp())
    text = "**\n** SUBSTRUCTURE\n*USER ELEMENT, NODES=          3, LINEAR\n** ELEMENT NODES\n** 10, 20,\n** 7\n1,2,3,4,5,6\n"
    for name, A in (("STIFFNESS", K), ("MASS", M)):
        text += f"*MATRIX,TYPE={name}\n"
        for i in range(N):
            row = [f"{A[i][j]:.13e}" for j in range(i + 1)]
            for k in range(0, len(row), 4):
                text += ", ".join(row[k:k + 4]) + (",\n" if k + 4 < len(row) else "\n")
    write("abaqus_substructure", "beam.mtx", text)
    write("abaqus_substructure", "beam.inp", inp())


def ansys():
    names = ("UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ")
    for name, title, A in (("beam_k", "Stiffness", K), ("beam_m", "Mass", M)):
        pointers, rows, values = [1], [], []
        for j in range(N):
            kept = [i for i in range(j, N) if A[i][j] != 0.0]
            rows += [i + 1 for i in kept]
            values += [A[i][j] for i in kept]
            pointers.append(len(rows) + 1)
        text = f"{title + ' matrix from ANSYS FULL file dumped into Harwell-Boeing format':72s}{'':8s}\n"
        text += f"{len(pointers) + 2 * len(rows) + N:14d}{len(pointers):14d}{len(rows):14d}{len(values):14d}{N:14d}\n"
        text += f"{'RSA':14s}{N:14d}{N:14d}{len(values):14d}{0:14d}\n{'(I14)':16s}{'(I14)':16s}{'(d25.15)':20s}{'(d25.15)':20s}\n"
        text += f"{'F':14s}{1:14d}{0:14d}\n"
        text += "".join(f"{v:14d}\n" for v in pointers + rows)
        text += "".join(f"{v:25.15E}".replace("E", "D") + "\n" for v in values + [0.0] * N)
        write("ansys_harwell_boeing", f"{name}.matrix", text)
    text = "    Matrix Eqn          Node    DOF     \n"
    text += "".join(f"{i + 1:14d}{t:14d}    {names[c - 1]:4s}\n" for i, (t, c) in enumerate(ROWS))
    write("ansys_harwell_boeing", "beam.mapping", text)
    text = "/COM,ANSYS RELEASE\n/PREP7\nET,1,188\n" + f"NBLOCK,6,SOLID,{20:10d},{3:10d}\n(3i9,6e21.13e3)\n"
    for t, x in sorted(NODES):
        values = "".join(f"{v:.13E}".replace("E+", "E+0").replace("E-", "E-0").rjust(21) for v in x)
        text += f"{t:9d}{0:9d}{0:9d}{values.rstrip()}\n"
    text += "N,R5.3,LOC,       -1,\n" + f"EBLOCK,19,SOLID,{2:10d},{2:10d}\n(19i9)\n"
    for e, (a, b) in enumerate(((10, 20), (20, 7))):
        text += "".join(f"{v:9d}" for v in (1, 1, 1, 1, 0, 0, 0, 0, 2, 0, e + 1, a, b)) + "\n"
    text += f"{-1:9d}\nCMBLOCK,ENDS    ,NODE,{2:8d}\n(8i10)\n{7:10d}{10:10d}\n"
    write("ansys_harwell_boeing", "beam.cdb", text + "FINISH\n")

    head = "%============================================================\n% Creator: ANSYS Inc\n%\n"
    for name, A in PAIR:
        kept = [(i, j) for i, j in LOWER if A[i][j] != 0.0]
        write("ansys_mmf", f"{name}.txt", f"%%MatrixMarket matrix coordinate real symmetric \n{head}{N} {N} {len(kept)}\n" +
              "".join(f"{i + 1} {j + 1} {A[i][j]:.15E}\n" for i, j in kept))
    write("ansys_mmf", "map.txt", f"%%MatrixMarket matrix array integer general \n{head}{len(NODES)} 1\n" +
          "".join(f"{t}\n" for t, _ in NODES))
    text = "\n LIST ALL SELECTED NODES.   DSYS=      0\n   SORT TABLE ON  NODE  NODE  NODE\n"
    for t, x in sorted(NODES):  # the head is repeated on each page
        text += "\n    NODE        X                   Y                   Z             THXY     THYZ     THZX\n"
        text += f"{t:9d}" + "".join(f"{v:20.12f}" for v in x) + "    0.00    0.00    0.00\n"
    write("ansys_mmf", "nlist.lis", text)


matrix_market()
dmig()
op4()
abaqus()
ansys()
