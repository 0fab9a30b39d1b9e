# SPDX-License-Identifier: BSD-3-Clause
"""Reduced bodies."""

import os
import warnings

from . import _core
from .errors import LimberWarning


def reduce(mesh=None, *, youngs_modulus=None, poisson_ratio=None, density=None,
           matrices=None, mass=None, recovery=(), interfaces=(), clamps=(), modes=10,
           rows=("boundary",), size=0.0, order=0, unit=None, second_order=False,
           stress=False):
    """Reduces a mesh or geometry to a body that no longer needs the mesh, or the
    stiffness and mass matrix of a finite-element model.

    ``youngs_modulus`` [Pa], ``poisson_ratio`` [-], ``density`` [kg/m^3] of a mesh,
    but not of a deck of beams and shells (.bdf, .inp), which has its materials;
    ``matrices``: a folder, or a list of files, in place of mesh and material, with
    ``mass`` [kg] of the whole model, which its program prints, and ``recovery``: the
    files of a superelement's recovery rows, unless they are in the folder;
    ``interfaces``: groups of the mesh, or node sets and "node:TAG" of matrices, that
    become interfaces; ``clamps``: that are fixed; ``modes``: number of eigenmodes, or
    "auto"; ``rows``: nodes to keep; ``size`` [mesh units] and ``order`` of elements
    when a geometry is meshed; ``unit``: of lengths, [m] or "m", "cm", "mm", "in", "ft"
    (default: the file's, where it states one, else 1 m; forces of matrices are in N);
    ``second_order``: with the tables that level nonlinear needs; ``stress``: with
    stress modes.

    Returns a :class:`ReducedBody`.
    """
    if (mesh is None) == (matrices is None):
        raise TypeError("reduce() takes either a mesh or matrices")
    if matrices is None:
        is_deck = os.fspath(mesh).lower().endswith((".bdf", ".nas", ".dat", ".inp"))
        given = dict(mesh=os.fspath(mesh), matrices=[], mass=0.0 if mass is None else mass)
        for name, value in dict(youngs_modulus=youngs_modulus,
                                poisson_ratio=poisson_ratio, density=density).items():
            if value is None and not is_deck:
                raise TypeError(f"reduce() of a mesh needs {name}")
            given[name] = value or 0.0
    else:
        single = isinstance(matrices, (str, bytes, os.PathLike))
        given = dict(mesh="", matrices=[os.fspath(path) for path in
                                        ([matrices] if single else matrices)],
                     mass=0.0 if mass is None else mass,
                     youngs_modulus=youngs_modulus or 0.0,
                     poisson_ratio=poisson_ratio or 0.0, density=density or 0.0)
    single = isinstance(recovery, (str, bytes, os.PathLike))
    given["recovery"] = [os.fspath(path) for path in ([recovery] if single else recovery)]
    wish = dict(given, interfaces=list(interfaces), clamps=list(clamps), modes=modes,
                rows=list(rows), size=size, order=order, unit=unit,
                second_order=second_order, stress=stress)
    body, notices = _core.reduce(wish)
    for text in notices:
        warnings.warn(text, LimberWarning, stacklevel=2)
    return body
