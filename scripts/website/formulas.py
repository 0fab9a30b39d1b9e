# SPDX-License-Identifier: BSD-3-Clause
"""Formulas (```math) as HTML, with MathML for those who listen: by KaTeX, under node, when the site is
made. A page needs its style and fonts, and no script."""
import json
import pathlib
import re
import shutil
import subprocess

FOLDER = pathlib.Path("/usr/share/javascript/katex")  # of libjs-katex
FORMULA = re.compile(r"^```math\n(.*?)\n```$", re.MULTILINE | re.DOTALL)
SOURCE = re.compile(r"<annotation.*?</annotation>", re.DOTALL)  # a third time the same
OLD_FONT = re.compile(r",url\([\w/-]+\.(?:woff|ttf)\) format\(\"\w+\"\)")
STYLE = "katex.css"
ASK = """
const katex = require(process.argv[1]);
const texts = JSON.parse(require("fs").readFileSync(0, "utf8"));
const options = {displayMode: true, throwOnError: true, strict: "error"};
console.log(JSON.stringify(texts.map((text) => katex.renderToString(text, options))));
"""


def render(page, text):
    """A page with its formulas rendered; one that KaTeX does not take ends the build."""
    formulas = FORMULA.findall(text)
    if not formulas:
        return text
    answer = subprocess.run(["node", "-e", ASK, FOLDER / "katex.js"], input=json.dumps(formulas),
                            capture_output=True, text=True)
    if answer.returncode != 0:
        raise SystemExit(f"site: {page}: {answer.stderr}")
    shown = iter(json.loads(answer.stdout))
    return FORMULA.sub(lambda _: f'<div class="formula">{SOURCE.sub("", next(shown))}</div>', text)


def copy_style(pages):
    """The style of all formulas, and its fonts."""
    (pages / STYLE).write_text(OLD_FONT.sub("", (FOLDER / "katex.min.css").read_text()))
    (pages / "fonts").mkdir()
    for font in (FOLDER / "fonts").glob("*.woff2"):
        shutil.copyfile(font, pages / "fonts" / font.name)
