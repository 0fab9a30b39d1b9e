# SPDX-License-Identifier: BSD-3-Clause
"""Reduced bodies."""

import os
import warnings

from . import _core
from .errors import LimberWarning


def reduce(mesh, *, youngs_modulus, poisson_ratio, density, interfaces=(),
           clamps=(), modes=10, rows=("boundary",), size=0.0, order=0, unit=None,
           second_order=False, stress=False):
    """Reduces a mesh or geometry to a body that no longer needs the mesh.

    ``youngs_modulus`` [Pa], ``poisson_ratio`` [-], ``density`` [kg/m^3];
    ``interfaces``: groups of the mesh that become interfaces; ``clamps``: that
    are fixed; ``modes``: number of eigenmodes, or "auto"; ``rows``: nodes to
    keep; ``size`` [mesh units] and ``order`` of elements when a geometry is
    meshed; ``unit``: of the mesh, [m] or "m", "cm", "mm", "in", "ft" (default:
    the file's, where it states one, else 1 m); ``second_order``: with the tables that
    level nonlinear needs; ``stress``: with stress modes.

    Returns a :class:`ReducedBody`.
    """
    wish = dict(mesh=os.fspath(mesh), youngs_modulus=youngs_modulus,
                poisson_ratio=poisson_ratio, density=density,
                interfaces=list(interfaces), clamps=list(clamps), modes=modes,
                rows=list(rows), size=size, order=order, unit=unit,
                second_order=second_order, stress=stress)
    body, notices = _core.reduce(wish)
    for text in notices:
        warnings.warn(text, LimberWarning, stacklevel=2)
    return body
