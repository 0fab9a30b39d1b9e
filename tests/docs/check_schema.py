#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares docs/reference/scenario.schema.json with the reader of scenarios, by what `limber check` answers:

- every table, with an unknown key in it: the reader lists the keys that it knows, which are those of the schema;
- every key with a value of another type: the reader refuses it;
- every name of several with another: the reader lists those that it knows;
- every number at and beyond its bounds: the reader has the same bounds.

  check_schema.py LIMBER SOURCE_FOLDER WORK_FOLDER
"""
import dataclasses
import json
import pathlib
import re
import shutil
import subprocess
import sys

UNKNOWN = "zz_unknown"
# Keys that the reader knows in order to refuse them with a reason, and the tables in which it does.
REFUSED = {"distribution": ("of stress",), "rpy": ("a place on a link", "via")}
# A quantity of a link is of its motion or of stress, which the schema tells apart by its name.
SHARED = ("probe: of a point", "probe: of stress")
ROBOT = """<robot name="one"><link name="l"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""


@dataclasses.dataclass
class Table:
    name: str  # for messages
    schema: dict  # of one kind of table
    wrap: object  # makes a whole scenario of a table


def options(schema):
    """The kinds of value that a schema allows."""
    if "oneOf" not in schema or "properties" in schema:
        return [schema]
    return [option for part in schema["oneOf"] for option in options(part)]


def example(schema, whole=False):
    """A value: with the required keys, or with all."""
    schema = options(schema)[0]
    if "const" in schema:
        return schema["const"]
    if "enum" in schema:
        return schema["enum"][0]
    kind = schema["type"]
    if kind == "object":
        asked = schema.get("properties", {}) if whole else required(schema)
        return {key: example(schema["properties"][key], whole) for key in asked}
    if kind == "array":
        count = schema.get("minItems", 0 if schema["items"].get("type") == "object" or "oneOf" in schema["items"] else 1)
        return [example(schema["items"], whole) for _ in range(count)]
    if kind in ("number", "integer"):
        return schema.get("minimum", schema.get("exclusiveMinimum", 0) + 1 if "exclusiveMaximum" not in schema
                          and schema.get("maximum", 1) >= 1 else 0.25)
    return True if kind == "boolean" else "l"


def required(schema):
    """Keys that must be there, with the first of alternatives."""
    first = next((part["required"] for key in ("oneOf", "anyOf") for part in schema.get(key, [])[:1]), [])
    return [*schema.get("required", []), *first]


def find_tables(schema, name, wrap):
    """All tables within a value's schema."""
    for option in options(schema):
        if option.get("type") == "array":
            yield from find_tables(option["items"], name, lambda item, w=wrap: w([item]))
        if option.get("type") != "object":
            continue
        rest = option.get("additionalProperties")
        if isinstance(rest, dict):
            yield from find_tables(rest, f"{name}.NAME", lambda item, w=wrap: w({"l": item}))
            continue
        of = f"{name}: {option['description']}" if option is not schema and "oneOf" in schema else name
        of = of.removeprefix("the file / ")
        of += "".join(f", {key} {part['const']}" for key, part in option["properties"].items() if "const" in part)
        yield Table(of, option, wrap)
        for key, part in option["properties"].items():
            yield from find_tables(part, f"{of} / {key}",
                                   lambda item, w=wrap, o=option, k=key: w({**example(o), k: item}))


def to_toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(k)} = {to_toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(to_toml, value)) + "]"
    return json.dumps(value)


class Reader:
    def __init__(self, limber, work):
        self.limber, self.work, self.asked = limber, work, 0
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        (work / "l").write_text(ROBOT)

    def read(self, table, values):
        """What the reader says of a scenario with this table."""
        self.asked += 1
        scenario = {"robot": "l", "time": {"duration": 1.0}, **table.wrap(values)}
        file = self.work / "scenario.toml"
        file.write_text("".join(f"{key} = {to_toml(value)}\n" for key, value in scenario.items()))
        return subprocess.run([self.limber, "check", file], capture_output=True, text=True).stderr


def list_known(said, what):
    """The names that the reader knows in place of an unknown one."""
    found = re.search(rf"unknown {what}(?: '[^']*')?.*? \(known: ([^)]*)\)", said)
    return set(found.group(1).split(", ")) - {"none"} if found else set()


def variants(schema):
    """Values that lead the reader through all that it knows of a table."""
    yield example(schema)
    yield example(schema, whole=True)
    for key in schema.get("required", []):
        for name in schema["properties"][key].get("enum", [])[1:]:
            yield {**example(schema), key: name}


def compare_keys(reader, table):
    known = set()
    for values in variants(table.schema):
        known |= list_known(reader.read(table, {**values, UNKNOWN: 1}), f"(?:key|attribute) '{UNKNOWN}'")
        if table.name.startswith("coupler"):  # whose tables are elements
            known |= list_known(reader.read(table, {**values, UNKNOWN: {"l": 1}}), f"element '{UNKNOWN}'")
    keys = set(table.schema["properties"])
    if table.name.startswith("coupler") and ", type " in table.name and " / " not in table.name:
        keys.discard("type")  # of [[coupler]], which makes an element of this name
    own = [f"{table.name}: the reader does not know '{key}'" for key in sorted(keys - known)]
    return own + [f"{table.name}: the schema lacks '{key}'" for key in sorted(known - keys)
                  if not table.name.endswith(REFUSED.get(key, ()))]


def ask_all(reader, table, values, is_right):
    """The keys about whose values the reader's answer is not right: asked of all at once, and of those that then
    seem wrong, as errors of others may hide theirs, one by one."""
    said = reader.read(table, {**example(table.schema), **values})
    for key, value in values.items():
        if not is_right(said, key, value):
            alone = reader.read(table, {**example(table.schema), key: value})
            if not is_right(alone, key, value):
                yield key, value, alone


def other_type(schema):
    """A value of a type that the schema does not allow."""
    kinds = {option["type"] for option in options(schema)}
    if kinds == {"string"}:
        return 12
    if "boolean" in kinds:
        return "perhaps"
    return "none" if "string" not in kinds else True


def names(said, key):
    """Whether an error is about a key."""
    return re.search(rf"\b{re.escape(key)}\b", said.replace(UNKNOWN, "")) is not None


def compare_types(reader, table):
    is_coupler = table.name.startswith("coupler")  # whose values are attributes: texts
    values = {key: other_type(schema) for key, schema in table.schema["properties"].items()
              if "const" not in schema and not (is_coupler and other_type(schema) in (12, True))}
    return [f"{table.name}: the reader takes {key} = {value!r}: {said}" for key, value, said in ask_all(
        reader, table, values, lambda said, key, _: "error" in said and names(said, key))]


def compare_names(reader, table, shared):
    values = {key: f"{UNKNOWN}_{key}" for key, schema in table.schema["properties"].items() if "enum" in schema}

    def is_same(said, key, value):
        is_shared = key == "quantity" and table.name in SHARED
        expected = shared if is_shared else table.schema["properties"][key]["enum"]
        return list_known(said, rf"[\w ]+ '{value}'") == set(expected)
    return [f"{table.name}: {key} has other names in the schema: {said}"
            for key, _, said in ask_all(reader, table, values, is_same)]


def bounds(schema):
    """Numbers that it refuses, and numbers that it takes: at the bounds, and far away where there is none."""
    whole = schema["type"] == "integer"
    refused, taken = [], []
    for inside, outside, side in (("minimum", "exclusiveMinimum", -1), ("maximum", "exclusiveMaximum", 1)):
        if outside in schema:
            refused.append(schema[outside])
        elif inside in schema:
            taken.append(schema[inside])
            refused.append(schema[inside] + side * (1 if whole else 1e-6 + 1e-6 * abs(schema[inside])))
        else:
            taken.append(side * 1e3)
    return refused, taken


def is_refused(said, key, value):
    """Whether the reader says that this value is out of bounds."""
    return re.search(rf"\b{re.escape(key)}(: is|=\"?{re.escape(str(value))}|: expected| ).*expected a (whole )?"
                     r"(finite )?number", said) is not None


def compare_bounds(reader, table):
    problems = []
    of = {key: bounds(schema) for key, schema in table.schema["properties"].items()
          if schema.get("type") in ("number", "integer")}
    for wanted, word in ((0, "takes"), (1, "refuses")):
        for i in range(2):
            values = {key: found[wanted][i] for key, found in of.items() if len(found[wanted]) > i}
            problems += [f"{table.name}: the reader {word} {key} = {value}: {said}" for key, value, said in ask_all(
                reader, table, values, lambda said, key, value, w=wanted: is_refused(said, key, value) == (w == 0))]
    return problems


def main():
    limber, source, work = (pathlib.Path(text).resolve() for text in sys.argv[1:4])
    schema = json.loads((source / "docs/reference/scenario.schema.json").read_text())
    reader, problems, count = Reader(limber, work), [], 0
    of_links = schema["properties"]["probe"]["items"]["oneOf"][:len(SHARED)]
    shared = [name for part in of_links for name in part["properties"]["quantity"]["enum"]]
    for table in find_tables(schema, "the file", lambda values: values):
        count += len(table.schema["properties"])
        problems += compare_keys(reader, table) + compare_types(reader, table) + compare_bounds(reader, table)
        problems += compare_names(reader, table, shared)
    if count < 300:
        problems.append(f"only {count} keys were found")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{count} keys, {reader.asked} scenarios")


main()
