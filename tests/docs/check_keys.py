#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the manual pages describe every key of scenarios, those of their schema (which
check_schema.py compares with the reader), and every key that the readers of robots read.

  check_keys.py SOURCE_FOLDER
"""
import json
import pathlib
import re
import sys

SCHEMA = "docs/reference/scenario.schema.json"
SCENARIO_PAGES = ("docs/reference/scenario.md", "docs/reference/controllers.md", "docs/reference/urdf.md")
READ = re.compile(r"(?:\b(?:robot|item|base|element|child|given|by_name|xml)\b(?:\.|->))"
                  r"(?:has|text|texts|number|numbers|number_or_numbers|integer|boolean|vector|table|"
                  r"tables|required_\w+|is_array|is_table|is_text)\(\s*\"([a-z_]+)\"")
ROBOT_PAGES = ("docs/reference/urdf.md", "docs/reference/scenario.md")


def list_keys(schema):
    """Keys and names of choices, as kinds of signals and quantities of probes."""
    if isinstance(schema, list):
        return set().union(*map(list_keys, schema))
    if not isinstance(schema, dict):
        return set()
    keys = set(schema.get("properties", {}))
    names = {name for name in [schema.get("const"), *schema.get("enum", [])] if isinstance(name, str)}
    return keys | names | set().union(*map(list_keys, schema.values()))


def main():
    source = pathlib.Path(sys.argv[1]).resolve()

    def read_words(pages):
        return {word for page in pages for word in re.findall(r"[\w-]+", (source / page).read_text())}
    problems, words = [], read_words(SCENARIO_PAGES)
    keys = list_keys(json.loads((source / SCHEMA).read_text()))
    problems += [f"{SCHEMA}: '{key}' is not in {SCENARIO_PAGES[0]}" for key in sorted(keys - words)]
    words, count = read_words(ROBOT_PAGES), len(keys)
    scene = source / "src/limber/scene"
    for file in [*sorted((scene / "robot").glob("*.cpp")), scene / "text/section_reader.cpp"]:
        for key in sorted(set(READ.findall(file.read_text()))):
            count += 1
            if key not in words:
                problems.append(f"{file.relative_to(source)}: '{key}' is not in {ROBOT_PAGES[0]}")
    if len(keys) < 200 or count < 250:
        problems.append(f"only {count} keys were found")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{count} keys")


main()
