# SPDX-License-Identifier: BSD-3-Clause
"""Python values as TOML, for keys of scenarios and studies."""

import json
import math
import numbers

from .errors import InputError


def to_toml(value):
    """The text of a number, text, truth value, list, array or dictionary."""
    if hasattr(value, "tolist"):  # NumPy's arrays and numbers
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return _to_float(float(value))
    if isinstance(value, str):
        # JSON's escapes are TOML's, but for DEL.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(to_toml(one) for one in value) + "]"
    if isinstance(value, dict):
        pairs = (f"{to_toml(str(key))} = {to_toml(one)}" for key, one in value.items())
        return "{" + ", ".join(pairs) + "}"
    if hasattr(value, "__fspath__"):
        return to_toml(value.__fspath__())
    raise InputError(
        f"a {type(value).__name__} is no value of a key; expected a number, text, "
        "truth value, list or dictionary")


def _to_float(value):
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return repr(value)


def to_document(tables):
    """A document of keys, tables (dict) and lists of tables (list of dict)."""
    keys, sections = [], []
    for name, value in tables.items():
        if isinstance(value, dict):
            sections.append(f"[{name}]\n" + _to_lines(value))
        elif isinstance(value, list) and value and all(
                isinstance(one, dict) for one in value):
            sections += [f"[[{name}]]\n" + _to_lines(one) for one in value]
        else:
            keys.append(f"{name} = {to_toml(value)}\n")
    return "".join(keys) + "\n" + "\n".join(sections)


def _to_lines(table):
    return "".join(f"{to_toml(str(key))} = {to_toml(value)}\n"
                   for key, value in table.items())
