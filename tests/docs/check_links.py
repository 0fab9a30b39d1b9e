#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that relative links of all pages lead to files and headings that exist, that
sources name pages that exist, and that docs/index.md reaches every page of docs/.

  check_links.py SOURCE_FOLDER
"""
import functools
import os
import pathlib
import re
import subprocess
import sys

PAGE_NAME = re.compile(r"(?<![\w/.-])docs/[\w/-]+\.(?:md|bib|png)")
LINK = re.compile(r"!?\[(?:[^\]\[]|\[[^\]]*\])*\]\(([^()\s]+)\)")


def list_files(source):
    """Those of git; of a copy without git, all."""
    listed = subprocess.run(["git", "-C", source, "ls-files", "-z", "--cached", "--others",
                             "--exclude-standard"], capture_output=True, text=True)
    if listed.returncode == 0:
        files = [source / name for name in listed.stdout.split("\0") if name]
    else:
        files = [pathlib.Path(folder) / name for folder, folders, names in os.walk(source)
                 for name in names if not folder.startswith(f"{source}/build")]
    return [file for file in files if file.is_file() and not file.is_symlink()]


def read_prose(page):
    """The lines of a page with their numbers, without fenced blocks."""
    fenced = False
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if line.startswith("```"):
            fenced = not fenced
        elif not fenced:
            yield number, line


@functools.cache
def find_anchors(page):
    """Of headings, as GitHub makes them: small letters, without punctuation, hyphens
    for blanks; and those given by <a id="">."""
    anchors = set()
    for _, line in read_prose(page):
        anchors.update(re.findall(r'<a id="([^"]+)">', line))
        heading = re.fullmatch(r"#{1,6} +(.*?) *", line)
        if not heading:
            continue
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.group(1))
        base = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
        anchor, count = base, 0
        while anchor in anchors:
            count += 1
            anchor = f"{base}-{count}"
        anchors.add(anchor)
    return anchors


def find_links(page):
    """Links of a page, which may go on in the next line: line number, target."""
    lines = list(read_prose(page))
    text = "\n".join(re.sub(r"`[^`]*`", "``", line) for _, line in lines)
    for match in LINK.finditer(text):
        yield lines[text.count("\n", 0, match.start())][0], match.group(1)


def check_page(page, source):
    """Problems of its links, and the pages that they lead to."""
    problems, reached = [], set()
    for number, target in find_links(page):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        place = f"{page.relative_to(source)}:{number}"
        if not file.exists():
            problems.append(f"{place}: {target}: no such file")
        elif anchor and file.suffix == ".md" and anchor not in find_anchors(file):
            problems.append(f"{place}: {target}: no such heading")
        reached.add(file)
    return problems, reached


def check_sources(files, source):
    problems = []
    for file in files:
        if file.suffix not in (".cpp", ".hpp", ".py", ".txt", ".toml", ".dict", ""):
            continue
        if "corpus" in file.parts:
            continue
        try:
            lines = file.read_text().splitlines()
        except UnicodeDecodeError:
            continue
        for number, line in enumerate(lines, 1):
            for name in PAGE_NAME.findall(line):
                if not (source / name).exists():
                    problems.append(f"{file.relative_to(source)}:{number}: {name}: no such page")
    return problems


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    files = list_files(source)
    pages = [file for file in files if file.suffix == ".md" and "data" not in file.parts]
    problems, targets = check_sources(files, source), {}
    for page in pages:
        found, targets[page] = check_page(page, source)
        problems += found
    index = source / "docs/index.md"
    reached, ahead = {index}, [index]
    while ahead:
        for page in targets.get(ahead.pop(), ()):
            if page not in reached:
                reached.add(page)
                ahead.append(page)
    docs = [page for page in pages if source / "docs" in page.parents]
    problems += [f"{page.relative_to(source)}: no link leads here from docs/index.md"
                 for page in docs if page not in reached]
    if len(docs) < 20 or sum(map(len, targets.values())) < 100:
        problems.append("pages or links were not found")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{len(pages)} pages, {sum(map(len, targets.values()))} targets")


main()
