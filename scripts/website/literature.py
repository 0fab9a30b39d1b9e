# SPDX-License-Identifier: BSD-3-Clause
"""docs/references.bib as a page."""
import re

FIELD = re.compile(r"(\w+)\s*=\s*\{(.*?)\},?\s*\n", re.DOTALL)
ENTRY = re.compile(r"@\w+\{(\w+),\n(.*?)\n\}", re.DOTALL)
ACCENTS = {r"{\AA}": "Å", r'{\"o}': "ö", r'{\"u}': "ü", r'{\"a}': "ä", r"{\'e}": "é", r"{\o}": "ø",
           r'\"o': "ö", r'\"u': "ü", r'\"a': "ä", r"\'e": "é", r"\&": "&"}


def clean(text):
    for latex, letter in ACCENTS.items():
        text = text.replace(latex, letter)
    return " ".join(text.replace("{", "").replace("}", "").replace("--", "–").split())


def describe(fields):
    of = {key: clean(value) for key, value in fields}
    volume = of.get("volume", "") + (f"({of['number']})" if "number" in of else "")
    where = [of.get(key) for key in ("journal", "booktitle", "publisher", "institution", "school")]
    parts = [" and ".join(of.get("author", of.get("editor", "")).split(" and ")), of.get("title"),
             of.get("edition") and f"edition {of['edition']}", *where, volume, of.get("pages"),
             of.get("year"), of.get("note"), of.get("doi") and f"doi:{of['doi']}", of.get("url")]
    return ", ".join(part for part in parts if part)


def write(file):
    lines = ["# Literature", ""]
    for key, body in sorted(ENTRY.findall(file.read_text())):
        lines += [f'<a id="{key}"></a>**{key}**: {describe(FIELD.findall(body + chr(10)))}.', ""]
    return "\n".join(lines)
