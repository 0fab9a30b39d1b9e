#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the site by scripts/site, and checks that it needs no server and no other host: every link is
relative and leads to a file and a heading of the site, nothing is loaded from elsewhere, each page
of docs/ is there, the search finds words, and also does so in a browser that reads the site from disk.

  check_site.py SOURCE_FOLDER BUILD_FOLDER WORK_FOLDER
"""
import functools
import html.parser
import http.server
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
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
    return {file: Page(file) for file in sorted(site.rglob("*.html")) if file.parent.name not in ("motion", "play")}


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


def find_odd_headings(site):
    """Of tables of keys: brackets that are no [[TABLE]]."""
    text = (site / "docs/reference/keys/index.html").read_text()
    headings = [re.sub(r"<[^>]+>", "", part) for part in re.findall(r"<h3[^>]*>(.*?)</h3>", text)]
    odd = [heading for heading in headings if re.search(r"[\[\]]", re.sub(r"\[\[\w+\]\]", "", heading))]
    problems = [f"keys: the heading '{heading}'" for heading in odd]
    return problems if len(headings) > 50 else [*problems, f"keys: only {len(headings)} headings"]


def find_plain_formulas(source, site):
    """Pages whose formulas are not all rendered."""
    problems, count = [], 0
    for page in sorted((source / "docs").rglob("*.md")):
        wanted = len(re.findall(r"^```math$", page.read_text(), re.MULTILINE))
        text = (site / page.relative_to(source)).with_suffix(".html").read_text()
        count += wanted
        if text.count("<math ") != wanted or "\\begin{" in text:
            problems.append(f"{page.relative_to(source)}: {text.count('<math ')} of {wanted} formulas are rendered")
    return problems if count > 50 else [*problems, f"only {count} formulas were found"]


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


class Host(http.server.SimpleHTTPRequestHandler):
    """Serves the site in a folder of its own, and keeps the paths that it could serve."""
    served = []

    def log_request(self, code="-", size="-"):
        if int(code) == 200:
            self.served.append(self.path)


def open_page(address):
    """The page as the browser shows it (workers go on beside it)."""
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run(
            ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}",
             "--virtual-time-budget=20000", "--dump-dom", address], capture_output=True, text=True).stdout


def check_in_browser(site):
    """The search of a page from disk, and what it loads from a folder of a host, where it is a worker."""
    if shutil.which("chromium") is None:
        print("the browser was left out: there is no chromium")
        return []
    page, problems = "docs/index.html?q=restitution", []
    if not re.search(r"\d+ matching documents", open_page(f"{site.as_uri()}/{page}")):
        problems.append("chromium: the search from disk finds nothing")
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Host, directory=site.parent))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    open_page(f"http://127.0.0.1:{server.server_port}/{site.name}/{page}")
    server.shutdown()
    for part in ("search/search_index.json", "javascripts/workers/search"):
        if not any(part in path for path in Host.served):
            problems.append(f"chromium: a page of a host does not load {part}")
    return problems


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
                *find_plain_formulas(source, work), *find_odd_headings(work),
                *check_search(work), *check_in_browser(work)]
    if len(pages) < 100 or sum(len(page.links) for page in pages.values()) < 5000:
        problems.append("pages or links were not found")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{len(pages)} pages, {sum(len(page.links) for page in pages.values())} links")


main()
