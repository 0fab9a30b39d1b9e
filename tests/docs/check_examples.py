#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that docs/reference/scenario.schema.json is a schema and takes the scenarios of examples, benchmarks and
pages, and that it refuses them with a wrong key or value.

  check_examples.py SOURCE_FOLDER
"""
import copy
import json
import pathlib
import sys
import tomllib

try:
    import jsonschema
except ImportError:
    print("skipped: needs python3-jsonschema (scripts/install-deps --with-site)")
    sys.exit(77)

source = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(source / "tests/support"))
from page_blocks import read_blocks  # noqa: E402


def list_scenarios():
    """Names and contents."""
    for folder in ("examples", "bench"):
        for file in sorted((source / folder).rglob("*.toml")):
            yield str(file.relative_to(source)), tomllib.loads(file.read_text())
    for page in sorted((source / "docs").rglob("*.md")):
        for block in read_blocks(page):
            if block.language == "toml" and "file" in block.values or block.values.get("fragment") == "alone":
                yield f"{page.relative_to(source)}:{block.line}", tomllib.loads(block.text)
            elif block.values.get("fragment") == "merged" and block.language == "toml":
                yield (f"{page.relative_to(source)}:{block.line}",
                       {"robot": "l", "time": {"duration": 1}, **tomllib.loads(block.text)})


def spoil(value, path=""):
    """Copies with one wrong thing each: an unknown key in a table."""
    if isinstance(value, dict):
        for key, part in value.items():
            for place, wrong in spoil(part, f"{path}.{key}"):
                yield place, {**value, key: wrong}
        if not any(path.endswith(end) for end in (".links", ".joints", ".packages")):
            yield path, {**value, "zz_unknown": 1}
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        for place, wrong in spoil(value[0], f"{path}.0"):
            yield place, [wrong, *copy.copy(value[1:])]


schema = json.loads((source / "docs/reference/scenario.schema.json").read_text())
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
problems, count, spoilt = [], 0, 0
for name, scenario in list_scenarios():
    if "robot" not in scenario or "time" not in scenario:  # a study
        continue
    count += 1
    problems += [f"{name}: {'.'.join(map(str, error.absolute_path))}: {error.message}"
                 for error in validator.iter_errors(scenario)]
    for place, wrong in spoil(scenario):
        spoilt += 1
        if validator.is_valid(wrong):
            problems.append(f"{name}: an unknown key in {place or 'the file'} is taken")
if count < 40 or spoilt < 300:
    problems.append(f"only {count} scenarios were found")
if problems:
    sys.exit("\n".join(problems))
print(f"{count} scenarios, {spoilt} wrong ones")
