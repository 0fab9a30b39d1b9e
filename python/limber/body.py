# SPDX-License-Identifier: BSD-3-Clause
"""Reduced bodies."""

import os
import warnings
from xml.sax.saxutils import quoteattr

from . import _core
from .errors import LimberWarning


def _list_numbers(value):
    """A number, a sequence of numbers or None as a list."""
    if value is None:
        return []
    try:
        return [float(value)]
    except TypeError:
        return [float(entry) for entry in value]


def _write_attributes(values):
    """A dict as attributes of an element of a robot."""
    def write(value):
        if isinstance(value, (str, os.PathLike)):
            return os.fspath(value)
        try:
            return " ".join(str(entry) for entry in value)
        except TypeError:
            return str(value)
    return " ".join(f"{name}={quoteattr(write(value))}"
                    for name, value in dict(values).items())


def reduce(mesh=None, *, youngs_modulus=None, poisson_ratio=None, shear_modulus=None,
           stiffness=None, density=None, axis_1=None, axis_2=None, cylinder_axis=None,
           cylinder_point=None, matrices=None, mass=None, recovery=(), interfaces=(),
           clamps=(), modes=10, rows=("boundary",), size=0.0, order=0, unit=None,
           force_unit=None, ignore=(), materials=(), shells=(), beams=(),
           second_order=False, stress=False):
    """Reduces a mesh or geometry to a body that no longer needs the mesh, or the
    stiffness and mass matrix of a finite-element model.

    ``youngs_modulus`` [Pa], ``poisson_ratio`` [-], ``density`` [kg/m^3] of a mesh; of an
    orthotropic material E1, E2, E3, nu12, nu13, nu23 and ``shear_modulus`` G12, G13, G23
    [Pa], of an anisotropic one ``stiffness``, 21 constants [Pa] in place of moduli, in
    the axes ``axis_1`` and ``axis_2`` (vectors), or radial, tangential and along
    ``cylinder_axis`` through ``cylinder_point`` [m];
    ``matrices``: a folder, or a list of files, in place of mesh and material, with
    ``mass`` [kg] of the whole model, which its program prints, and ``recovery``: the
    files of a superelement's recovery rows, unless they are in the folder;
    ``interfaces``: groups of the mesh, or node sets and "node:TAG" of matrices, that
    become interfaces; ``clamps``: that are fixed; ``modes``: number of eigenmodes, or
    "auto"; ``rows``: nodes to keep; ``size`` [mesh units] and ``order`` of elements
    when a geometry is meshed; ``unit``: of lengths, [m] or "m", "cm", "mm", "in", "ft"
    (default: the file's, where it states one, else 1 m; forces of matrices are in N);
    ``force_unit``: of a deck's materials, [N] or "N", "kN", "lbf"; a deck (.bdf, .nas,
    .dat, .inp) has its own materials unless one is given; ``ignore``: its cards that
    are left out though the body lacks them then;
    ``materials``, ``shells``, ``beams``: materials, thicknesses and sections of groups of
    a mesh, each a dict with the attributes of ``<material>``, ``<shell>`` and ``<beam>``
    of a robot: ``shells=[dict(group="Skin", thickness=0.002)]``;
    ``second_order``: with the tables that level nonlinear needs; ``stress``: with
    stress modes.

    Returns a :class:`ReducedBody`.
    """
    if (mesh is None) == (matrices is None):
        raise TypeError("reduce() takes either a mesh or matrices")
    single = isinstance(matrices, (str, bytes, os.PathLike))
    paths = [matrices] if single else matrices or []
    names = dict(density=density, youngs_modulus=youngs_modulus,
                 poisson_ratio=poisson_ratio, shear_modulus=shear_modulus,
                 stiffness=stiffness)
    is_deck = os.path.splitext(os.fspath(mesh or ""))[1].lower() in (
        ".bdf", ".nas", ".dat", ".inp")
    is_deck = is_deck or bool(materials)
    is_stated = any(value is not None for value in names.values())
    if matrices is None and (is_stated or not is_deck):
        needed = dict(density=density)
        if stiffness is None:
            needed.update(youngs_modulus=youngs_modulus, poisson_ratio=poisson_ratio)
        for name, value in needed.items():
            if value is None:
                raise TypeError(f"reduce() of a mesh needs {name}")
    given = dict(mesh="" if mesh is None else os.fspath(mesh),
                 matrices=[os.fspath(path) for path in paths],
                 mass=0.0 if mass is None else mass,
                 youngs_modulus=_list_numbers(youngs_modulus),
                 poisson_ratio=_list_numbers(poisson_ratio),
                 shear_modulus=_list_numbers(shear_modulus),
                 stiffness=_list_numbers(stiffness), density=density or 0.0,
                 axis_1=_list_numbers(axis_1), axis_2=_list_numbers(axis_2),
                 cylinder_axis=_list_numbers(cylinder_axis),
                 cylinder_point=_list_numbers(cylinder_point))
    single = isinstance(recovery, (str, bytes, os.PathLike))
    given["recovery"] = [os.fspath(path) for path in ([recovery] if single else recovery)]
    wish = dict(given, interfaces=list(interfaces), clamps=list(clamps), modes=modes,
                rows=list(rows), size=size, order=order, unit=unit,
                force_unit=force_unit,
                ignore=[ignore] if isinstance(ignore, str) else list(ignore),
                materials=[_write_attributes(one) for one in materials],
                shells=[_write_attributes(one) for one in shells],
                beams=[_write_attributes(one) for one in beams],
                second_order=second_order, stress=stress)
    body, notices = _core.reduce(wish)
    for text in notices:
        warnings.warn(text, LimberWarning, stacklevel=2)
    return body
