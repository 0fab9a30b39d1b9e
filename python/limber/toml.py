# SPDX-License-Identifier: BSD-3-Clause
"""Python values as TOML, for keys of scenarios and studies, and back."""

import json
import math
import numbers
import re
import tomllib

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
        # JSON's escapes are TOML's, except for DEL.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(to_toml(one) for one in value) + "]"
    if isinstance(value, dict):
        pairs = (f"{to_toml(str(key))} = {to_toml(one)}" for key, one in value.items())
        return "{" + ", ".join(pairs) + "}"
    if hasattr(value, "__fspath__"):
        return to_toml(value.__fspath__())
    raise InputError(
        f"a {type(value).__name__} is not a value of a key; expected a number, text, "
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


def from_toml(text):
    """The value of a key; text that is no TOML value, or has a comment, is itself."""
    try:
        value = tomllib.loads("value = " + text)["value"]
    except tomllib.TOMLDecodeError:
        return text
    return text if "#" in text and not isinstance(value, (str, list)) else value


def read_toml(file):
    """The tables of a file."""
    with open(file, "rb") as stream:
        return tomllib.load(stream)


def is_of_robot(path, tables):
    """Whether a path is a key of the robot's file, as in ``limber run --set``."""
    parts = _split(path)
    if parts[0] != "robot" or (len(parts) == 2 and parts[1] in ("base", "file", "joint")):
        return False
    return len(parts) > (4 if isinstance(tables.get("robot"), list) else 1)


def look_up(tables, path, file):
    """The value at a dotted path. Raises KeyError if it is not there."""
    node = tables
    for part in _split(path):
        try:
            node = node[_find_key(node, part)]
        except (KeyError, IndexError, TypeError, ValueError):
            raise KeyError(f"{path} is neither in {file} nor set; a run takes the "
                           "default") from None
    return node


def put(tables, path, text):
    """Sets the value at a path that ``limber run --set`` takes; None: removes it."""
    *parts, last = _split(path)
    node = tables
    for part in parts:
        key = _find_key(node, part)
        if key == "robot" and isinstance(node.get(key), str):
            node[key] = {"file": node[key]}
        node = node.setdefault(key, {}) if isinstance(node, dict) else node[key]
    if text is None:
        del node[_find_key(node, last)]
    else:
        node[_find_key(node, last)] = from_toml(text)


_PART = r'(?:"([^"]+)"|([^."]+))'


def _split(path):
    """Parts of a path; those with dots are in double quotes. KeyError for another text."""
    if not re.fullmatch(rf"{_PART}(?:\.{_PART})*", path):
        raise KeyError(f"'{path}' is not a path of a key, such as load.strike.force.2")
    return [quoted or plain for quoted, plain in re.findall(_PART, path)]


def _find_key(node, part):
    """Of an array the index of the table with this name, or of the entry."""
    if not isinstance(node, list):
        return part
    names = [one.get("name") if isinstance(one, dict) else None for one in node]
    if part in names:
        return names.index(part)
    if not part.isdigit():
        raise KeyError(part)
    return int(part)
