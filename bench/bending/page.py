# SPDX-License-Identifier: BSD-3-Clause
"""Text and pictures of the page that measure.py writes."""
import subprocess

INTRODUCTION = """\
Written by `bench/bending/measure.py`, including all text; do not edit. Bars that stiffen
in spin, bend far, buckle, and are struck, by public commands and [scenes](../scenes): level
`coupled`, whose bodies are linear, and `nonlinear` ([how](../../../docs/theory/nonlinear.md)),
with one body a link or cut into two pieces, against the closed form or the whole mesh (`full`).
Errors are percent of the truth. Costs are the processor's, of one run of this page on a shared
machine: only their ratios mean something, to about a fifth."""
STYLES = ("#d55e00", "#0072b2", "#cc79a7", "#000000", "#009e73")


def percent(value, digits=2):
    return "refused" if value is None else f"{100 * value:.{digits}f} %"


def number(value):
    return "-" if value is None else f"{value:.2f}"


def make_table(head, rows):
    """Columns but the first are aligned to the right."""
    lines = ["| " + " | ".join(head) + " |", "|---|" + "---:|" * (len(head) - 1)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows] + [""]


class Page:
    def __init__(self, out):
        self.out = out

    def plot(self, name, title, labels, series, *extra):
        """Series are (title, kind, points); a level has its own colour."""
        colours = dict(zip(("coupled", "nonlinear", "two pieces", "full"), STYLES))
        parts = [
            "set terminal pngcairo noenhanced size 900,480 font 'sans,11'",
            f"set output '{self.out / name}.png'",
            f'set title "{title}"',
            f'set xlabel "{labels[0]}"',
            f'set ylabel "{labels[1]}"',
            "set grid lc rgb '#dddddd'",
            "set key top left",
            *extra,
        ]
        looks = {"points": "pt 7 ps 1.5", "lines": "lw 2", "linespoints": "lw 2 pt 7"}
        plots = []
        for label, kind, _ in series:
            colour = colours.get(label.split(",")[0], STYLES[4])
            dash = " dt 2" if label == "full" or label.endswith("flap") else ""
            plots.append(
                f"'-' with {kind} {looks[kind]}{dash} lc rgb '{colour}' title '{label}'"
            )
        parts.append("plot " + ", ".join(plots))
        for _, _, points in series:
            parts += [f"{x:.6g} {y:.6g}" for x, y in points] + ["e"]
        subprocess.run(["gnuplot"], input="\n".join(parts) + "\n", text=True, check=True)

    def draw_static(self, bending, pressing):
        labels = ("load / (E I / L^2)", "tip across [m]")
        self.plot("bent", "A bar of 1 m under a load across its tip", labels, bending)
        labels = ("load along / Euler's", "tip across [m]")
        title = "The same under a load along it and 0.2 E I / L^2 across"
        self.plot("pressed", title, labels, pressing, "set yrange [0:0.8]")

    def draw_motion(self, frequencies, truth, lags, strikes, catches):
        series = []
        for level, (lag, flap) in frequencies.items():
            series.append((f"{level}, lag", "lines", lag))
            series.append((f"{level}, flap", "lines", flap))
        points = [(t, f) for t, pair in truth.items() for f in pair]
        series.append(("closed form", "points", points))
        labels = ("rotation / sqrt(E I / (rho A L^4))", "frequency / the same")
        self.plot("blade", "A rotating cantilever", labels, series)
        labels = ("time [s]", "tip across [m]")
        self.plot("spin_up", "Spin-up: lag of the tip", labels, lags, "set key top right")
        labels = ("time [ms]", "tip across the root [mm]")
        for rate, series in strikes.items():
            self.plot(f"struck_{rate}", f"Struck at {rate} rad/s", labels, series)
        labels = ("time [ms]", "tip [mm]")
        self.plot("catch", "A bar that catches a ball", labels, catches, "set key top center")

    def write(self, claims, cheaper, bent, blade, spin, struck, catch, cost):
        text = ["# Bending: level against truth", "", INTRODUCTION, "", "## Aims", ""]
        text += list_aims(claims, cheaper)
        text += ["## Bent, pressed and curved bars", ""]
        text += ["Displacement of the tip, and the seconds that `limber static` takes in all.", ""]
        head = ["", "coupled", "nonlinear", "two pieces", "full [m]"]
        head += ["coupled [s]", "nonlinear [s]", "two pieces [s]", "full [s]"]
        text += make_table(head, bent)
        text += ["![Bent](bent.png)", "", "![Pressed](pressed.png)", ""]
        text += ["## A rotating blade", "", "`examples/blade.toml`, against closed forms.", ""]
        text += make_table(["times", "coupled, lag", "flap", "nonlinear, lag", "flap"], blade)
        text += ["![Frequencies](blade.png)", "", "## A spin-up", ""]
        text += ["`examples/spin_up.toml`, against beam finite elements.", ""]
        head = ["level", "lag [m]", "at [s]", "foreshortening [m]", "stretch [m]"]
        text += make_table(head, spin)
        text += ["![Lag](spin_up.png)", "", "## Struck while it spins", ""]
        text += ["Largest error in 50 ms of the tip against the root, of its largest way.", ""]
        text += make_table(["", "coupled", "nonlinear", "two pieces", "way / length"], struck)
        text += ["![30 rad/s](struck_30.png)", "", "![100 rad/s](struck_100.png)", ""]
        text += ["## A catch", "", "A bar, held at its root, and a soft ball of 1 kg that"]
        text += ["strikes it near its tip with 8 m/s. Largest error of the tip's motion in 120 ms, of"]
        text += [f"its largest way, which is {100 * catch[1]:.0f} % of the length; largest force and"]
        text += ["impulse of all touches.", ""]
        head = ["level", "error", "peak [N]", "impulse [N s]", "touches"]
        text += make_table(head, catch[0])
        text += ["![Tip](catch.png)", "", "## Cost of a step", ""]
        head = ["scene", "coupled [us]", "nonlinear [us]", "two pieces [us]", "full [us]"]
        text += make_table(head + ["nonlinear / coupled", "full / nonlinear"], cost)
        text += ["`full` is cheap here because these meshes are coarse, of 40 to 80 elements. Products"]
        text += ["of modes move what touches, which the catch pays for.", ""]
        (self.out / "README.md").write_text("\n".join(text[:-1]) + "\n", encoding="utf-8")


def list_aims(claims, cheaper):
    """Errors of `nonlinear` and the costs of `full`, beside what was aimed at."""
    held = sum(1 for _, error, aim in claims if error is not None and error <= aim)
    held += sum(1 for _, times, aim in cheaper if times >= aim)
    rows = []
    for name, error, aim in claims:
        is_held = error is not None and error <= aim
        rows.append([name, percent(error, 3), percent(aim), "held" if is_held else "**missed**"])
    for name, times, aim in cheaper:
        verdict = "held" if times >= aim else "**missed**"
        rows.append([f"{name}, steps cheaper than of full", f"{times:.0f}", f"{aim:.0f}", verdict])
    intro = f"Of level `nonlinear`; {held} of {len(rows)} are held."
    return [intro, ""] + make_table(["", "error", "aim", ""], rows)
