#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes limber/_core.pyi, the types of the compiled part, from the signatures in
its docstrings.

    PYTHONPATH=build/release/python /usr/bin/python3 python/make_stubs.py > python/limber/_core.pyi
"""

import inspect
import re
import sys

if __name__ == "__main__":
    sys.path.pop(0)  # this folder's package has no compiled part

from limber import _core  # noqa: E402

HEAD = '''# SPDX-License-Identifier: BSD-3-Clause
# Made by python/make_stubs.py.
from os import PathLike
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

import numpy

'''


def to_type(text):
    text = re.sub(r"numpy\.ndarray\[[^\[\]]*(\[[^\[\]]*\])?[^\[\]]*\]", "numpy.ndarray",
                  text)
    text = text.replace("limber._core.", "").replace("_core.", "")
    text = re.sub(r"\bos\.PathLike\b", "PathLike[str]", text)
    text = re.sub(r"\b(object|handle|function)\b", "Any", text)
    return re.sub(r"limber::[\w:]+|std::[\w:]+", "Any", text)


def split(arguments):
    """At commas that are in no brackets."""
    parts, depth, part = [], 0, ""
    for letter in arguments:
        depth += letter in "([{<"
        depth -= letter in ")]}>"
        if letter == "," and depth == 0:
            parts.append(part.strip())
            part = ""
        else:
            part += letter
    return parts + [part.strip()] if part.strip() else parts


def to_argument(text):
    name, _, rest = text.partition(":")
    kind, is_default, _ = rest.partition(" = ")
    name = "self" if name == "self" else name.strip()
    if name == "self":
        return "self"
    name = re.sub(r"^arg\d+$", lambda match: "_" + match[0], name)
    return f"{name}: {to_type(kind.strip())}" + (" = ..." if is_default else "")


def to_signature(name, doc, is_method):
    match = re.match(rf"{re.escape(name)}\((.*)\) -> (.*)", (doc or "").splitlines()[0])
    if match is None:
        return f"def {name}({'self, ' if is_method else ''}*_args: Any, **_: Any) -> Any: ..."
    arguments = [to_argument(one) for one in split(match[1])]
    if is_method and (not arguments or arguments[0] != "self"):
        arguments = ["self"] + arguments[1:]
    return f"def {name}({', '.join(arguments)}) -> {to_type(match[2])}: ..."


def to_property(name, value):
    doc = (value.fget.__doc__ or "") if value.fget else ""
    match = re.search(r"-> (.*)", doc.splitlines()[0] if doc else "")
    kind = to_type(match[1]) if match else "Any"
    lines = [f"    @property\n    def {name}(self) -> {kind}: ..."]
    if value.fset is not None:
        lines.append(f"    @{name}.setter\n    def {name}(self, value: {kind}) -> None: ...")
    return lines


def to_class(name, value):
    lines = [f"class {name}:"]
    for key, member in sorted(vars(value).items()):
        if isinstance(member, property):
            lines += to_property(key, member)
        elif isinstance(member, staticmethod):
            lines.append("    @staticmethod\n    "
                         + to_signature(key, member.__func__.__doc__, False))
        elif inspect.isroutine(member) and (
                not key.startswith("__") or key in ("__init__", "__index__", "__int__",
                                                    "__matmul__")):
            lines.append("    " + to_signature(key, member.__doc__, True))
    if len(lines) == 1:
        lines.append("    ...")
    return "\n".join(lines)


def make():
    parts = []
    for name, value in sorted(vars(_core).items()):
        if inspect.isclass(value):
            parts.append(to_class(name, value))
        elif inspect.isroutine(value):
            parts.append(to_signature(name, value.__doc__, False))
        elif name in ("__version__", "build_id", "WORLD"):
            parts.append(f"{name}: {type(value).__name__}")
    return HEAD + "\n".join(parts) + "\n"


if __name__ == "__main__":
    print(make(), end="")
