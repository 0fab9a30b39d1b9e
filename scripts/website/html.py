# SPDX-License-Identifier: BSD-3-Clause
"""Pages to HTML by mkdocs, with the theme material; navigation by the four kinds of pages."""
import json
import logging
import pathlib
import re
import shutil
import sys

import mkdocs.commands.build
import mkdocs.config

from website import formulas, stage

THEME = pathlib.Path(__file__).parent / "theme"
SHOWN = re.compile(r"\.\w+\.html(#|$)")  # pages of files that are no pages
GALLERY = "docs/gallery.md"
FEATURES = ["navigation.tabs", "navigation.indexes", "navigation.top", "search.highlight"]
PALETTE = [
    {"media": "(prefers-color-scheme: light)", "scheme": "default", "primary": "blue grey",
     "accent": "deep orange", "toggle": {"icon": "material/weather-night", "name": "Dark"}},
    {"media": "(prefers-color-scheme: dark)", "scheme": "slate", "primary": "blue grey",
     "accent": "deep orange", "toggle": {"icon": "material/weather-sunny", "name": "Light"}}]


def make_anchor(text, separator):
    """As those of GitHub, so that links lead to the same headings."""
    return re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", separator)


def list_links(source, heading):
    """Pages that docs/index.md links under a heading, in order, each once."""
    text = (source / "docs/index.md").read_text()
    part = re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL).group(1)
    links = re.findall(r"\]\(([\w/.-]+\.md)", part)
    return list(dict.fromkeys(f"docs/{link}" for link in links if not link.startswith("..")))


def title(pages, entry):
    """An entry of the navigation with the first heading of each page as its title."""
    if isinstance(entry, dict):
        return {name: [title(pages, one) for one in part] for name, part in entry.items()}
    heading = re.search(r"^# (.*)$", (pages / entry).read_text(), re.MULTILINE).group(1)
    return {heading.replace("`", ""): entry}


def make_navigation(source, pages, made):
    theory = list_links(source, "Theory")
    reference = list_links(source, "Reference")
    return [title(pages, entry) for entry in [
        {"Start": ["README.md", "docs/index.md", "CHANGELOG.md", "SUPPORT.md", "SECURITY.md",
                   "CONTRIBUTING.md"]},
        {"Tutorials": [page for page in list_links(source, "Tutorials") if page != GALLERY]},
        {"Gallery": [GALLERY]},
        {"How to": list_links(source, "How to")},
        {"Reference": [*reference, stage.LITERATURE,
                       *({name: pages} for name, pages in made.items())]},
        {"Theory": [page for page in theory if "/decisions/" not in page]
         + [{"Decisions": [page for page in theory if "/decisions/" in page]}]},
        {"Measured": ["bench/README.md"]}]]


def build(source, pages, made, out):
    for file in sorted(THEME.glob("*.*")):
        if file.suffix in (".css", ".js"):
            shutil.copyfile(file, pages / file.name)
    formulas.copy_style(pages)
    config = pages.parent / "mkdocs.yml"
    config.write_text("site_name: Limber\n")
    settings = {
        "docs_dir": str(pages), "site_dir": str(out), "site_description":
        "Simulation of flexible capture arms with contact", "nav": make_navigation(source, pages, made),
        "theme": {"name": "material", "custom_dir": str(THEME), "font": False, "palette": PALETTE,
                  "features": FEATURES, "icon": {"logo": "material/robot-industrial"}},
        "use_directory_urls": False, "extra_css": [formulas.STYLE, "limber.css"], "plugins": ["search"],
        "markdown_extensions": ["attr_list", "md_in_html", {"toc": {"slugify": make_anchor, "toc_depth": 3}},
                                "pymdownx.superfences", {"pymdownx.highlight": {"guess_lang": False}}],
        "extra": {"generator": False, "homepage": "index.html"}}
    messages = Messages()
    logging.getLogger("mkdocs").addHandler(messages)
    mkdocs.commands.build.build(mkdocs.config.load_config(str(config), **settings))
    write_index(out)
    for name in ("404.html", "sitemap.xml", "sitemap.xml.gz"):  # which need an address
        (out / name).unlink(missing_ok=True)
    if messages.texts:
        sys.exit("site: " + "\n      ".join(messages.texts))


def write_index(out):
    """The index of the search without files of examples, and as a script, which a page can read from
    disk."""
    file = out / "search/search_index.json"
    index = json.loads(file.read_text())
    index["docs"] = [part for part in index["docs"] if not SHOWN.search(part["location"])]
    text = json.dumps(index, ensure_ascii=False)
    file.write_text(text)
    file.with_suffix(".js").write_text(f"var limber_search_index = {text};\n")


class Messages(logging.Handler):
    """Warnings of mkdocs, such as links that lead nowhere."""

    def __init__(self):
        super().__init__(logging.WARNING)
        self.texts = []

    def emit(self, record):
        self.texts.append(record.getMessage())
