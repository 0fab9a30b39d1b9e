#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the site by scripts/site, and checks that it needs no server and no other host: every link is
relative and leads to a file and a heading of the site, nothing is loaded from elsewhere, each page
of docs/ is there, the search finds words, and also does so in a browser that reads the site from disk.

  check_site.py SOURCE_FOLDER BUILD_FOLDER WORK_FOLDER
"""
import html.parser
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

SKIPPED = 77
LOADED = {"script": "src", "img": "src", "iframe": "src", "link": "href", "source": "src"}


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.links, self.loaded, self.anchors = [], [], set()
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        self.anchors.update(filter(None, (of.get("id"), of.get("name"))))
        if tag in LOADED and of.get(LOADED[tag]):
            self.loaded.append(of[LOADED[tag]])
        elif tag == "a" and of.get("href"):
            self.links.append(of["href"])


def read_pages(site):
    """Those of the site; the pages of limber view, which are whole in themselves, are not among them."""
    return {file: Page(file) for file in sorted(site.rglob("*.html")) if file.parent.name != "motion"}


def find_lost(pages, site):
    problems = []
    for file, page in pages.items():
        name = file.relative_to(site)
        for target in page.loaded + page.links:
            parts = urllib.parse.urlsplit(target)
            if parts.scheme or parts.netloc:
                if target in page.loaded or parts.scheme not in ("https", "http", "mailto"):
                    problems.append(f"{name}: loads {target}")
                continue
            if target.startswith("/"):
                problems.append(f"{name}: {target} is not relative")
                continue
            path = urllib.parse.unquote(parts.path)
            goal = (file.parent / path).resolve() if path else file
            anchor = urllib.parse.unquote(parts.fragment)
            if not goal.is_file():
                problems.append(f"{name}: {target}: no such file")
            elif anchor and goal in pages and anchor not in pages[goal].anchors:
                problems.append(f"{name}: {target}: no such heading")
    return problems


def find_foreign_styles(site):
    return [f"{file.relative_to(site)}: loads {url}" for file in site.rglob("*.css")
            for url in re.findall(r"url\(['\"]?((?:https?:)?//[^)'\"]+)", file.read_text())]


def find_missing_pages(source, site):
    return [f"{page.relative_to(source)} is not in the site" for page in sorted((source / "docs").rglob("*.md"))
            if not (site / page.relative_to(source)).with_suffix(".html").is_file()]


def check_search(site):
    """Words of pages of every kind, and of the generated ones."""
    index = json.loads((site / "search/search_index.json").read_text())
    texts = {}
    for part in index["docs"]:
        page = part["location"].partition("#")[0]
        texts[page] = texts.get(page, "") + part["title"] + part["text"]
    wanted = {"docs/tutorials/catch.html": "tumbl", "docs/how-to/choose_step.html": "tolerance",
              "docs/reference/scenario.html": "rolling_friction", "docs/theory/equations.html": "Tisserand",
              "docs/reference/commands/run.html": "--resume",
              "docs/reference/keys/index.html": "newton_iterations",
              "docs/reference/python/functions.html": "youngs_modulus",
              "docs/reference/cpp/dynamics_analysis_natural_frequencies.html": "find_natural_modes"}
    return [f"search: {page} lacks '{word}'" for page, word in wanted.items()
            if word not in texts.get(page, "")]


def check_in_browser(site):
    """The search, of a page from disk."""
    if shutil.which("chromium") is None:
        print("the browser was left out: there is no chromium")
        return []
    with tempfile.TemporaryDirectory() as profile:
        shown = subprocess.run(
            ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}",
             "--virtual-time-budget=20000", "--dump-dom", f"{(site / 'docs/index.html').as_uri()}?q=restitution"],
            capture_output=True, text=True).stdout
    if re.search(r"\d+ matching documents", shown):
        return []
    return ["chromium: the search from disk finds nothing"]


def main():
    source, build, work = (pathlib.Path(text).resolve() for text in sys.argv[1:4])
    shutil.rmtree(work, ignore_errors=True)
    made = subprocess.run([source / "scripts/site", "-o", work, "--build", build], capture_output=True, text=True)
    print(made.stdout, made.stderr, sep="")
    if made.returncode != 0 and "--with-site" in made.stderr:
        sys.exit(SKIPPED)
    if made.returncode != 0:
        sys.exit("scripts/site failed")
    pages = read_pages(work)
    problems = [*find_lost(pages, work), *find_foreign_styles(work), *find_missing_pages(source, work),
                *check_search(work), *check_in_browser(work)]
    if len(pages) < 100 or sum(len(page.links) for page in pages.values()) < 5000:
        problems.append("pages or links were not found")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{len(pages)} pages, {sum(len(page.links) for page in pages.values())} links")


main()
