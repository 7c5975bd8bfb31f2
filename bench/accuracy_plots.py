#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plots and the table of docs/benchmarks.md from what accuracy_kernels measures.

    bench/accuracy_plots.py BUILD/bench/accuracy_kernels DOCS/accuracy

writes one SVG a curve into the folder and prints the table. Nothing but the standard library.
"""
import csv
import math
import pathlib
import subprocess
import sys

CURVES = {  # title, what runs along x
    "rotation_noise": ("Manhattan rotation, normals alone", "scatter of the normals, degrees"),
    "rotation_outliers": ("Manhattan rotation, scatter of 5 degrees", "share of the normals that point anywhere"),
    "rotation_kernel": ("Manhattan rotation, 30 % outliers, fixed kernel", "width of the kernel, degrees (cone: 3.5 times as wide)"),
    "translation_parallax": ("Translation, 300 matches, 30 % wrong", "parallax at the middle depth, degrees"),
    "translation_noise": ("Translation, 300 matches, 30 % wrong", "noise of a coordinate, pixels at f = 500"),
}
LOG_X = {"translation_parallax", "translation_noise"}
COLOURS = ["#1b6ca8", "#c8553d", "#3a7d44"]
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 560, 330, 60, 110, 34, 46


class Axis:
    def __init__(self, values, start, end, log):
        self.log, self.start, self.end = log, start, end
        low, high = min(values), max(values)
        if log:
            low, high = math.log10(low), math.log10(high)
            self.ticks = [m * 10.0**e for e in range(math.floor(low) - 1, math.ceil(high) + 1) for m in (1, 2, 5)
                          if low - 1e-9 <= math.log10(m * 10.0**e) <= high + 1e-9]
        else:
            step = next(s for s in (0.1, 0.2, 0.5, 1, 2, 5, 10) if (high - low) / s <= 10)
            self.ticks = [i * step for i in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]
        self.low, self.high = low, high

    def at(self, value):
        value = math.log10(value) if self.log else value
        return self.start + (self.end - self.start) * (value - self.low) / (self.high - self.low)


def plot(name, rows):
    title, along = CURVES[name]
    seen = [r for r in rows if r["answered"] > 0]
    x = Axis([r["x"] for r in rows], LEFT, WIDTH - RIGHT, name in LOG_X)
    y = Axis([r["median"] for r in seen] + [r["p90"] for r in seen], HEIGHT - BOTTOM, TOP, True)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="11">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{LEFT}" y="18" font-size="13">{title}</text>',
           f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 10}" text-anchor="middle">{along}</text>',
           f'<text transform="translate(14 {HEIGHT / 2}) rotate(-90)" text-anchor="middle">error, degrees</text>']
    for tick in y.ticks:
        out.append(f'<path d="M{LEFT} {y.at(tick):.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>'
                   f'<text x="{LEFT - 6}" y="{y.at(tick) + 4:.1f}" text-anchor="end">{tick:g}</text>')
    for tick in x.ticks:
        out.append(f'<path d="M{x.at(tick):.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#eee"/>'
                   f'<text x="{x.at(tick):.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{tick:g}</text>')
    for i, series in enumerate(dict.fromkeys(r["series"] for r in rows)):
        colour = COLOURS[i % len(COLOURS)]
        for scalar, key, style in (("double", "median", 'stroke-width="2"'), ("float", "median", 'stroke-width="2" stroke-dasharray="1 5" style="stroke:black"'),
                                   ("double", "p90", 'stroke-width="1" opacity="0.5"')):
            line = [f'{x.at(r["x"]):.1f},{y.at(r[key]):.1f}' for r in seen if r["series"] == series and r["scalar"] == scalar]
            out.append(f'<polyline points="{" ".join(line)}" fill="none" stroke="{colour}" {style}/>')
        out.append(f'<text x="{WIDTH - RIGHT + 10}" y="{TOP + 14 + 16 * i}" fill="{colour}">{series}</text>')
    out.append(f'<text x="{WIDTH - RIGHT + 10}" y="{TOP + 80}" fill="#555">thick: median</text>'
               f'<text x="{WIDTH - RIGHT + 10}" y="{TOP + 96}" fill="#555">dots: in float</text>'
               f'<text x="{WIDTH - RIGHT + 10}" y="{TOP + 112}" fill="#555">thin: 90 %</text></svg>')
    return "\n".join(out) + "\n"


def table(rows):
    lines = []
    for name, (title, along) in CURVES.items():
        mine = [r for r in rows if r["curve"] == name]
        xs = list(dict.fromkeys(r["x"] for r in mine))
        lines += ["", f"{title}; {along}:", "", "| | " + " | ".join(f"{x:g}" for x in xs) + " |", "|---" * (len(xs) + 1) + "|"]
        for series in dict.fromkeys(r["series"] for r in mine):
            cells = []
            for r in (r for r in mine if r["series"] == series and r["scalar"] == "double"):
                share = "" if r["answered"] == 1 else f" ({100 * r['answered']:.0f} %)"
                cells.append(f"{r['median']:g}{share}" if r["answered"] > 0 else "none")
            lines.append(f"| {series} | " + " | ".join(cells) + " |")
    medians = {(r["curve"], r["series"], r["x"], r["scalar"]): r["median"] for r in rows}
    apart = max(abs(m - medians[key[:3] + ("float",)]) for key, m in medians.items() if key[3] == "double")
    lines += ["", f"These are in `double`; no median in `float` differs by more than {apart:.1g} degrees."]
    return "\n".join(lines)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    text = subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout
    rows = [{"curve": r["curve"], "series": r["series"], "scalar": r["scalar"], "x": float(r["x"]), "median": float(r["median_deg"]),
             "p90": float(r["p90_deg"]), "answered": float(r["answered"])} for r in csv.DictReader(text.splitlines())]
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    for name in CURVES:
        (folder / f"{name}.svg").write_text(plot(name, [r for r in rows if r["curve"] == name]))
    print(table(rows))


main()
