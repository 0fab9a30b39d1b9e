# SPDX-License-Identifier: BSD-3-Clause
"""Copies pages, and what they link, in the folders of the sources, as mkdocs takes them."""
import os
import pathlib
import re
import shutil

from website import formulas

# Fenced and other code, in which nothing is a link; links; citations.
PART = re.compile(r"(?P<code>^```.*?^```$|`[^`\n]+`)"
                  r"|(?P<link>\]\((?P<target>[^()\s]+)\))"
                  r"|\[(?P<cite>@[\w@;, .§-]+)\]"
                  r"|<!-- (?P<kind>in motion|to play): (?P<shown>\w+) -->", re.MULTILINE | re.DOTALL)
LITERATURE = "docs/references" + ".md"  # made, as all below: no page of the sources
REFERENCE = "docs/reference"
PLAIN = (".png", ".svg", ".schema.json")  # files that the site has as they are
LANGUAGES = {".toml": "toml", ".cpp": "cpp", ".hpp": "cpp", ".py": "python", ".urdf": "xml",
             ".json": "json", ".cff": "yaml"}
MOTION = """<div class="motion"><iframe src="{page}" title="{name} {kind}" loading="lazy"></iframe>
<a href="{page}">Open it alone</a></div>
"""


class Tree:
    """The pages of a site, in `folder`."""

    def __init__(self, source, folder):
        self.source, self.folder = source, folder

    def add(self, name, text):
        """A page that is made, not of the sources."""
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def add_reached(self, first):
        """All pages that links reach from the first, and files that they show."""
        ahead, seen = [pathlib.Path(first)], set()
        while ahead:
            page = ahead.pop()
            if page in seen:
                continue
            seen.add(page)
            if page.suffix == ".md":
                text = (self.source / page).read_text()
                self.add(page, self._convert(page, text, ahead))
            elif page.name.endswith(PLAIN):
                (self.folder / page).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(self.source / page, self.folder / page)
            elif (self.source / page).is_dir():
                self.add(f"{page}.md", self._list(page, ahead))
            else:
                self.add(f"{page}.md", self._show(page))

    def _list(self, folder, ahead):
        """A folder as a page of links to its files."""
        files = sorted(file for file in (self.source / folder).iterdir() if file.is_file())
        ahead += [folder / file.name for file in files]
        return f"# {folder.name}\n\n" + "".join(
            f"- [{file.name}]({folder.name}/{file.name}.md)\n" for file in files)

    def _show(self, file):
        """A text file as a page."""
        text = (self.source / file).read_text()
        return f"# {file.name}\n\n```{LANGUAGES.get(file.suffix, 'text')}\n{text.rstrip()}\n```\n"

    def _convert(self, page, text, ahead):
        def replace(match):
            if code := match["code"]:
                return title_block(code)
            if name := match["shown"]:
                return self._show_motion(page, match["kind"], name)
            if cite := match["cite"]:
                return self._cite(page, cite)
            return f"]({self._follow(page, match['target'], ahead)})"
        return formulas.render(page, PART.sub(replace, text))

    def _relate(self, page, target):
        return os.path.relpath(target, page.parent)

    def _show_motion(self, page, kind, name):
        """A page that motion.py made, if it did."""
        file = pathlib.Path(kind.split()[1]) / f"{name}.html"
        if not (self.folder / file).exists():
            return ""
        return MOTION.format(name=name, kind=kind, page=self._relate(page, file))

    def _cite(self, page, cite):
        key = re.match(r"@(\w+)", cite).group(1)
        literature = self._relate(page, LITERATURE)
        return f"[\\[{cite.replace('@', '')}\\]]({literature}#{key})"

    def _follow(self, page, target, ahead):
        """The link from a page of the site; what it leads to goes to the site, too."""
        path, _, anchor = target.partition("#")
        if re.match(r"[a-z]+:", target) or not path:
            return target
        file = pathlib.Path(os.path.normpath(page.parent / path))
        if file.name == "references.bib":
            return self._relate(page, LITERATURE)
        if (self.source / file / "README.md").exists():
            file /= "README.md"
        ahead.append(file)
        shown = file if file.name.endswith((".md", *PLAIN)) else f"{file}.md"
        return self._relate(page, shown) + (f"#{anchor}" if anchor else "")


def title_block(code):
    """A fence without the words that are for tests, with the name of its file as a title."""
    fence = re.match(r"```(\w*)([^\n]*)\n", code)
    if not fence or fence[1] == "math":
        return code
    name = re.search(r"\bfile=(\S+)", fence[2])
    title = f' title="{name[1]}"' if name else ""
    return f"```{fence[1] or 'text'}{title}\n{code[fence.end():]}"
