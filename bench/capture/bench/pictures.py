# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of results by gnuplot: a case's curves, and error over cost of all."""
import subprocess

COLOURS = ("#999999", "#56b4e9", "#e69f00", "#d55e00", "#009e73", "#cc79a7", "#0072b2", "#f0e442", "#8b4513")
SETTINGS = """\
set terminal pngcairo noenhanced size 1000,480 font 'sans,11'
set key outside right
set grid lc rgb '#dddddd'
"""


def plot(file, title, labels, curves, settings=""):
    """Curves: (title, style, points)."""
    lines = [SETTINGS, f"set output '{file}'", f'set title "{title}"']
    lines += [f'set xlabel "{labels[0]}"', f'set ylabel "{labels[1]}"', settings]
    lines.append("plot " + ", ".join(f"'-' {style} title \"{name}\"" for name, style, _ in curves))
    for _, _, points in curves:
        lines += [f"{x:.8g} {y:.8g}" for x, y in points] + ["e"]
    subprocess.run(["gnuplot"], input="\n".join(lines) + "\n", text=True, check=True)


def thin(points, most=2000):
    return points[:: max(1, len(points) // most)]


def draw_case(out, case, results):
    """True if there is something to draw."""
    curves, few = [], False
    for result in results:
        if result.get("curve"):
            points = thin(list(zip(result["curve"]["x"], result["curve"]["y"])))
            ours = result["tool"] == "Limber"
            few = few or len(points) < 40
            style = f"points pt {7 if ours else 5} ps 1.2" if few else f"lines lw 2 dt {1 if ours else 2}"
            colour = COLOURS[len(curves) % len(COLOURS)]
            name = f"{result['tool']}, {result['variant']}"
            curves.append((name, f"with {style} lc rgb '{colour}'", points))
    if case.curve is None or not curves:
        return False
    if case.curve.points:
        style = "with points pt 6 ps 1.5 lc rgb 'black'"
        if len(case.curve.points) < 8 and not few:  # a polygon, as of rods
            style = "with lines dt 3 lw 2 lc rgb 'black'"
        curves.append(("reference", style, thin(list(case.curve.points), 60)))
    labels = (case.curve.x, case.curve.y)
    plot(out / f"{case.name}.png", f"{case.title}: {case.curve.title}", labels, curves)
    return True


def draw_cost(out, cases, results):
    """Worst error over tolerance against cost over the cheapest of the case."""
    points = {}
    for case in cases:
        answered = [r for r in results[case.name] if r["status"] == "answered"]
        for result in answered:
            found = result["answers"]
            if all(q.name in found for q in case.quantities):
                worst = max(abs(found[q.name] - q.reference) / q.tolerance for q in case.quantities)
                label = f"{result['tool']}, {result['variant']}"
                cost = result["cpu_s"] / min(r["cpu_s"] for r in answered)
                points.setdefault(label, []).append((cost, max(worst, 1e-4)))
    curves = [
        (label, f"with points pt {5 + 2 * (i % 5)} ps 1.5 lc rgb '{COLOURS[i % len(COLOURS)]}'", found)
        for i, (label, found) in enumerate(points.items())
    ]
    curves.append(("tolerance", "with lines lc rgb 'black' dt 2", [(0.8, 1), (1e4, 1)]))
    settings = "set logscale xy\nset xrange [0.8:*]\nset format y '10^{%T}'\nset termoption enhanced"
    labels = ("processor time over the cheapest run of the case", "worst error over tolerance")
    plot(out / "cost.png", "Error and cost of every run", labels, curves, settings)


def draw_all(out, cases, results):
    """Names of the pictures drawn."""
    drawn = {case.name for case in cases if draw_case(out, case, results[case.name])}
    draw_cost(out, cases, results)
    return drawn | {"cost"}
