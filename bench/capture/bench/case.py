# SPDX-License-Identifier: BSD-3-Clause
"""Reads and checks case.toml: question, quantities, references, tolerances."""
import csv
import dataclasses
import math
import pathlib
import tomllib

FORMAT = 1
KINDS = ("closed form", "independent computation", "conservation", "publication")


class CaseError(Exception):
    """A case.toml that is wrong; names the file and the key."""


@dataclasses.dataclass(frozen=True)
class Quantity:
    """A number that is asked for.

    reference    in `unit`
    uncertainty  of the reference, in `unit`
    tolerance    an answer within it of the reference is a hit, in `unit`
    kind         where the reference comes from, one of KINDS
    """

    name: str
    what: str
    unit: str
    reference: float
    uncertainty: float
    tolerance: float
    kind: str
    source: str
    digits: int = 4

    def judge(self, value):
        return abs(value - self.reference) <= self.tolerance


@dataclasses.dataclass(frozen=True)
class Curve:
    """A picture: answers' curves over x, beside the reference's points or none."""

    title: str
    x: str
    y: str
    points: tuple = ()


@dataclasses.dataclass(frozen=True)
class Case:
    folder: pathlib.Path
    title: str
    question: str
    description: str
    quick: bool
    quantities: tuple
    curve: Curve | None

    @property
    def name(self):
        return self.folder.name


def take(table, key, kind, where, default=None):
    if key not in table:
        if default is not None:
            return default
        raise CaseError(f"{where}: key '{key}' is missing, a {kind.__name__}")
    value = table.pop(key)
    if kind is float and isinstance(value, int) and not isinstance(value, bool):
        value = float(value)
    if not isinstance(value, kind):
        raise CaseError(f"{where}: '{key}' is not a {kind.__name__}: {value!r}")
    if kind is float and not math.isfinite(value):
        raise CaseError(f"{where}: '{key}' is not finite")
    return value


def refuse_rest(table, where):
    if table:
        raise CaseError(f"{where}: unknown key '{next(iter(table))}'")


def read_quantity(table, where):
    name = take(table, "name", str, where)
    where = f"{where}: quantity '{name}'"
    quantity = Quantity(
        name,
        take(table, "what", str, where),
        take(table, "unit", str, where),
        take(table, "reference", float, where),
        take(table, "uncertainty", float, where),
        take(table, "tolerance", float, where),
        take(table, "kind", str, where),
        take(table, "source", str, where),
        take(table, "digits", int, where, 4),
    )
    refuse_rest(table, where)
    if quantity.kind not in KINDS:
        raise CaseError(f"{where}: 'kind' is one of {', '.join(KINDS)}: {quantity.kind!r}")
    if not quantity.tolerance > 0 or quantity.uncertainty < 0:
        raise CaseError(f"{where}: tolerance > 0 and uncertainty >= 0 are required")
    if quantity.uncertainty > quantity.tolerance:
        raise CaseError(f"{where}: the uncertainty of the reference exceeds the tolerance")
    return quantity


def read_points(file):
    with open(file, encoding="utf-8") as lines:
        rows = [r for r in csv.reader(lines) if r and not r[0].startswith("#")]
    return tuple((float(r[0]), float(r[1])) for r in rows[1:])


def read_curve(table, folder, where):
    curve = Curve(
        take(table, "title", str, where),
        take(table, "x", str, where),
        take(table, "y", str, where),
        read_points(folder / table.pop("points")) if "points" in table else (),
    )
    refuse_rest(table, where)
    return curve


def read_case(folder):
    folder = pathlib.Path(folder).resolve()
    file = folder / "case.toml"
    try:
        table = tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise CaseError(f"{file}: {error}") from None
    number = take(table, "format", int, file)
    if number != FORMAT:
        raise CaseError(f"{file}: format {number}; this bench reads format {FORMAT}")
    quantities = tuple(read_quantity(q, file) for q in take(table, "quantity", list, file))
    if len({q.name for q in quantities}) != len(quantities) or not quantities:
        raise CaseError(f"{file}: quantities need names of their own, one at least")
    table.pop("input", None)  # for people and runners
    curve = table.pop("curve", None)
    case = Case(
        folder,
        take(table, "title", str, file),
        take(table, "question", str, file),
        take(table, "description", str, file),
        take(table, "quick", bool, file, False),
        quantities,
        read_curve(curve, folder, f"{file}: curve") if curve else None,
    )
    refuse_rest(table, file)
    return case
