#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the manual pages describe every key that the readers of scenarios, controllers
and robots read.

  check_keys.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

READ = re.compile(r"(?:\b(?:table|root|source|source\.table|values|changes|sources|robot|item|base|"
                  r"element|child|given|by_name|xml)\b(?:\.|->))"
                  r"(?:has|text|texts|number|numbers|number_or_numbers|integer|boolean|vector|table|"
                  r"tables|required_\w+|is_array|is_table|is_text)\(\s*\"([a-z_]+)\"")
PAGES = {
    "src/scene/scenario": ("docs/reference/scenario.md", "docs/reference/controllers.md"),
    "src/scene/robot": ("docs/reference/urdf.md", "docs/reference/scenario.md"),
}


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    problems, count = [], 0
    for folder, pages in PAGES.items():
        words = set()
        for page in pages:
            words |= set(re.findall(r"[a-z_]+", (source / page).read_text()))
        for file in sorted((source / folder).glob("*.cpp")):
            for key in sorted(set(READ.findall(file.read_text()))):
                count += 1
                if key not in words:
                    problems.append(f"{file.relative_to(source)}: '{key}' is not in {pages[0]}")
    if count < 100:
        problems.append(f"only {count} keys were found")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{count} keys")


main()
