# SPDX-License-Identifier: BSD-3-Clause
"""Pages of the Python module: every public name with its signature and text."""
import json
import subprocess
import sys

from website.stage import REFERENCE

# In a process of its own, so that the module is that of the build.
ASK = r"""
import inspect, json, re, limber

def sign(name, thing):
    text = inspect.getdoc(thing) or ""
    try:
        return f"{name}{inspect.signature(thing)}", text
    except (TypeError, ValueError):
        pass
    # pybind11: the first line is the signature; of overloads each has one.
    lines = text.split("\n")
    if lines and lines[0].startswith(name.split(".")[-1] + "("):
        own = name.split(".")[-1]
        signatures = [l for l in re.sub(r"(?m)^\d+\. ", "", text).split("\n") if l.startswith(own + "(")]
        rest = [l for l in lines if not re.sub(r"^\d+\. ", "", l).startswith(own + "(")
                and l != "Overloaded function."]
        clean = lambda l: re.sub(r"limber\._core\.|self: \w[\w.]*(, )?", "", l)
        return "\n".join(clean(l) for l in dict.fromkeys(signatures)), "\n".join(rest).strip()
    return name, text

def members(thing):
    for name, member in vars(thing).items():
        if name.startswith("_"):
            continue
        if isinstance(member, property):
            yield name, inspect.getdoc(member) or ""
        elif callable(member) or isinstance(member, (staticmethod, classmethod)):
            yield sign(name, getattr(thing, name))

found = []
for name in sorted(limber.__all__, key=str.lower):
    thing = getattr(limber, name)
    if inspect.isclass(thing):
        made, _ = sign("__init__", thing.__init__)
        if not made.startswith("__init__(") or "*args" in made:
            made = "__init__()"
        head = made.replace("__init__", name).replace("(self, ", "(").replace("(self)", "()")
        head = head.replace(" -> None", "")
        found.append([name, "class", head, inspect.getdoc(thing) or "", list(members(thing))])
    elif callable(thing):
        found.append([name, "function", *sign(name, thing), []])
print(json.dumps(found))
"""


def quote(text):
    """A text of reStructuredText's few marks as Markdown."""
    return text.replace("``", "`").replace(":class:", "").replace(":meth:", "").replace("<", "&lt;")


def describe(name, signature, text, members):
    lines = [f"## {name}", "", "```python", signature, "```", "", quote(text), ""]
    for signature, text in members:
        lines += [f"**`{' '.join(signature.split())}`**", "", quote(text) or "&nbsp;", ""]
    return lines


def write(folder, tree):
    """Names of the pages."""
    answer = subprocess.run([sys.executable, "-c", ASK], env={"PYTHONPATH": str(folder)},
                            capture_output=True, text=True)
    if answer.returncode != 0:
        sys.exit(f"site: needs the Python module in {folder}: {answer.stderr}")
    pages = []
    for kind, title in (("function", "Functions"), ("class", "Classes")):
        lines = [f"# Python: {title.lower()}", "",
                 f"All {title.lower()} of the module `limber`; [how it is used](../python.md).", ""]
        for name, its, signature, text, members in json.loads(answer.stdout):
            if its == kind:
                lines += describe(name, signature, text, members)
        pages.append(f"{REFERENCE}/python/{title.lower()}.md")
        tree.add(pages[-1], "\n".join(lines))
    return pages
