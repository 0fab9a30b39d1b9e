# SPDX-License-Identifier: BSD-3-Clause
"""Writes results as a page: every figure beside its reference, misses as misses."""
INTRODUCTION = """\
Written by `bench/capture/run`, including all text; do not edit. What the bench asks, its rules and how
to add a tool: [Capture Bench](../README.md). A cell has the answer and its error; an error beyond the
tolerance is a **miss**. Cost is processor time of the whole program
on one thread of a shared machine, least of the repeats: only ratios within a case mean something, to about a fifth. Set-up
is what a first run takes beyond that: meshing and reduction. A run of more than 20 s is made once; its cost has the
set-up in it, and the column is empty."""


def number(value, digits=4):
    """Rounded to digits that count; without an exponent up to a million."""
    return f"{float(f'{value:.{digits}g}'):g}" if abs(value) < 1e6 and digits < 6 else f"{value:.{digits}g}"


def to_label(result):
    return f"{result['tool']}, {result['variant']}" if result.get("variant") else result["tool"]


def find_hits(case, result):
    """Hits, and quantities asked; None if there is no answer."""
    if result["status"] != "answered":
        return None
    found = result["answers"]
    hits = sum(q.name in found and q.judge(found[q.name]) for q in case.quantities)
    return hits, len(case.quantities)


def to_cell(quantity, answers):
    if quantity.name not in answers:
        return "no answer, **miss**"
    value = answers[quantity.name]
    off = value - quantity.reference
    if quantity.reference == 0.0:
        error = f"{off:+.2g}"
    else:
        percent = 100 * off / abs(quantity.reference)
        error = f"{percent:+.0f} %" if abs(percent) >= 99.5 else f"{percent:+.2g} %"
    miss = "" if quantity.judge(value) else " **miss**"
    return f"{number(value, quantity.digits)} ({error}){miss}"


def to_cost(result):
    cpu, setup = result["cpu_s"], result.get("setup_s")
    pace = number(cpu / result["simulated_s"], 2) if result.get("simulated_s") else ""
    return [number(cpu, 2), pace, "" if setup is None else number(setup, 2)]


def to_table(head, rows):
    return ["| " + " | ".join(head) + " |", "|---" + "|---:" * (len(head) - 1) + "|"] + [
        "| " + " | ".join(row) + " |" for row in rows
    ]


def write_case(case, results, drawn):
    asked = [f"{q.what} [{q.unit}]" for q in case.quantities]
    head = ["", *asked, "CPU [s]", "CPU / simulated", "set-up [s]"]
    rows = []
    for result in results:
        if result["status"] == "answered":
            cells = [to_cell(q, result["answers"]) for q in case.quantities]
            rows.append([to_label(result), *cells, *to_cost(result)])
    known = [f"{number(q.reference, q.digits + 1)} ± {number(q.uncertainty, 2)}" for q in case.quantities]
    rows.append(["**reference**", *known, "", "", ""])
    rows.append(["tolerance", *[f"± {number(q.tolerance, 2)}" for q in case.quantities], "", "", ""])
    lines = [f"## {case.title}", "", f"*{case.question}*", "", case.description.strip(), ""]
    lines += to_table(head, rows) + [""]
    for source in dict.fromkeys((q.kind, q.source) for q in case.quantities):
        lines.append(f"- Reference ({source[0]}): {source[1]}.")
    for result in results:
        if result["status"] != "answered":
            first = result["reason"].splitlines()[0]
            lines.append(f"- {to_label(result)}: {result['status']}: {first}")
        elif result.get("changes"):
            lines.append(f"- {to_label(result)}: its answers differ from run to run.")
    lines.append("")
    for name in (case.name, f"{case.name}-cost"):
        if name in drawn:
            lines += [f"![{case.title}]({name}.png)", ""]
    return lines


def find_columns(results):
    """Labels of all variants, tool by tool, in the order in which the runners list them."""
    places = {}
    for entries in results.values():
        for place, result in enumerate(r for r in entries if r.get("variant")):
            key = (result["tool"], to_label(result))
            places[key] = max(places.get(key, 0), place)
    return [label for _, label in sorted(places, key=lambda key: (key[0], places[key]))]


def to_overview(cases, results):
    """Hits of quantities asked: a row a case, a column a variant."""
    labels, rows = find_columns(results), []
    for case in cases:
        cells = dict.fromkeys(labels, "")
        for result in results[case.name]:
            hits = find_hits(case, result)
            text = result["status"] if hits is None else f"{hits[0]} / {hits[1]}"
            if result.get("variant"):
                cells[to_label(result)] = text
        rows.append([f"[{case.title}](#{to_anchor(case.title)})", *cells.values()])
    return to_table(["hits of quantities", *labels], rows)


def to_anchor(title):
    kept = "".join(c for c in title.lower() if c.isalnum() or c in " -")
    return kept.replace(" ", "-")


def write(file, cases, results, drawn):
    versions = {r["tool"]: r["version"] for entries in results.values() for r in entries}
    lines = ["# Capture Bench: results", "", INTRODUCTION, ""]
    lines += ["Tools: " + ", ".join(f"{tool} {version}" for tool, version in versions.items()) + "."]
    lines += ["", *to_overview(cases, results), ""]
    if "cost" in drawn:
        lines += ["![Error and cost](cost.png)", ""]
    for case in cases:
        lines += write_case(case, results[case.name], drawn)
    file.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


def summarize(cases, results):
    """Hits of every run, a line each, for the terminal."""
    lines = []
    for case in cases:
        for result in results[case.name]:
            hits = find_hits(case, result)
            text = result["status"] if hits is None else f"{hits[0]} of {hits[1]} hit"
            lines.append(f"{case.name:18} {to_label(result):22} {text}")
    return "\n".join(lines)
