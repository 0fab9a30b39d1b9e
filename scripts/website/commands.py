# SPDX-License-Identifier: BSD-3-Clause
"""A page of every command, of what its --help prints."""
import re
import subprocess

from website.stage import REFERENCE

LISTED = ("Positionals", "Options", "Subcommands")


def ask(limber, *words):
    return subprocess.run([limber, *words, "--help"], capture_output=True, text=True,
                          check=True).stdout.rstrip()


def list_items(lines):
    """Names of options with their texts, which may begin in the next line."""
    items = []
    for line in lines:
        if re.match(r" {2}\S", line):
            name, _, text = line.strip().partition("  ")
            items.append([name, text.strip()])
        else:
            items[-1][1] = f"{items[-1][1]} {line.strip()}".strip()
    return items


def escape(text):
    return text.replace("|", "\\|").replace("<", "&lt;")


def describe(text, level):
    """What --help prints, with tables in place of its columns."""
    first, *parts = re.split(r"\n\n(?=[A-Z][\w ]*:\n)", text)
    said, _, usage = first.partition("\nUsage: ")
    lines = [f"{said}.".replace("..", "."), "", "```text", usage, "```", ""]
    for part in parts:
        title, *rest = part.split("\n")
        title = title.rstrip(":")
        lines += [f"{level} {title}", ""]
        if title in LISTED:
            lines += ["| | |", "|---|---|"]
            lines += [f"| `{name}` | {escape(what)} |" for name, what in list_items([one for one in rest if one])]
        else:
            lines += ["```text", *rest, "```"]
        lines.append("")
    return lines


def list_names(text):
    part = text.partition("\nSubcommands:\n")[2].partition("\n\n")[0]
    return re.findall(r"^  ([a-z]+) {2,}", part, re.MULTILINE)


def write(limber, tree):
    """Names of the pages."""
    whole = ask(limber)
    names = list_names(whole)
    if len(names) < 10:
        raise RuntimeError("limber --help lists fewer than ten commands")
    first = f"{REFERENCE}/commands/index.md"
    links = ", ".join(f"[{name}]({name}.md)" for name in names)
    tree.add(first, "\n".join(["# All commands", "", links, "", *describe(whole, "##")]))
    for name in names:
        text = ask(limber, name)
        lines = [f"# limber {name}", "", *describe(text, "##")]
        for inner in list_names(text):
            lines += [f"## limber {name} {inner}", "", *describe(ask(limber, name, inner), "###")]
        tree.add(f"{REFERENCE}/commands/{name}.md",
                 "\n".join([*lines, "[What commands have in common](../command.md)", ""]))
    return [first, *(f"{REFERENCE}/commands/{name}.md" for name in names)]
